// SPDX-License-Identifier: BSD-3-Clause
#include "core/files.h"
#include "core/image.h"

#include <array>
#include <cassert>
#include <png.h>

namespace terrane {

std::string encodePng(const Image& image) {
    assert(image.type == PixelType::u8 && "encodePng(): 8-bit images only");
    assert(image.width > 0 && image.height > 0 && image.bytes.size() == image.byteSize());
    constexpr std::array<png_uint_32, 5> kFormatOfChannels{0, PNG_FORMAT_GRAY, PNG_FORMAT_GA,
                                                           PNG_FORMAT_RGB, PNG_FORMAT_RGBA};
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(image.width);
    png.height = static_cast<png_uint_32>(image.height);
    png.format = kFormatOfChannels.at(static_cast<std::size_t>(image.channels));

    // A negative stride tells libpng that the rows stand bottom up.
    const int stride = -static_cast<int>(image.rowSize());
    std::string result;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
    result.resize(size);
    if (!png_image_write_to_memory(&png, result.data(), &size, 0, image.bytes.data(), stride,
                                   nullptr))
        return {};
    result.resize(size);
    return result;
}

bool writePng(const std::filesystem::path& path, const Image& image) {
    const std::string bytes = encodePng(image);
    return !bytes.empty() && writeFile(path, bytes);
}

} // namespace terrane
