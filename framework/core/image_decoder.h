// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the decoders behind decodeImage() share; nobody else includes this.

#include "core/image.h"

#include <cstdint>

namespace terrane {

/// Why an image can't be decoded, for the message and the expectation of a diagnostic.
struct ImageProblem {
    std::string message;
    std::string expected;
};

/// False, with a problem, for a size that no image has, that would not fit into memory, or that a
/// file of this many bytes can't fill.
bool imageSizeIsSane(int width, int height, std::uint64_t pixelSize, std::size_t fileSize,
                     ImageProblem& problem);

bool isJpeg(std::string_view bytes);
std::optional<Image> decodeJpeg(std::string_view bytes, ImageProblem& problem);

} // namespace terrane
