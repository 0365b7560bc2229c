// SPDX-License-Identifier: BSD-3-Clause
#include "core/image.h"

#include "core/image_decoder.h"

#define STBI_NO_STDIO
#include <stb_image.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <memory>

namespace terrane {

namespace {

constexpr std::uint64_t kLargestImage = std::uint64_t{1} << 30;
// No format read here packs more pixels into a byte: a PNG of 1-bit pixels at deflate's limit of
// 1032:1 (zlib's technical notes). More is a header that lies.
constexpr std::uint64_t kMostPixelsPerByte = 1032 * 8;

constexpr std::uint32_t kRawMagic = 0xCAFEBABE;
constexpr std::size_t kRawTrailerSize = 20;

const char* const kFormats = "JPEG, PNG, BMP, TGA, PSD, HDR or raw float";

// Feeds stb_image and notices when it asks for more than there is: several of its decoders fill
// the rest with zeros and report success.
struct Reader {
    std::string_view bytes;
    /// Goes on with 0xff after the end: the Radiance decoder counts pixels with bytes that it reads
    /// and would wait forever for zeros to add up. The others rely on a true end.
    bool endless = false;
    std::size_t position = 0;
    bool endedEarly = false;

    // stb_image reads ahead in pieces of this size (stbi__context::buffer_start); any other request
    // is for bytes that it needs.
    static constexpr int kReadAhead = 128;

    static int read(void* user, char* target, int size) {
        auto& reader = *static_cast<Reader*>(user);
        const std::size_t left = reader.bytes.size() - reader.position;
        const std::size_t count = std::min(left, static_cast<std::size_t>(std::max(size, 0)));
        if (count == 0 || (static_cast<int>(count) < size && size != kReadAhead))
            reader.endedEarly = true;
        if (count == 0 && reader.endless) {
            std::memset(target, 0xff, static_cast<std::size_t>(size));
            return size;
        }
        std::memcpy(target, reader.bytes.data() + reader.position, count);
        reader.position += count;
        return static_cast<int>(count);
    }

    static void skip(void* user, int count) {
        auto& reader = *static_cast<Reader*>(user);
        const auto wanted = static_cast<std::int64_t>(reader.position) + count;
        const auto size = static_cast<std::int64_t>(reader.bytes.size());
        if (wanted < 0 || wanted > size) reader.endedEarly = true;
        reader.position = static_cast<std::size_t>(std::clamp<std::int64_t>(wanted, 0, size));
    }

    static int atEnd(void* user) {
        const auto& reader = *static_cast<Reader*>(user);
        return reader.position >= reader.bytes.size() ? 1 : 0;
    }
};

constexpr stbi_io_callbacks kCallbacks{&Reader::read, &Reader::skip, &Reader::atEnd};

bool isRaw(std::string_view bytes) {
    if (bytes.size() < kRawTrailerSize) return false;
    std::uint32_t magic = 0;
    std::memcpy(&magic, bytes.data() + bytes.size() - kRawTrailerSize, sizeof magic);
    return magic == kRawMagic;
}

std::optional<Image> decodeRaw(std::string_view bytes, ImageProblem& problem) {
    static_assert(std::endian::native == std::endian::little, "raw float files are little-endian");
    const std::size_t payload = bytes.size() - kRawTrailerSize;
    std::array<std::int32_t, 5> trailer{};
    std::memcpy(trailer.data(), bytes.data() + payload, kRawTrailerSize);
    const auto [magic, width, height, depth, channels] = trailer;
    if (width < 1 || height < 1 || channels < 1 || channels > 4 || depth < 0 ||
        (depth > 0 && height % depth != 0)) {
        problem = {"the raw float trailer says width " + std::to_string(width) + ", height " +
                       std::to_string(height) + ", depth " + std::to_string(depth) + ", " +
                       std::to_string(channels) + " channels",
                   "positive sizes, a height that is a multiple of the depth, 1 to 4 channels"};
        return std::nullopt;
    }
    const std::uint64_t pixelSize = 4 * std::uint64_t(channels);
    if (!imageSizeIsSane(width, height, pixelSize, bytes.size(), problem)) return std::nullopt;
    const std::uint64_t expected = std::uint64_t(width) * std::uint64_t(height) * pixelSize;
    if (expected != payload) {
        problem = {"raw float data of " + std::to_string(payload) + " bytes before the trailer",
                   std::to_string(expected) + " bytes, as the trailer says"};
        return std::nullopt;
    }
    Image image{width, height, channels, depth, PixelType::f32, {}};
    image.bytes.assign(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(payload));
    return image;
}

bool isHdr(std::string_view bytes) {
    Reader reader{bytes};
    return stbi_is_hdr_from_callbacks(&kCallbacks, &reader) != 0;
}

// The decoded rows, top first, as stb_image gives them.
using Pixels = std::unique_ptr<void, decltype(&stbi_image_free)>;

Image fromTopDown(const Pixels& pixels, int width, int height, int channels, PixelType type) {
    Image image = makeImage(width, height, channels, type);
    const auto* source = static_cast<const unsigned char*>(pixels.get());
    for (int y = height - 1; y >= 0; --y, source += image.rowSize())
        std::memcpy(image.row(y), source, image.rowSize());
    return image;
}

std::optional<Image> decodeWithStb(std::string_view bytes, ImageProblem& problem) {
    const PixelType type = isHdr(bytes) ? PixelType::f32 : PixelType::u8;
    int width = 0;
    int height = 0;
    int channels = 0;
    Reader header{bytes};
    if (!stbi_info_from_callbacks(&kCallbacks, &header, &width, &height, &channels)) {
        problem = {"not an image, or its header is damaged", kFormats};
        return std::nullopt;
    }
    // Four channels, since a decoder may need a whole RGBA copy on its way.
    const std::uint64_t pixelSize = type == PixelType::f32 ? 16 : 4;
    if (!imageSizeIsSane(width, height, pixelSize, bytes.size(), problem)) return std::nullopt;

    Reader reader{bytes, type == PixelType::f32};
    void* const decoded =
        type == PixelType::f32
            ? static_cast<void*>(
                  stbi_loadf_from_callbacks(&kCallbacks, &reader, &width, &height, &channels, 0))
            : stbi_load_from_callbacks(&kCallbacks, &reader, &width, &height, &channels, 0);
    const Pixels pixels(decoded, &stbi_image_free);
    if (!pixels || reader.endedEarly) {
        problem = {reader.endedEarly
                       ? "the image ends too early"
                       : std::string("the image is damaged: ") + stbi_failure_reason(),
                   {}};
        return std::nullopt;
    }
    return fromTopDown(pixels, width, height, channels, type);
}

std::optional<Image> decode(std::string_view bytes, ImageProblem& problem) {
    if (isRaw(bytes)) return decodeRaw(bytes, problem);
    if (isJpeg(bytes)) return decodeJpeg(bytes, problem);
    return decodeWithStb(bytes, problem);
}

} // namespace

bool imageSizeIsSane(int width, int height, std::uint64_t pixelSize, std::size_t fileSize,
                     ImageProblem& problem) {
    // A header that ends within its numbers gives 0, and a Radiance header may have negative ones.
    if (width < 1 || height < 1) {
        problem = {"the image has no pixels", {}};
        return false;
    }
    const std::uint64_t pixels = std::uint64_t(width) * std::uint64_t(height);
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    if (pixels > kLargestImage / pixelSize) {
        problem = {size + " pixels are too many", "an image of at most 1 GiB in memory"};
        return false;
    }
    if (pixels / kMostPixelsPerByte > fileSize) {
        problem = {"the file is too short for its " + size + " pixels", {}};
        return false;
    }
    return true;
}

float Image::value(int x, int y, int channel) const {
    assert(x >= 0 && x < width && y >= 0 && y < height && channel >= 0 && channel < channels);
    const unsigned char* pixel = row(y) + static_cast<std::size_t>(x) * pixelSize();
    if (type == PixelType::u8) return static_cast<float>(pixel[channel]) / 255.0f;
    float result = 0;
    std::memcpy(&result, pixel + 4 * static_cast<std::size_t>(channel), sizeof result);
    return result;
}

Image makeImage(int width, int height, int channels, PixelType type) {
    assert(width >= 0 && height >= 0 && channels >= 1 && channels <= 4);
    Image image{width, height, channels, 0, type, {}};
    image.bytes.resize(image.byteSize());
    return image;
}

std::optional<Image> decodeImage(std::string_view bytes, std::string_view name,
                                 Diagnostics& diagnostics, const Place& place) {
    ImageProblem problem;
    std::optional<Image> image = decode(bytes, problem);
    if (!image)
        diagnostics.error("image-damaged", place,
                          "can't read '" + std::string(name) + "': " + problem.message,
                          problem.expected);
    return image;
}

} // namespace terrane
