// SPDX-License-Identifier: BSD-3-Clause
#include "render/font.h"

#include "core/image.h"
#include "gl_archive.h"
#include "gl_program.h"
#include "render/framebuffer.h"
#include "render/text_batch.h"
#include "render/texture_resource.h"

namespace terrane {

namespace {

struct FontFixture : GlArchive {
    FontFixture() {
        declareTextures(registry);
        declareFont(registry);
        // Tiles of 4 x 2 texels in 2 columns and 3 rows; each tile is as bright as its number.
        Image image = makeImage(8, 6, 1);
        for (int y = 0; y < 6; ++y) {
            for (int x = 0; x < 8; ++x)
                image.row(y)[x] = static_cast<unsigned char>(40 * (2 * ((5 - y) / 2) + x / 4 + 1));
        }
        writePng(folder / "tiles.png", image);
    }
    Font* font(const std::string& widths, const std::string& more = "") {
        return load<Font>("<font name='f' tex='tiles' nCols='2' nRows='3' minChar='65' "
                          "maxChar='70' invalidChar='67' charWidths='" +
                              widths + "'" + more +
                              "/>\n<texture2D name='tiles' source='tiles.png' "
                              "internalformat='R8' min='NEAREST' mag='NEAREST'/>",
                          "f");
    }
};

} // namespace

TEST_CASE_FIXTURE(FontFixture, "Characters have their tiles and advances") {
    struct Row {
        const char* widths;
        char character;
        Font::Glyph glyph;
    };
    const float third = 1 / 3.0F;
    const Row rows[] = {
        // One width: the tile is cut to it.
        {"2", 'A', {0.5F, 0.5F, 0, 0.25F, 2 * third, 1}},
        {"4", 'B', {1, 1, 0.5F, 1, 2 * third, 1}},
        {"4", 'E', {1, 1, 0, 0.5F, 0, third}},
        {"4", 'z', {1, 1, 0, 0.5F, third, 2 * third}}, // as 'C'
        // Several: whole tiles, and the last width for the rest.
        {"1,3", 'A', {1, 0.25F, 0, 0.5F, 2 * third, 1}},
        {"1,3", 'F', {1, 0.75F, 0.5F, 1, 0, third}},
    };
    for (const Row& row : rows) {
        CAPTURE(row.widths);
        CAPTURE(row.character);
        const Font* const f = font(row.widths);
        REQUIRE(f);
        const Font::Glyph glyph = f->glyph(static_cast<unsigned char>(row.character));
        CHECK(glyph.width == row.glyph.width);
        CHECK(glyph.advance == row.glyph.advance);
        CHECK(glyph.left == row.glyph.left);
        CHECK(glyph.right == row.glyph.right);
        CHECK(glyph.bottom == doctest::Approx(row.glyph.bottom));
        CHECK(glyph.top == doctest::Approx(row.glyph.top));
    }
    CHECK(font("1,3")->width("ABC") == 0.25F + 0.75F + 0.75F);
    CHECK(font("2")->tileHeight() == 2);
    CHECK(told() == "");
}

TEST_CASE_FIXTURE(FontFixture, "What is wrong with a font is told at its place") {
    struct Row {
        const char* attributes;
        const char* told;
    };
    const char* const start = "<font name='f' tex='tiles' nCols='2' nRows='3' ";
    const Row rows[] = {
        {"minChar='65' maxChar='70' invalidChar='67'", "missing-attribute 1"},
        {"minChar='70' maxChar='65' invalidChar='65' charWidths='1'", "out-of-range 70"},
        {"minChar='65' maxChar='256' invalidChar='65' charWidths='1'", "out-of-range 70"},
        {"minChar='65' maxChar='70' invalidChar='67' charWidths='1,x'", "wrong-kind 105"},
        {"minChar='65' maxChar='70' invalidChar='67' charWidths=''", "wrong-kind 103"},
        {"minChar='65' maxChar='70' invalidChar='67' charWidths='1,2,3,4,5,6,7'", "wrong-kind 103"},
        {"minChar='65' maxChar='70' invalidChar='67' charWidths='1' size='3'",
         "unknown-attribute 106"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.attributes);
        CHECK_FALSE(load<Font>(std::string(start) + row.attributes +
                                   "/>\n<texture2D name='tiles' source='tiles.png' "
                                   "internalformat='R8'/>",
                               "f"));
        CHECK(told() == row.told);
    }
    CHECK(load<Font>(std::string(start) +
                         "minChar='65' maxChar='80' invalidChar='90' charWidths='1'/>\n"
                         "<texture2D name='tiles' source='tiles.png' internalformat='R8'/>",
                     "f"));
    CHECK(told() == "out-of-range 70, out-of-range 87");
    CHECK(load<Font>(std::string(start) +
                         "minChar='65' maxChar='70' invalidChar='67' charWidths='-1'/>\n"
                         "<texture2D name='tiles' source='tiles.png' internalformat='R8'/>",
                     "f"));
    CHECK(told() == "out-of-range 103");
}

TEST_CASE_FIXTURE(FontFixture, "Text is drawn pixel by pixel where it is said to be") {
    Font* const f = font("4");
    REQUIRE(f);
    const GlProgram program(
        *context, {{GL_VERTEX_SHADER, "layout(location=0) in vec4 p; layout(location=1) in vec4 k;"
                                      "out vec2 uv; out vec4 colour; void main() { uv = p.zw; "
                                      "colour = k; gl_Position = vec4(p.xy, 0, 1); }"},
                   {GL_FRAGMENT_SHADER, "uniform sampler2D font; in vec2 uv; in vec4 colour;"
                                        "layout(location=0) out vec4 c; void main() { "
                                        "c = colour * texture(font, uv).r; }"}});
    const auto picture =
        std::make_shared<Texture>(*context, TextureDescription{.width = 16, .height = 8});
    Framebuffer target(*context);
    target.attach(AttachmentPoint::colour0, {picture});
    target.setDrawBuffers({AttachmentPoint::colour0});
    target.state.viewport = {0, 0, 16, 8};
    target.clear(Planes::colour);
    TextBatch text(*context);
    text.begin({16, 8});
    CHECK(text.empty());
    text.add(*f, "AF", {2, 4}, 4, {255, 0, 0, 255});
    text.add(*f, "?", {0, 0}, 2, {0, 255, 0, 255});
    target.use();
    program.use();
    f->texture().bind(0);
    text.draw();
    const auto pixels = picture->download(picture->region());
    const auto at = [&](int x, int y, int channel) {
        return int(pixels[std::size_t(4 * (16 * y + x) + channel)]);
    };
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 16; ++x) {
            CAPTURE(x);
            CAPTURE(y);
            const int red = y < 4 || x < 2 || x >= 10 ? 0 : x < 6 ? 40 : 240;
            CHECK(at(x, y, 0) == red);
            CHECK(at(x, y, 1) == (x < 2 && y < 2 ? 120 : 0)); // 'C' for what there is not
        }
    }
}

} // namespace terrane
