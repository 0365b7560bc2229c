// SPDX-License-Identifier: BSD-3-Clause
#include "render/texture_resource.h"

#include "core/image.h"
#include "gl_archive.h"
#include "render/texture.h"

#include <cstring>

namespace terrane {

namespace {

using Bytes = std::vector<std::byte>;

struct TextureFixture : GlArchive {
    TextureFixture() { declareTextures(registry); }

    /// A picture whose rows, counted from the bottom, hold 10, 20, 30... in every channel.
    void picture(const std::string& name, int width, int height, int channels) {
        Image image = makeImage(width, height, channels);
        for (int y = 0; y < height; ++y)
            std::memset(image.row(y), 10 * (y + 1), image.rowSize());
        writePng(folder / name, image);
    }
    /// A raw float file of the numbers 0, 1, 2...
    void floats(const std::string& name, int width, int height, int depth, int channels) {
        std::string bytes;
        for (int i = 0; i < width * height * channels; ++i) {
            const auto value = float(i);
            bytes.append(reinterpret_cast<const char*>(&value), 4);
        }
        const std::uint32_t trailer[] = {0xCAFEBABEU, std::uint32_t(width), std::uint32_t(height),
                                         std::uint32_t(depth), std::uint32_t(channels)};
        bytes.append(reinterpret_cast<const char*>(trailer), sizeof trailer);
        writeFile(folder / name, bytes);
    }
    Texture* texture(const std::string& tag, const std::string& attributes) {
        return load<Texture>("<" + tag + " name=\"t\" " + attributes + "/>", "t");
    }
    int byteAt(const Texture& texture, const TextureRegion& pixel) {
        return int(texture.download(pixel, {TransferFormat::red, TransferType::u8})[0]);
    }
    float floatAt(const Texture& texture, const TextureRegion& pixel) {
        float value = 0;
        const auto bytes = texture.download(pixel, {TransferFormat::red, TransferType::f32});
        std::memcpy(&value, bytes.data(), 4);
        return value;
    }
};

} // namespace

TEST_CASE_FIXTURE(TextureFixture, "A texture without a source starts zeroed, in its size") {
    struct Row {
        const char* tag;
        const char* attributes;
        TextureTarget target;
        int width, height, depth, layers;
    };
    using T = TextureTarget;
    for (const Row& row : {
             Row{"texture1D", "width='4'", T::texture1D, 4, 1, 1, 1},
             Row{"texture1DArray", "width='4' height='3'", T::texture1DArray, 4, 1, 1, 3},
             Row{"texture2D", "width='4' height='3'", T::texture2D, 4, 3, 1, 1},
             Row{"texture2DArray", "width='4' height='6' depth='3'", T::texture2DArray, 4, 2, 1, 3},
             Row{"texture2DArray", "width='4' height='6' layers='2'", T::texture2DArray, 4, 3, 1,
                 2},
             Row{"texture2DArray", "width='4' height='6' layers='2' depth='6'", T::texture2DArray,
                 4, 1, 1, 6},
             Row{"texture3D", "width='4' height='6' depth='2'", T::texture3D, 4, 3, 2, 1},
             Row{"textureCube", "width='2' height='12'", T::cube, 2, 2, 1, 1},
             Row{"textureCubeArray", "width='2' height='24'", T::cubeArray, 2, 2, 1, 2},
             Row{"textureRectangle", "width='4' height='3'", T::rectangle, 4, 3, 1, 1},
         }) {
        CAPTURE(row.tag);
        CAPTURE(row.attributes);
        Texture* t = texture(row.tag, std::string("internalformat='R8' format='RED' "
                                                  "type='UNSIGNED_BYTE' ") +
                                          row.attributes);
        CHECK(told() == "");
        REQUIRE(t);
        CHECK(t->description().target == row.target);
        CHECK(t->width() == row.width);
        CHECK(t->height() == row.height);
        CHECK(t->description().depth == row.depth);
        CHECK(t->description().layers == row.layers);
        CHECK(byteAt(*t, {.z = t->zCount() - 1}) == 0);
    }
}

TEST_CASE_FIXTURE(TextureFixture, "Pictures are stacked with the first at the bottom") {
    picture("faces.png", 1, 12, 1);
    struct Row {
        const char* tag;
        const char* attributes;
        int z, value;
    };
    for (const Row& row : {
             Row{"texture1D", "", 0, 10},
             Row{"texture1DArray", "", 11, 120},
             Row{"texture2D", "", 0, 10},
             Row{"texture2DArray", "layers='4'", 3, 100},
             Row{"texture3D", "depth='6'", 5, 110},
             Row{"textureCube", "height='6'", 5, 60},
             Row{"textureCubeArray", "", 11, 120},
             Row{"textureRectangle", "", 0, 10},
         }) {
        CAPTURE(row.tag);
        Texture* t = texture(row.tag, std::string("source='faces.png' internalformat='R8' ") +
                                          row.attributes);
        CHECK(told() == "");
        REQUIRE(t);
        CHECK(byteAt(*t, {.z = row.z}) == row.value);
    }
}

TEST_CASE_FIXTURE(TextureFixture, "Raw float files supply sizes, slices and type") {
    floats("volume.raw", 2, 6, 3, 1);
    Texture* t = texture("texture3D", "source='volume.raw' internalformat='R32F'");
    REQUIRE(t);
    CHECK(t->width() == 2);
    CHECK(t->height() == 2);
    CHECK(t->description().depth == 3);
    CHECK(floatAt(*t, {.x = 1, .y = 1, .z = 2}) == 11);
    CHECK(told() == "");

    floats("table.raw", 3, 5, 0, 2);
    t = texture("texture2D", "source='table.raw' internalformat='RG16F' format='RG' type='FLOAT'");
    REQUIRE(t);
    CHECK(floatAt(*t, {.x = 2, .y = 1}) == 10);
    CHECK(told() == "");
}

TEST_CASE_FIXTURE(TextureFixture, "Files fill integer, depth and compressed textures") {
    picture("grey.png", 4, 4, 1);
    picture("colour.png", 4, 4, 3);
    Texture* t = texture("texture2D", "source='grey.png' internalformat='R8UI'");
    REQUIRE(t);
    CHECK(t->download({.y = 2})[0] == std::byte(30));
    t = texture("texture2D", "source='grey.png' internalformat='DEPTH_COMPONENT32F'");
    REQUIRE(t);
    t = texture("texture2D", "source='colour.png' internalformat='COMPRESSED_RGB'");
    REQUIRE(t);
    CHECK(int(t->download(t->region())[0]) < 25); // the first row is 10
    CHECK(told() == "");
}

TEST_CASE_FIXTURE(TextureFixture, "The names of pictures and scratch targets are textures") {
    picture("rock.png", 8, 4, 3);
    read("");
    Texture* rock = get<Texture>("rock.png");
    REQUIRE(rock);
    CHECK(rock->format().name == "RGBA8");
    CHECK(rock->levels() == 4);
    CHECK(rock->sampling().wrapT == Wrap::repeat);

    for (const char* name : {"renderbuffer-64-RGBA32F", "renderbuffer-64-DEPTH_COMPONENT24",
                             "renderbuffer-64-R32UI-a"}) {
        CAPTURE(name);
        Texture* scratch = get<Texture>(name);
        REQUIRE(scratch);
        CHECK(scratch->width() == 64);
        CHECK(scratch->height() == 64);
        CHECK(scratch->sampling().mag == MagFilter::nearest);
    }
    CHECK(get<Texture>("renderbuffer-64-RGBA8-a") != get<Texture>("renderbuffer-64-RGBA8-b"));
    CHECK(get<Texture>("renderbuffer-64-RGBA8-a") == get<Texture>("renderbuffer-64-RGBA8-a"));
    CHECK(told() == "");
}

TEST_CASE_FIXTURE(TextureFixture, "Sampling attributes reach the texture") {
    Texture* t = texture("texture2D",
                         "internalformat='DEPTH_COMPONENT24' width='8' height='8' "
                         "format='DEPTH_COMPONENT' type='UNSIGNED_INT' "
                         "min='LINEAR_MIPMAP_NEAREST' mag='NEAREST' wraps='REPEAT' "
                         "wrapt='MIRRORED_REPEAT' minLod='-1' maxLod='2' minLevel='1' maxLevel='3' "
                         "bias='0.5' maxAniso='4' swizzle='rrr1' compare='LEQUAL' "
                         "borderType='FLOAT' borderr='1' borderg='0.5' borderb='0' bordera='1'");
    REQUIRE(t);
    const SamplingParameters& s = t->sampling();
    CHECK(s.min == MinFilter::linearMipmapNearest);
    CHECK(s.mag == MagFilter::nearest);
    CHECK(s.wrapS == Wrap::repeat);
    CHECK(s.wrapT == Wrap::mirroredRepeat);
    CHECK(s.minLod == -1);
    CHECK(s.maxLod == 2);
    CHECK(s.minLevel == 1);
    CHECK(s.maxLevel == 3);
    CHECK(s.bias == 0.5F);
    CHECK(s.anisotropy == 4);
    CHECK(s.swizzle == std::array{Swizzle::red, Swizzle::red, Swizzle::red, Swizzle::one});
    CHECK(s.compare == CompareFunction::lequal);
    CHECK(s.border == glm::dvec4(1, 0.5, 0, 1));
    CHECK(told() == "");
}

TEST_CASE_FIXTURE(TextureFixture, "What is wrong with a texture is told at its place") {
    picture("a.png", 4, 7, 3);
    floats("f.raw", 4, 4, 0, 1);
    struct Row {
        const char* element;
        std::string told;
    };
    for (const Row& row : {
             Row{"<texture2D name='t' width='4' height='4' F/>", "missing-attribute 1"},
             Row{"<texture2D name='t' internalformat='R8' width='4' height='4'/>",
                 "missing-attribute 1, missing-attribute 1"},
             Row{"<texture2D name='t' internalformat='RGBA8' F/>",
                 "missing-attribute 1, missing-attribute 1"},
             Row{"<texture3D name='t' internalformat='R8' width='4' height='4' F/>",
                 "missing-attribute 1"},
             Row{"<texture2D name='t' internalformat='I32F' width='4' height='4' F/>",
                 "unknown-word 37"},
             Row{"<texture2D name='t' internalformat='R8' width='4' height='4' wraps='CLAMP' F/>",
                 "unknown-word 69"},
             Row{"<texture2D name='t' internalformat='R8' width='0' height='4' F/>",
                 "out-of-range 48"},
             Row{"<texture2D name='t' internalformat='R8' width='4' height='99999' F/>",
                 "bad-texture 1"},
             Row{"<texture1D name='t' internalformat='R8' width='4' wrapt='REPEAT' F/>",
                 "unknown-attribute 51"},
             Row{"<textureCube name='t' internalformat='R8' width='4' height='20' F/>",
                 "bad-texture 61"},
             Row{"<texture2DArray name='t' internalformat='R8' width='4' height='7' layers='2' F/>",
                 "bad-texture 64"},
             Row{"<texture2D name='t' internalformat='R8' width='4' height='4' swizzle='rgbx' F/>",
                 "wrong-kind 71"},
             Row{"<texture2D name='t' internalformat='R8' source='none.png'/>", "file-missing 49"},
             Row{"<texture2D name='t' internalformat='R8' source='archive.xml'/>",
                 "image-damaged 49"},
             Row{"<texture2D name='t' internalformat='R8UI' source='f.raw'/>", "bad-texture 51"},
             Row{"<texture2D name='t' internalformat='DEPTH_COMPONENT24' source='a.png'/>",
                 "bad-texture 64"},
             Row{"<texture2D name='t' internalformat='R8' source='a.png' height='8'/>",
                 "bad-texture 49"},
             Row{"<textureCube name='t' internalformat='R8' source='a.png'/>", "bad-texture 51"},
         }) {
        CAPTURE(row.element);
        std::string element = row.element; // F: what each texture without a source needs
        if (const auto at = element.find("F/>"); at != std::string::npos)
            element.replace(at, 1, "format='RED' type='FLOAT'");
        CHECK_FALSE(load<Texture>(element, "t"));
        CHECK(told() == row.told);
    }
}

TEST_CASE_FIXTURE(TextureFixture, "What a file overrules is warned of") {
    picture("a.png", 4, 4, 3);
    Texture* t = load<Texture>("<texture2D name='t' internalformat='RGBA8' source='a.png' "
                               "width='5' format='RGBA' type='FLOAT'/>",
                               "t");
    REQUIRE(t);
    CHECK(t->width() == 4);
    CHECK(told() == "unused-attribute 66, unused-attribute 77, unused-attribute 89");
    t = load<Texture>("<texture2D name='t' internalformat='RGBA8' source='a.png' format='BGR'/>",
                      "t");
    REQUIRE(t);
    CHECK(told() == "");
}

} // namespace terrane
