// SPDX-License-Identifier: BSD-3-Clause
#include "core/image.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace terrane {

namespace {

using Rgba = std::array<int, 4>;

Rgba rgba(const Image& image, int x, int y) {
    const unsigned char* p = image.row(y) + static_cast<std::size_t>(x) * image.pixelSize();
    switch (image.channels) {
    case 1:
        return {p[0], p[0], p[0], 255};
    case 2:
        return {p[0], p[0], p[0], p[1]};
    case 3:
        return {p[0], p[1], p[2], 255};
    default:
        return {p[0], p[1], p[2], p[3]};
    }
}

Rgba difference(const Rgba& a, const Rgba& b) {
    return {std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2]),
            std::abs(a[3] - b[3])};
}

int largest(const Rgba& value) {
    return *std::max_element(value.begin(), value.end());
}

} // namespace

std::string PictureDifference::toString() const {
    if (!sameSize) return "the pictures have different sizes";
    if (maximum == 0) return "the pictures are equal";
    std::array<char, 192> text{};
    int length =
        std::snprintf(text.data(), text.size(),
                      "%.3g %% of the pixels differ by more than %d/255 (at most %d, mean %.3g)",
                      100 * share, kPictureTolerance, maximum, mean);
    std::string result(text.data(), static_cast<std::size_t>(length));
    if (firstX >= 0)
        result += ", the first at " + std::to_string(firstX) + "," + std::to_string(firstY) +
                  " from the top left";
    return result;
}

PictureDifference comparePictures(const Image& actual, const Image& expected) {
    assert(actual.type == PixelType::u8 && expected.type == PixelType::u8);
    PictureDifference result;
    if (actual.width != expected.width || actual.height != expected.height) {
        result.sameSize = false;
        result.share = 1;
        return result;
    }
    const std::int64_t pixels = std::int64_t{actual.width} * actual.height;
    if (pixels == 0) return result;
    std::int64_t different = 0;
    std::int64_t sum = 0;
    for (int fromTop = 0; fromTop < actual.height; ++fromTop) {
        const int y = actual.height - 1 - fromTop;
        for (int x = 0; x < actual.width; ++x) {
            const Rgba d = difference(rgba(actual, x, y), rgba(expected, x, y));
            sum += d[0] + d[1] + d[2] + d[3];
            result.maximum = std::max(result.maximum, largest(d));
            if (largest(d) <= kPictureTolerance) continue;
            if (different++ == 0) {
                result.firstX = x;
                result.firstY = fromTop;
            }
        }
    }
    // Alpha counts as a channel only where one of the pictures has it.
    const bool alpha = actual.channels % 2 == 0 || expected.channels % 2 == 0;
    result.share = static_cast<double>(different) / static_cast<double>(pixels);
    result.mean = static_cast<double>(sum) / static_cast<double>(pixels * (alpha ? 4 : 3));
    return result;
}

Image differenceImage(const Image& actual, const Image& expected) {
    assert(actual.type == PixelType::u8 && expected.type == PixelType::u8);
    Image result = makeImage(expected.width, expected.height, 3);
    for (int y = 0; y < expected.height; ++y) {
        for (int x = 0; x < expected.width; ++x) {
            const Rgba wanted = rgba(expected, x, y);
            // Rows are counted from the bottom, pictures from the top: line up the top left
            // corners.
            const int actualY = actual.height - (expected.height - y);
            const bool has = x < actual.width && actualY >= 0 && actualY < actual.height;
            const int d = has ? largest(difference(rgba(actual, x, actualY), wanted)) : 255;
            const int faint = 160 + (wanted[0] + wanted[1] + wanted[2]) / 3 * 95 / 255;
            unsigned char* pixel = result.row(y) + 3 * static_cast<std::size_t>(x);
            const bool differs = d > kPictureTolerance;
            pixel[0] = static_cast<unsigned char>(differs ? 127 + d / 2 : faint);
            pixel[1] = pixel[2] = static_cast<unsigned char>(differs ? 0 : faint);
        }
    }
    return result;
}

} // namespace terrane
