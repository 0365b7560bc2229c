// SPDX-License-Identifier: BSD-3-Clause
#include "core/image_decoder.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <jpeglib.h>
// After jpeglib.h, which it needs.
#include <jerror.h>

namespace terrane {

namespace {

// A file of a few kilobytes can hold thousands of empty scans over a large picture, each of which
// takes as long as a full one. Encoders write about ten.
constexpr int kMostScans = 100;

// libjpeg reports through function pointers and wants not to be returned to: back by longjmp, over
// frames of its own only.
struct Decoder {
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf fail{};
    std::array<char, JMSG_LENGTH_MAX> message{};
};

[[noreturn]] void fail(j_common_ptr jpeg) {
    auto& decoder = *static_cast<Decoder*>(jpeg->client_data);
    jpeg->err->format_message(jpeg, decoder.message.data());
    std::longjmp(decoder.fail, 1);
}

void warn(j_common_ptr jpeg, int level) {
    // Warnings are negative. All but one mean that pixels were made up.
    if (level < 0 && jpeg->err->msg_code != JWRN_EXTRANEOUS_DATA) fail(jpeg);
}

void limitScans(j_common_ptr jpeg) {
    auto& decoder = *static_cast<Decoder*>(jpeg->client_data);
    if (decoder.jpeg.input_scan_number <= kMostScans) return;
    std::snprintf(decoder.message.data(), decoder.message.size(), "too many scans");
    std::longjmp(decoder.fail, 1);
}

bool readHeader(Decoder& decoder, std::string_view bytes) {
    jpeg_decompress_struct& jpeg = decoder.jpeg;
    jpeg.err = jpeg_std_error(&decoder.errors);
    jpeg.client_data = &decoder;
    decoder.errors.error_exit = fail;
    decoder.errors.emit_message = warn;
    decoder.progress.progress_monitor = limitScans;
    if (setjmp(decoder.fail)) return false;
    jpeg_create_decompress(&jpeg);
    jpeg.progress = &decoder.progress;
    jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()),
                 static_cast<unsigned long>(bytes.size()));
    jpeg_read_header(&jpeg, TRUE);
    const bool grey = jpeg.jpeg_color_space == JCS_GRAYSCALE;
    const bool cmyk = jpeg.jpeg_color_space == JCS_CMYK || jpeg.jpeg_color_space == JCS_YCCK;
    jpeg.out_color_space = grey ? JCS_GRAYSCALE : cmyk ? JCS_CMYK : JCS_RGB;
    jpeg_calc_output_dimensions(&jpeg);
    return true;
}

bool readRows(Decoder& decoder, Image& image) {
    jpeg_decompress_struct& jpeg = decoder.jpeg;
    if (setjmp(decoder.fail)) return false;
    jpeg_start_decompress(&jpeg);
    while (jpeg.output_scanline < jpeg.output_height) {
        JSAMPROW row = image.row(image.height - 1 - static_cast<int>(jpeg.output_scanline));
        jpeg_read_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_decompress(&jpeg);
    return true;
}

// Adobe's programs store the inks inverted, and say so with a marker of theirs.
Image rgbFromCmyk(const Image& inks, bool inverted) {
    Image image = makeImage(inks.width, inks.height, 3);
    const std::size_t pixels = image.bytes.size() / 3;
    for (std::size_t i = 0; i < pixels; ++i) {
        const auto paper = [&](std::size_t ink) {
            const int value = inks.bytes[4 * i + ink];
            return inverted ? value : 255 - value;
        };
        for (std::size_t c = 0; c < 3; ++c)
            image.bytes[3 * i + c] = static_cast<unsigned char>(paper(c) * paper(3) / 255);
    }
    return image;
}

std::optional<Image> decode(Decoder& decoder, std::string_view bytes, ImageProblem& problem) {
    const jpeg_decompress_struct& jpeg = decoder.jpeg;
    if (!readHeader(decoder, bytes)) {
        problem.message = std::string("the image is damaged: ") + decoder.message.data();
        return std::nullopt;
    }
    const int width = static_cast<int>(jpeg.output_width);
    const int height = static_cast<int>(jpeg.output_height);
    const int channels = jpeg.output_components;
    // A progressive file is kept whole, as 16-bit coefficients, until its last scan.
    const std::uint64_t pixelSize = 3 * static_cast<std::uint64_t>(channels);
    if (!imageSizeIsSane(width, height, pixelSize, bytes.size(), problem)) return std::nullopt;
    Image image = makeImage(width, height, channels);
    if (!readRows(decoder, image)) {
        problem.message = std::string("the image is damaged: ") + decoder.message.data();
        return std::nullopt;
    }
    if (channels == 4) return rgbFromCmyk(image, jpeg.saw_Adobe_marker != 0);
    return image;
}

} // namespace

bool isJpeg(std::string_view bytes) {
    return bytes.starts_with("\xff\xd8\xff");
}

std::optional<Image> decodeJpeg(std::string_view bytes, ImageProblem& problem) {
    Decoder decoder;
    std::optional<Image> image = decode(decoder, bytes, problem);
    jpeg_destroy_decompress(&decoder.jpeg);
    return image;
}

} // namespace terrane
