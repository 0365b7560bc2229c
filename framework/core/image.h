// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace terrane {

enum class PixelType { u8, f32 };

/// A picture or table of numbers in memory. Row 0 is the BOTTOM row, as OpenGL wants it; rows are
/// tightly packed, channels interleaved. Plain data: copy it, move it, read it from any thread.
struct Image {
    int width = 0;
    int height = 0;
    int channels = 0; ///< 1 to 4: red, red-green, RGB, RGBA
    /// Slices stacked in `height`, the first at the bottom; 0 when the file does not say (only "raw
    /// float" files do). Divides `height`.
    int depth = 0;
    PixelType type = PixelType::u8;
    std::vector<unsigned char> bytes; ///< byteSize() of them; f32 in the machine's byte order

    std::size_t pixelSize() const {
        return static_cast<std::size_t>(channels) * (type == PixelType::f32 ? 4 : 1);
    }
    std::size_t rowSize() const { return static_cast<std::size_t>(width) * pixelSize(); }
    std::size_t byteSize() const { return rowSize() * static_cast<std::size_t>(height); }

    /// The bytes of a row, 0 being the bottom one.
    unsigned char* row(int y) { return bytes.data() + rowSize() * static_cast<std::size_t>(y); }
    const unsigned char* row(int y) const {
        return bytes.data() + rowSize() * static_cast<std::size_t>(y);
    }
    /// A channel of a pixel as a number: 0 to 1 for u8, as it is for f32.
    float value(int x, int y, int channel) const;
};

/// A zeroed picture of 8-bit channels, or of floats.
Image makeImage(int width, int height, int channels, PixelType type = PixelType::u8);

/// Decodes JPEG, PNG, BMP, TGA, PSD (to u8), Radiance HDR and "raw float" (to f32). Raw float is
/// `width * height * channels` little-endian floats, bottom row first, and a trailer of five int32:
/// 0xCAFEBABE, width, height, depth, channels; the trailer tells it, not the name.
///
/// Hostile bytes are safe: sizes are checked before memory is taken, and an image may take at most
/// 1 GiB. What can't be decoded, or ends too early, is an error "image-damaged" at `place`.
/// @param name shown in the diagnostic
std::optional<Image> decodeImage(std::string_view bytes, std::string_view name,
                                 Diagnostics& diagnostics, const Place& place);

/// PNG bytes of an 8-bit image (an f32 image is a misuse). Equal images give equal bytes. Empty
/// when memory runs out.
std::string encodePng(const Image& image);

/// encodePng into a file, replaced in one step. False when it can't be written.
bool writePng(const std::filesystem::path& path, const Image& image);

/// The channels of a pixel may differ by this much (of 255) before the pixel counts as different:
/// rounding in drivers and compilers, which no one sees.
inline constexpr int kPictureTolerance = 5;
/// Pictures agree when at most this share of the pixels is different: an edge that falls on the
/// other side of a pixel's centre.
inline constexpr double kPictureShare = 0.001;

/// How two pictures differ, in steps of 1/255. A missing alpha counts as opaque, and grey as equal
/// red, green and blue.
struct PictureDifference {
    bool sameSize = true; ///< if not, the other numbers mean nothing and share is 1
    double share = 0;     ///< of pixels with a channel that differs by more than kPictureTolerance
    int maximum = 0;      ///< largest difference of a channel, 0 to 255
    double mean = 0;      ///< mean difference over all pixels and channels
    /// The first different pixel in reading order, from the left and from the TOP, as picture
    /// viewers count; -1 when there is none.
    int firstX = -1;
    int firstY = -1;

    bool agree(double largestShare = kPictureShare) const {
        return sameSize && share <= largestShare;
    }
    /// One line for people: "2.31 % of the pixels differ by more than 5/255 (at most 87, ...".
    std::string toString() const;
};

/// Compares two 8-bit pictures.
PictureDifference comparePictures(const Image& actual, const Image& expected);

/// A picture to look at: the expected one, faint, with each different pixel in red, the brighter
/// the larger its difference. As large as `expected`; where `actual` has no pixel it is all red.
Image differenceImage(const Image& actual, const Image& expected);

} // namespace terrane
