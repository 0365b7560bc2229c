// SPDX-License-Identifier: BSD-3-Clause
#include "app/options.h"

#include "core/text.h"

#include <cmath>

namespace terrane {

namespace {

constexpr int kLargestPicture = 16384; // OpenGL 4.5 implementations have textures of this size

std::optional<int> wholeInt(std::string_view text) {
    const auto number = parseInt(text);
    if (!number || number->length != text.size()) return std::nullopt;
    return number->value;
}

} // namespace

std::optional<PictureSize> parseSize(std::string_view text) {
    const auto pieces = split(text, 'x');
    if (pieces.size() != 2) return std::nullopt;
    const auto width = wholeInt(pieces[0]), height = wholeInt(pieces[1]);
    if (!width || !height || *width < 1 || *height < 1) return std::nullopt;
    if (*width > kLargestPicture || *height > kLargestPicture) return std::nullopt;
    return PictureSize{*width, *height};
}

std::optional<View> parseView(std::string_view text) {
    const auto pieces = split(text, ',');
    View view;
    double* const values[] = {&view.x0, &view.y0, &view.theta, &view.phi, &view.d};
    if (pieces.size() != std::size(values)) return std::nullopt;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const auto number = parseReal(pieces[i]);
        if (!number || number->length != pieces[i].size() || !std::isfinite(number->value))
            return std::nullopt;
        *values[i] = number->value;
    }
    if (view.d <= 0) return std::nullopt;
    return view;
}

} // namespace terrane
