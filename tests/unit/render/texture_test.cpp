// SPDX-License-Identifier: BSD-3-Clause
#include "gl_fixture.h"
#include "render/texture.h"

#include <glad/gl.h>

#include <cstring>
#include <numeric>

namespace terrane {

namespace {

using Bytes = std::vector<std::byte>;

template <class T>
Bytes bytesOf(const std::vector<T>& values) {
    Bytes bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

/// Distinct small values that every format can hold: 0 and 1 for reals, else small integers.
Bytes pattern(const InternalFormatInfo& format, const TextureRegion& region) {
    const std::size_t size =
        std::size_t(region.width * region.height * region.depth) * format.transfer.pixelSize();
    Bytes bytes(size);
    if (format.transfer.type == TransferType::f32) {
        std::vector<float> values(size / 4);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = float(i % 2);
        return bytesOf(values);
    }
    if (format.transfer.type == TransferType::f16) {
        std::vector<std::uint16_t> values(size / 2);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = i % 2 ? 0x3C00 : 0; // 1 or 0
        return bytesOf(values);
    }
    if (format.transfer.type == TransferType::f32u24u8) {
        std::vector<std::uint32_t> values(size / 4);
        for (std::size_t i = 0; i < values.size(); i += 2) {
            values[i] = i % 4 ? 0x3F800000U : 0;
            values[i + 1] = std::uint32_t(i % 200);
        }
        return bytesOf(values);
    }
    if (format.integer() || format.kind == ChannelKind::stencil) {
        const std::size_t channel =
            format.transfer.pixelSize() / std::size_t(channelCount(format.transfer.format));
        // 0 to 2 fits the 2 bits of RGB10_A2UI's alpha, too.
        for (std::size_t i = 0; i < size; i += channel)
            bytes[i] = std::byte(i / channel % 3);
        return bytes;
    }
    // All bits or none: 0 or 1 whatever the number of bits (-1/127 when signed).
    const std::size_t pixel = format.transfer.pixelSize();
    for (std::size_t i = 0; i < size; ++i)
        bytes[i] = std::byte(i / pixel % 2 ? 0xFF : 0);
    return bytes;
}

} // namespace

TEST_CASE_FIXTURE(GlFixture, "Each internal format gives back what was uploaded") {
    for (const auto& format : internalFormats()) {
        CAPTURE(format.name);
        const TextureDescription description{.format = format.value, .width = 8, .height = 4};
        CHECK(Texture::problem(*context, description) == "");
        Texture texture(*context, description);
        CHECK(diagnostics.errors() == 0);
        const Bytes pixels = pattern(format, texture.region());
        texture.upload(format.transfer, pixels);
        const Bytes read = texture.download(texture.region());
        CHECK(read.size() == pixels.size());
        // Compression of a checkered pattern is not exact.
        if (!format.compressed) CHECK(read == pixels);
        texture.clear();
    }
}

TEST_CASE_FIXTURE(GlFixture, "Compressed formats keep a uniform colour") {
    for (const auto& format : internalFormats()) {
        if (!format.compressed || format.transfer.type != TransferType::u8) continue;
        CAPTURE(format.name);
        Texture texture(*context, {.format = format.value, .width = 10, .height = 6});
        const std::size_t size = 60 * format.transfer.pixelSize();
        texture.upload(format.transfer, Bytes(size, std::byte(255)));
        const Bytes read = texture.download(texture.region());
        CHECK(read == Bytes(size, std::byte(255)));
    }
}

TEST_CASE_FIXTURE(GlFixture, "Blocks that are compressed already are taken as they are") {
    Texture texture(*context, {.format = findInternalFormat("COMPRESSED_RGB_S3TC_DXT1_EXT")->value,
                               .width = 4,
                               .height = 4});
    // Two equal end points of pure red in 5:6:5.
    Bytes block(8);
    block[1] = block[3] = std::byte(0xF8);
    texture.uploadCompressed(texture.region(), block);
    const Bytes read = texture.download(texture.region(), {TransferFormat::rgb, TransferType::u8});
    CHECK(read[0] == std::byte(255));
    CHECK(read[1] == std::byte(0));
}

TEST_CASE_FIXTURE(GlFixture, "Rows need no alignment") {
    // 3 pixels of 3 bytes: a row of 9 bytes comes out skewed if rows are aligned to 4.
    Texture texture(*context, {.format = InternalFormat::rgb8, .width = 3, .height = 3});
    std::vector<unsigned char> values(27);
    std::iota(values.begin(), values.end(), 1);
    texture.upload({TransferFormat::rgb, TransferType::u8}, bytesOf(values));
    CHECK(texture.download(texture.region()) == bytesOf(values));
}

TEST_CASE_FIXTURE(GlFixture, "Each target has its layers, slices or faces in z") {
    struct Row {
        const char* name;
        TextureDescription description;
        int z;
    };
    const InternalFormat format = InternalFormat::r8;
    const std::vector<Row> rows{
        {"1D", {TextureTarget::texture1D, format, 4}, 1},
        {"1D array", {TextureTarget::texture1DArray, format, 4, 1, 1, 3}, 3},
        {"2D", {TextureTarget::texture2D, format, 4, 4}, 1},
        {"2D array", {TextureTarget::texture2DArray, format, 4, 4, 1, 5}, 5},
        {"3D", {TextureTarget::texture3D, format, 4, 4, 7}, 7},
        {"cube", {TextureTarget::cube, format, 4, 4}, 6},
        {"cube array", {TextureTarget::cubeArray, format, 4, 4, 1, 2}, 12},
        {"rectangle", {TextureTarget::rectangle, format, 4, 4}, 1},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        Texture texture(*context, row.description,
                        {.min = MinFilter::linearMipmapLinear, .wrapS = Wrap::repeat});
        CHECK(diagnostics.errors() == 0);
        CHECK(texture.zCount() == row.z);
        CHECK(texture.levels() == (row.description.target == TextureTarget::rectangle ? 1 : 3));
        const auto whole = texture.region();
        texture.upload({TransferFormat::red, TransferType::u8},
                       Bytes(std::size_t(whole.width * whole.height * whole.depth)));
        // One layer is written, and only that one changes.
        TextureRegion layer = whole;
        layer.z = row.z - 1;
        layer.depth = 1;
        const std::size_t size = std::size_t(layer.width * layer.height);
        texture.upload(layer, {TransferFormat::red, TransferType::u8}, Bytes(size, std::byte(9)));
        CHECK(texture.download(layer) == Bytes(size, std::byte(9)));
        if (row.z > 1) {
            layer.z = 0;
            CHECK(texture.download(layer) == Bytes(size));
        }
    }
}

TEST_CASE_FIXTURE(GlFixture, "The faces of a cube are uploaded as +X -X +Y -Y +Z -Z") {
    Texture texture(*context, {TextureTarget::cube, InternalFormat::r8, 1, 1});
    texture.upload({TransferFormat::red, TransferType::u8},
                   bytesOf(std::vector<unsigned char>{1, 2, 3, 4, 5, 6}));
    for (unsigned face = 0; face < 6; ++face) {
        // The old entry point says which face by its name.
        unsigned char value = 0;
        const auto& gl = context->gl();
        gl.BindTexture(GL_TEXTURE_CUBE_MAP, texture.name());
        gl.GetTexImage(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RED, GL_UNSIGNED_BYTE, &value);
        gl.BindTexture(GL_TEXTURE_CUBE_MAP, 0);
        CHECK(value == face + 1);
    }
}

TEST_CASE_FIXTURE(GlFixture, "Mipmaps follow the first level when the filter uses them") {
    Texture texture(*context, {.format = InternalFormat::r8, .width = 4, .height = 2},
                    {.min = MinFilter::linearMipmapLinear});
    CHECK(texture.levels() == 3);
    texture.upload({TransferFormat::red, TransferType::u8}, Bytes(8, std::byte(200)));
    const auto last = texture.region(2);
    CHECK(last.width == 1);
    CHECK(last.height == 1);
    CHECK(texture.download(last) == Bytes(1, std::byte(200)));

    Texture plain(*context, {.format = InternalFormat::r8, .width = 4, .height = 2});
    CHECK(plain.levels() == 1);
}

TEST_CASE_FIXTURE(GlFixture, "Resizing makes new storage, and only when the size differs") {
    Texture texture(*context, {.width = 4, .height = 4}, {.min = MinFilter::linearMipmapLinear});
    const auto serial = texture.serial();
    texture.resize(4, 4);
    CHECK(texture.serial() == serial);
    texture.resize(16, 8);
    CHECK(texture.serial() != serial);
    CHECK(texture.width() == 16);
    CHECK(texture.levels() == 5);
    CHECK(texture.download(texture.region()).size() == 16 * 8 * 4);
    CHECK(context->objectCount() == 1);
}

TEST_CASE_FIXTURE(GlFixture, "A texture that moves takes its GL name along") {
    Texture first(*context, {.width = 2, .height = 2});
    const unsigned name = first.name();
    Texture second(std::move(first));
    CHECK(second.name() == name);
    CHECK(first.name() == 0);
    CHECK(context->objectCount() == 1);
    second = Texture(*context, {.width = 3, .height = 3});
    CHECK(second.width() == 3);
    CHECK(context->objectCount() == 1);
}

TEST_CASE_FIXTURE(GlFixture, "Sampling parameters reach OpenGL") {
    Texture texture(*context, {.format = InternalFormat::depth32f, .width = 4, .height = 4},
                    {.min = MinFilter::linear,
                     .mag = MagFilter::nearest,
                     .wrapS = Wrap::clampToBorder,
                     .wrapT = Wrap::mirroredRepeat,
                     .wrapR = Wrap::repeat,
                     .minLod = -2,
                     .maxLod = 5,
                     .bias = 0.5F,
                     .minLevel = 0,
                     .maxLevel = 3,
                     .anisotropy = 16,
                     .swizzle = {Swizzle::blue, Swizzle::zero, Swizzle::one, Swizzle::red},
                     .compare = CompareFunction::lequal,
                     .borderType = BorderType::real,
                     .border = {0.25, 0.5, 0.75, 1}});
    const auto integer = [&](unsigned parameter) {
        GLint value = 0;
        context->gl().GetTextureParameteriv(texture.name(), parameter, &value);
        return value;
    };
    const auto real = [&](unsigned parameter) {
        GLfloat value = 0;
        context->gl().GetTextureParameterfv(texture.name(), parameter, &value);
        return value;
    };
    CHECK(integer(GL_TEXTURE_MIN_FILTER) == GL_LINEAR);
    CHECK(integer(GL_TEXTURE_MAG_FILTER) == GL_NEAREST);
    CHECK(integer(GL_TEXTURE_WRAP_S) == GL_CLAMP_TO_BORDER);
    CHECK(integer(GL_TEXTURE_WRAP_T) == GL_MIRRORED_REPEAT);
    CHECK(integer(GL_TEXTURE_WRAP_R) == GL_REPEAT);
    CHECK(real(GL_TEXTURE_MIN_LOD) == -2);
    CHECK(real(GL_TEXTURE_MAX_LOD) == 5);
    CHECK(real(GL_TEXTURE_LOD_BIAS) == 0.5F);
    CHECK(real(GL_TEXTURE_MAX_ANISOTROPY) == 1); // the cap of a software renderer
    CHECK(integer(GL_TEXTURE_SWIZZLE_R) == GL_BLUE);
    CHECK(integer(GL_TEXTURE_SWIZZLE_A) == GL_RED);
    CHECK(integer(GL_TEXTURE_COMPARE_MODE) == GL_COMPARE_REF_TO_TEXTURE);
    CHECK(integer(GL_TEXTURE_COMPARE_FUNC) == GL_LEQUAL);
    GLfloat border[4];
    context->gl().GetTextureParameterfv(texture.name(), GL_TEXTURE_BORDER_COLOR, border);
    CHECK(border[0] == 0.25F);
    CHECK(border[2] == 0.75F);
}

TEST_CASE_FIXTURE(GlFixture, "Impossible textures are told apart before they are made") {
    struct Row {
        const char* name;
        TextureDescription description;
        const char* problem;
    };
    const InternalFormat compressed = findInternalFormat("COMPRESSED_RGBA")->value;
    const std::vector<Row> rows{
        {"no width", {.width = 0}, "at least 1"},
        {"too wide", {.width = 1 << 20}, "larger than"},
        {"too many layers", {.target = TextureTarget::texture2DArray, .layers = 1 << 20}, "layers"},
        {"oblong cube", {.target = TextureTarget::cube, .width = 4, .height = 3}, "square"},
        {"compressed line", {.target = TextureTarget::texture1D, .format = compressed}, "1D"},
        {"deep depth",
         {.target = TextureTarget::texture3D, .format = InternalFormat::depth24},
         "3D"},
        {"too many levels", {.width = 4, .height = 4, .levels = 4}, "levels"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        CHECK(Texture::problem(*context, row.description).find(row.problem) != std::string::npos);
    }
}

TEST_CASE_FIXTURE(GlFixture, "A texture that no memory can hold is told") {
    const Texture texture(*context, {.target = TextureTarget::texture2DArray,
                                     .format = InternalFormat::rgba32f,
                                     .width = 16384,
                                     .height = 16384,
                                     .layers = 2048});
    CHECK_FALSE(texture.allocated());
    // Whoever made it tells that, with a place; the driver's own words are left out.
    CHECK(diagnostics.all().empty());
}

TEST_CASE("Formats are found by their words") {
    CHECK(findInternalFormat("RGBA8")->value == InternalFormat::rgba8);
    CHECK(findInternalFormat("R8_SNORM") == findInternalFormat("R8SNORM"));
    CHECK(findInternalFormat("I32F") == nullptr);
    CHECK(internalFormatWords().size() >= internalFormats().size());
    CHECK(transferTypeWords().size() == 24);
    CHECK(TransferLayout{TransferFormat::rgb, TransferType::u16x565}.pixelSize() == 2);
    CHECK(TransferLayout{TransferFormat::rgba, TransferType::u32x2101010Reversed}.pixelSize() == 4);
    CHECK(TransferLayout{TransferFormat::rgb, TransferType::u8x332}.pixelSize() == 1);
    CHECK(TransferLayout{TransferFormat::bgr, TransferType::u16}.pixelSize() == 6);
    CHECK(transferLayout(*findInternalFormat("RG8UI"), 3, TransferType::u8) ==
          TransferLayout{TransferFormat::rgbInteger, TransferType::u8});
    CHECK(transferLayout(formatInfo(InternalFormat::depth24), 1, TransferType::u8).format ==
          TransferFormat::depth);
}

} // namespace terrane
