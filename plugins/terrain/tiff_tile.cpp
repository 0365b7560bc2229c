// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/tiff_tile.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>
#include <tiffio.h>

namespace terrane {

namespace {

// Far more than the directory of a tile needs.
constexpr tmsize_t kMostBytes = 64 << 20;

/// A file in memory as libtiff reads it, and the first thing it complains about.
struct Stream {
    std::span<const std::byte> bytes;
    std::uint64_t position = 0;
    std::string complaint;
};

Stream& streamOf(thandle_t handle) {
    return *static_cast<Stream*>(handle);
}

tmsize_t readBytes(thandle_t handle, void* buffer, tmsize_t size) {
    Stream& stream = streamOf(handle);
    const std::uint64_t left =
        stream.bytes.size() - std::min<std::uint64_t>(stream.position, stream.bytes.size());
    const std::uint64_t count = std::min<std::uint64_t>(left, static_cast<std::uint64_t>(size));
    if (count > 0) std::memcpy(buffer, stream.bytes.data() + stream.position, count);
    stream.position += count;
    return static_cast<tmsize_t>(count);
}

tmsize_t writeBytes(thandle_t, void*, tmsize_t) {
    return -1;
}

toff_t seek(thandle_t handle, toff_t offset, int whence) {
    Stream& stream = streamOf(handle);
    const std::uint64_t base = whence == SEEK_CUR   ? stream.position
                               : whence == SEEK_END ? stream.bytes.size()
                                                    : 0;
    stream.position = base + offset;
    return stream.position;
}

toff_t sizeOf(thandle_t handle) {
    return streamOf(handle).bytes.size();
}

int close(thandle_t) {
    return 0;
}

// Nonzero: the handler of the process, which prints, is not called.
int complain(TIFF*, void* user, const char* module, const char* format, va_list arguments) {
    std::string& text = static_cast<Stream*>(user)->complaint;
    if (!text.empty()) return 1;
    std::array<char, 400> line{};
    std::vsnprintf(line.data(), line.size(), format, arguments);
    text = (module && *module ? std::string(module) + ": " : "") + line.data();
    return 1;
}

int ignore(TIFF*, void*, const char*, const char*, va_list) {
    return 1;
}

struct CloseTiff {
    void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
struct FreeOptions {
    void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};
using TiffPointer = std::unique_ptr<TIFF, CloseTiff>;

TiffPointer open(Stream& stream) {
    const std::unique_ptr<TIFFOpenOptions, FreeOptions> options(TIFFOpenOptionsAlloc());
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMostBytes);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), complain, &stream);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore, nullptr);
    // Read-only, without libtiff's own mapping.
    return TiffPointer(TIFFClientOpenExt("tile", "rm", &stream, readBytes, writeBytes, seek, close,
                                         sizeOf, nullptr, nullptr, options.get()));
}

template <class T>
T field(TIFF* tiff, ttag_t tag) {
    T value = 0;
    TIFFGetFieldDefaulted(tiff, tag, &value);
    return value;
}

// Lossless ones whose decoders need little memory.
bool isKnown(std::uint16_t compression) {
    switch (compression) {
    case COMPRESSION_NONE:
    case COMPRESSION_LZW:
    case COMPRESSION_PACKBITS:
    case COMPRESSION_DEFLATE:
    case COMPRESSION_ADOBE_DEFLATE:
        return TIFFIsCODECConfigured(compression) != 0;
    default:
        return false;
    }
}

struct Layout {
    std::uint32_t width = 0, height = 0;
    bool bytePairs = false; ///< two samples of 8 bits, else one of 16
    bool bottomFirst = true;
};

// Empty when tiles of a pyramid look like this.
std::string readLayout(TIFF* tiff, int largest, Layout& layout) {
    layout.width = field<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH);
    layout.height = field<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH);
    const auto most = static_cast<std::uint32_t>(largest);
    if (layout.width == 0 || layout.height == 0 || layout.width > most || layout.height > most)
        return "it has " + std::to_string(layout.width) + "x" + std::to_string(layout.height) +
               " pixels";

    const auto samples = field<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL);
    const auto bits = field<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE);
    layout.bytePairs = samples == 2;
    if (!(samples == 2 && bits == 8) && !(samples == 1 && bits == 16))
        return "it has " + std::to_string(samples) + " samples of " + std::to_string(bits) +
               " bits, not one of 16 or two of 8";
    if (samples > 1 && field<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG) != PLANARCONFIG_CONTIG)
        return "its samples are kept apart";
    const auto kind = field<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT);
    if (kind != SAMPLEFORMAT_INT && kind != SAMPLEFORMAT_UINT && kind != SAMPLEFORMAT_VOID)
        return "its values are no integers";

    const auto compression = field<std::uint16_t>(tiff, TIFFTAG_COMPRESSION);
    if (!isKnown(compression)) return "its compression is " + std::to_string(compression);
    if (TIFFIsTiled(tiff)) return "it consists of tiles, not of strips";

    std::uint16_t orientation = 0;
    if (TIFFGetField(tiff, TIFFTAG_ORIENTATION, &orientation) == 0) return {};
    layout.bottomFirst = orientation == ORIENTATION_BOTLEFT;
    if (!layout.bottomFirst && orientation != ORIENTATION_TOPLEFT)
        return "its orientation is " + std::to_string(orientation);
    return {};
}

// The bytes of all strips, in the order of the file. False when some are missing.
bool readStrips(TIFF* tiff, const Layout& layout, std::vector<std::int16_t>& values) {
    const auto rowBytes = static_cast<tmsize_t>(layout.width) * 2;
    if (TIFFScanlineSize(tiff) != rowBytes) return false;
    const std::uint32_t rows =
        std::min(field<std::uint32_t>(tiff, TIFFTAG_ROWSPERSTRIP), layout.height);
    if (rows == 0) return false;
    auto* bytes = reinterpret_cast<std::uint8_t*>(values.data());
    for (std::uint32_t row = 0; row < layout.height; row += rows) {
        const tmsize_t size = std::min(rows, layout.height - row) * rowBytes;
        if (TIFFReadEncodedStrip(tiff, TIFFComputeStrip(tiff, row, 0), bytes, size) != size)
            return false;
        bytes += size;
    }
    return true;
}

void combineBytes(std::vector<std::int16_t>& values) {
    for (std::int16_t& value : values) {
        std::array<std::uint8_t, 2> bytes{};
        std::memcpy(bytes.data(), &value, 2);
        value = static_cast<std::int16_t>(static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8));
    }
}

void turnOver(HeightImage& image) {
    const auto width = static_cast<std::ptrdiff_t>(image.width);
    for (std::ptrdiff_t low = 0, high = image.height - 1; low < high; ++low, --high)
        std::swap_ranges(image.values.begin() + low * width,
                         image.values.begin() + (low + 1) * width,
                         image.values.begin() + high * width);
}

} // namespace

std::optional<HeightImage> decodeTiffTile(std::span<const std::byte> bytes, int largest,
                                          std::string& problem) {
    Stream stream{.bytes = bytes};
    const TiffPointer tiff = open(stream);
    Layout layout;
    problem = tiff ? readLayout(tiff.get(), largest, layout) : "it is no TIFF file";
    if (tiff && problem.empty()) {
        HeightImage image{static_cast<int>(layout.width), static_cast<int>(layout.height), {}};
        image.values.resize(static_cast<std::size_t>(layout.width) * layout.height);
        if (readStrips(tiff.get(), layout, image.values)) {
            if (layout.bytePairs) combineBytes(image.values);
            if (!layout.bottomFirst) turnOver(image);
            return image;
        }
        problem = "its pixels can't be decoded";
    }
    if (!stream.complaint.empty()) problem += " (" + stream.complaint + ")";
    return std::nullopt;
}

} // namespace terrane
