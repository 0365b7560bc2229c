// SPDX-License-Identifier: BSD-3-Clause
#include "core/files.h"
#include "core/image.h"

#include "temporary_folder.h"

#include <cstring>
#include <doctest/doctest.h>
#include <random>
#include <stb_image_write.h>
#include <unistd.h>

using namespace terrane;

namespace {

// Colours that change smoothly, so that JPEG keeps them, and differently along x and y, so that a
// flip shows.
Image gradient(int width, int height, int channels) {
    Image image = makeImage(width, height, channels);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            unsigned char* p = image.row(y) + static_cast<std::size_t>(x * channels);
            const int values[] = {x * 200 / width, 20 + y * 200 / height, 128, 255 - x};
            for (int c = 0; c < channels; ++c)
                p[c] = static_cast<unsigned char>(values[c]);
        }
    }
    return image;
}

void append(void* target, void* data, int size) {
    static_cast<std::string*>(target)->append(static_cast<char*>(data),
                                              static_cast<std::size_t>(size));
}

// The rows as files have them: top first.
std::vector<unsigned char> topDown(const Image& image) {
    std::vector<unsigned char> rows;
    for (int y = image.height - 1; y >= 0; --y)
        rows.insert(rows.end(), image.row(y), image.row(y) + image.rowSize());
    return rows;
}

std::string asJpeg(const Image& i) {
    std::string bytes;
    stbi_write_jpg_to_func(append, &bytes, i.width, i.height, i.channels, topDown(i).data(), 95);
    return bytes;
}

std::string asBmp(const Image& i) {
    std::string bytes;
    stbi_write_bmp_to_func(append, &bytes, i.width, i.height, i.channels, topDown(i).data());
    return bytes;
}

std::string asTga(const Image& i) {
    std::string bytes;
    stbi_write_tga_to_func(append, &bytes, i.width, i.height, i.channels, topDown(i).data());
    return bytes;
}

std::string bigEndian(std::uint32_t value, int size) {
    std::string bytes;
    for (int shift = 8 * (size - 1); shift >= 0; shift -= 8)
        bytes += static_cast<char>(value >> shift & 0xff);
    return bytes;
}

std::string asPsd(const Image& image) {
    std::string bytes = "8BPS" + bigEndian(1, 2) + std::string(6, '\0') +
                        bigEndian(static_cast<std::uint32_t>(image.channels), 2) +
                        bigEndian(static_cast<std::uint32_t>(image.height), 4) +
                        bigEndian(static_cast<std::uint32_t>(image.width), 4) + bigEndian(8, 2) +
                        bigEndian(3, 2) + std::string(12, '\0') + bigEndian(0, 2);
    const std::vector<unsigned char> pixels = topDown(image);
    for (int c = 0; c < image.channels; ++c)
        for (std::size_t i = static_cast<std::size_t>(c); i < pixels.size(); i += image.pixelSize())
            bytes += static_cast<char>(pixels[i]);
    return bytes;
}

template <class T>
std::string bytesOf(const T& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]};
}

constexpr std::int32_t kMagic = static_cast<std::int32_t>(0xCAFEBABE);

std::string raw(const std::vector<float>& values, std::vector<std::int32_t> trailer) {
    return bytesOf(values) + bytesOf(trailer);
}

std::string asHdr(const Image& image) {
    std::vector<float> topDown;
    for (int y = image.height - 1; y >= 0; --y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < image.channels; ++c)
                topDown.push_back(image.value(x, y, c));
    std::string bytes;
    stbi_write_hdr_to_func(append, &bytes, image.width, image.height, image.channels,
                           topDown.data());
    return bytes;
}

std::optional<Image> decode(std::string_view bytes, Diagnostics& diagnostics) {
    return decodeImage(bytes, "image", diagnostics, {});
}

Image decodeGood(std::string_view bytes) {
    Diagnostics diagnostics;
    const std::optional<Image> image = decode(bytes, diagnostics);
    for (const Diagnostic& d : diagnostics.all())
        MESSAGE(toString(d));
    REQUIRE(image);
    return *image;
}

void checkDamaged(std::string_view bytes, std::string_view messagePart = {}) {
    Diagnostics diagnostics;
    const std::optional<Image> image = decode(bytes, diagnostics);
    CHECK_FALSE(image);
    REQUIRE(diagnostics.all().size() == 1);
    const Diagnostic problem = diagnostics.all().front();
    CHECK(problem.code == "image-damaged");
    CHECK(problem.severity == Severity::error);
    CAPTURE(problem.message);
    CHECK(problem.message.find(messagePart) != std::string::npos);
}

struct Format {
    const char* name;
    std::string (*encode)(const Image&);
    int channels;
    int tolerance;
};

const Format kFormats[] = {
    {"PNG, grey", encodePng, 1, 0}, {"PNG, grey and alpha", encodePng, 2, 0},
    {"PNG, RGB", encodePng, 3, 0},  {"PNG, RGBA", encodePng, 4, 0},
    {"JPEG, RGB", asJpeg, 3, 8},    {"BMP, RGB", asBmp, 3, 0},
    {"BMP, RGBA", asBmp, 4, 0},     {"TGA, RGB", asTga, 3, 0},
    {"TGA, RGBA", asTga, 4, 0},     {"PSD, RGB is given an alpha", asPsd, 3, 0},
};

} // namespace

TEST_CASE("each format is decoded with row 0 at the bottom") {
    const Image picture = gradient(37, 23, 4);
    for (const Format& format : kFormats) {
        CAPTURE(format.name);
        const Image source = gradient(37, 23, format.channels);
        const Image image = decodeGood(format.encode(source));
        CHECK(image.type == PixelType::u8);
        CHECK(image.depth == 0);
        CHECK(image.channels >= format.channels);
        CHECK(image.bytes.size() == image.byteSize());
        REQUIRE(image.width == 37);
        REQUIRE(image.height == 23);
        const PictureDifference difference = comparePictures(image, source);
        CHECK(difference.maximum <= format.tolerance);
    }
}

TEST_CASE("a Radiance HDR is decoded to floats with row 0 at the bottom") {
    Image source = makeImage(16, 4, 3, PixelType::f32);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 16; ++x) {
            const float pixel[] = {static_cast<float>(x), static_cast<float>(100 * (3 - y)), 50};
            std::memcpy(source.row(y) + 12 * x, pixel, sizeof pixel);
        }
    }
    const std::string bytes = asHdr(source);
    const Image image = decodeGood(bytes);
    REQUIRE(image.type == PixelType::f32);
    REQUIRE(image.channels == 3);
    REQUIRE(image.height == 4);
    // The format keeps 8 bits of the largest channel.
    CHECK(image.value(3, 0, 1) == doctest::Approx(300).epsilon(0.01));
    CHECK(image.value(3, 3, 1) == 0);
    CHECK(image.value(15, 3, 0) == doctest::Approx(15).epsilon(0.02));

    for (std::size_t length = 0; length < bytes.size(); ++length) {
        CAPTURE(length);
        checkDamaged(std::string_view(bytes).substr(0, length));
    }
}

TEST_CASE("a raw float image is taken as it is") {
    const Image image = decodeGood(raw({1, 2, 3, 4, 5, 6, 7, 8}, {kMagic, 2, 4, 2, 1}));
    CHECK(image.type == PixelType::f32);
    CHECK(image.width == 2);
    CHECK(image.height == 4);
    CHECK(image.depth == 2);
    CHECK(image.channels == 1);
    CHECK(image.value(0, 0, 0) == 1);
    CHECK(image.value(1, 3, 0) == 8);
}

TEST_CASE("a raw float image whose trailer does not fit is damaged") {
    struct Row {
        const char* name;
        std::vector<std::int32_t> trailer;
    };
    const int huge = 0x7fffffff;
    const Row rows[] = {
        {"no width", {kMagic, 0, 4, 0, 1}},
        {"negative height", {kMagic, 2, -4, 0, 1}},
        {"no channels", {kMagic, 2, 4, 0, 0}},
        {"five channels", {kMagic, 2, 4, 0, 5}},
        {"negative depth", {kMagic, 2, 4, -1, 1}},
        {"a height that is no multiple of the depth", {kMagic, 2, 4, 3, 1}},
        {"one row too many", {kMagic, 2, 5, 0, 1}},
        {"one row too few", {kMagic, 2, 3, 0, 1}},
        {"a size whose product overflows", {kMagic, huge, huge, 0, 4}},
        {"a size whose product wraps to the right one", {kMagic, 1 << 30, 1 << 30, 0, 4}},
        {"a size beyond memory", {kMagic, 1 << 15, 1 << 15, 0, 1}},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        checkDamaged(raw({1, 2, 3, 4, 5, 6, 7, 8}, row.trailer));
    }
    checkDamaged(raw({}, {kMagic, 1, 1, 0, 1}), "0 bytes before the trailer");
}

TEST_CASE("an image that ends too early is damaged") {
    for (const Format& format : kFormats) {
        CAPTURE(format.name);
        const std::string bytes = format.encode(gradient(37, 23, format.channels));
        for (const std::size_t length :
             {std::size_t{0}, std::size_t{1}, std::size_t{17}, bytes.size() / 4, bytes.size() / 2,
              bytes.size() * 9 / 10}) {
            CAPTURE(length);
            checkDamaged(std::string_view(bytes).substr(0, length));
        }
    }
}

TEST_CASE("a colour that a palette does not have is black, whatever was in memory before") {
    const auto little = [](std::uint32_t value) {
        const std::string bytes = bigEndian(value, 4);
        return std::string(bytes.rbegin(), bytes.rend());
    };
    // A BMP of 4 x 1 pixels of 8 bits; the palette has one colour, (3, 2, 1).
    const std::string bytes = "BM" + little(62) + little(0) + little(58) + little(40) + little(4) +
                              little(1) + little(8 << 16 | 1) + little(0) + little(4) + little(0) +
                              little(0) + little(1) + little(0) + std::string("\1\2\3\0", 4) +
                              std::string("\0\1\x80\xff", 4);
    const Image image = decodeGood(bytes);
    CHECK(image.bytes == std::vector<unsigned char>{3, 2, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0});
}

TEST_CASE("an image that claims an absurd size is refused before memory is taken") {
    std::string png = encodePng(gradient(4, 4, 3));
    const auto withSize = [&](std::uint32_t width, std::uint32_t height) {
        // The header chunk's data start at byte 16; stb_image does not check its checksum.
        return png.substr(0, 16) + bigEndian(width, 4) + bigEndian(height, 4) + png.substr(24);
    };
    checkDamaged(withSize(1 << 20, 1 << 20));
    checkDamaged(withSize(60000, 60000));
    checkDamaged(withSize(17000, 17000), "too many");
    checkDamaged(withSize(10000, 10000), "too short");
    checkDamaged(withSize(0, 4));
    std::string bmp = asBmp(gradient(4, 4, 3));
    bmp.replace(18, 8, std::string("\xff\xff\x00\x00\xff\xff\x00\x00", 8));
    checkDamaged(bmp);
}

TEST_CASE("what is no image says which formats there are") {
    checkDamaged("", "not an image");
    checkDamaged("<?xml version=\"1.0\"?><archive/>", "not an image");
    checkDamaged(std::string(100, '\0'));
    Diagnostics diagnostics;
    const auto file = std::make_shared<SourceFile>("a.xml", "<texture2D source='x.png'/>");
    CHECK_FALSE(decodeImage("text", "x.png", diagnostics, Place{file, 19}));
    CHECK(toString(diagnostics.all().front()).starts_with("a.xml:1:20: error: can't read 'x.png'"));
    CHECK(diagnostics.all().front().expected == "JPEG, PNG, BMP, TGA, PSD, HDR or raw float");
}

TEST_CASE("damaged bytes never do harm") {
    // Under the address sanitizer this is what finds a decoder that reads or writes out of bounds.
    std::mt19937 random(1);
    std::vector<Format> formats(std::begin(kFormats), std::end(kFormats));
    formats.push_back({"HDR", asHdr, 3, 0});
    for (const Format& format : formats) {
        CAPTURE(format.name);
        const std::string good = format.encode(gradient(19, 13, format.channels));
        for (int round = 0; round < 200; ++round) {
            std::string bytes = good;
            for (unsigned i = 0; i <= random() % 8; ++i)
                bytes[random() % bytes.size()] = static_cast<char>(random());
            if (round % 4 == 0) bytes.resize(random() % bytes.size());
            Diagnostics diagnostics;
            const std::optional<Image> image = decode(bytes, diagnostics);
            CHECK(image.has_value() == (diagnostics.errors() == 0));
            if (image) CHECK(image->bytes.size() == image->byteSize());
        }
    }
}

TEST_CASE("PNG files have the same bytes each time, and come back as they were") {
    const Image picture = gradient(64, 48, 3);
    const std::string bytes = encodePng(picture);
    CHECK(bytes == encodePng(picture));
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / "picture.png";
    REQUIRE(writePng(file, picture));
    CHECK(readFile(file) == bytes);
    CHECK_FALSE(writePng("/nowhere/at/all.png", picture));
    CHECK(decodeGood(bytes).bytes == picture.bytes);
}

TEST_CASE("pictures are compared as the eye would") {
    const Image picture = gradient(50, 40, 3);
    SUBCASE("equal pictures") {
        const PictureDifference d = comparePictures(picture, picture);
        CHECK(d.agree(0));
        CHECK(d.maximum == 0);
        CHECK(d.firstX == -1);
        CHECK(d.toString() == "the pictures are equal");
    }
    SUBCASE("rounding is no difference") {
        Image other = picture;
        for (unsigned char& byte : other.bytes)
            byte = static_cast<unsigned char>(byte + kPictureTolerance);
        const PictureDifference d = comparePictures(other, picture);
        CHECK(d.agree(0));
        CHECK(d.maximum == 5);
        CHECK(d.mean == doctest::Approx(5));
    }
    SUBCASE("two pixels of 2000 are a share of 0.1 percent, three are more") {
        Image other = picture;
        other.row(39)[3 * 7 + 1] += 6; // the top row
        other.row(0)[3 * 49 + 2] += 100;
        PictureDifference d = comparePictures(other, picture);
        CHECK(d.share == doctest::Approx(0.001));
        CHECK(d.agree());
        CHECK(d.maximum == 100);
        CHECK(d.firstX == 7);
        CHECK(d.firstY == 0);
        other.row(20)[0] += 6;
        d = comparePictures(other, picture);
        CHECK_FALSE(d.agree());
        CHECK(d.toString() == "0.15 % of the pixels differ by more than 5/255 (at most 100, mean "
                              "0.0187), the first at 7,0 from the top left");
    }
    SUBCASE("another size") {
        const PictureDifference d = comparePictures(gradient(49, 40, 3), picture);
        CHECK_FALSE(d.sameSize);
        CHECK_FALSE(d.agree());
    }
    SUBCASE("a missing alpha is opaque") {
        Image other = makeImage(50, 40, 4);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 50; ++x) {
                std::memcpy(other.row(y) + 4 * x, picture.row(y) + 3 * x, 3);
                other.row(y)[4 * x + 3] = 255;
            }
        CHECK(comparePictures(other, picture).maximum == 0);
        other.row(5)[3] = 0;
        CHECK(comparePictures(other, picture).maximum == 255);
    }
}

TEST_CASE("a difference image shows where pictures differ") {
    const Image expected = gradient(10, 8, 3);
    Image actual = expected;
    actual.row(2)[3 * 4] += 50;
    const Image difference = differenceImage(actual, expected);
    REQUIRE(difference.width == 10);
    REQUIRE(difference.height == 8);
    CHECK(difference.value(4, 2, 0) > 0.5f);
    CHECK(difference.value(4, 2, 1) == 0);
    CHECK(difference.value(5, 2, 1) > 0.5f);
    SUBCASE("also where one of them has no pixel") {
        const Image larger = differenceImage(gradient(9, 7, 3), gradient(10, 8, 3));
        CHECK(larger.value(9, 7, 1) == 0);
        CHECK(larger.value(0, 0, 1) == 0); // the pictures' top left corners stand together
    }
}
