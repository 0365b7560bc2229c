// SPDX-License-Identifier: BSD-3-Clause
#include "render/font.h"

#include "resource/build_context.h"
#include "resource/registry.h"

#include <algorithm>

namespace terrane {

namespace {

constexpr int kMostTiles = 256; // one for each code

struct FontElement : ElementDescription {
    Ref<Texture> tex;
    Attr<int> nCols = 1, nRows = 1;
    Attr<int> minChar = 0, maxChar = 255, invalidChar = 0;
    Attr<std::vector<int>> charWidths;
};

void check(const FontElement& d, Diagnostics& diagnostics) {
    const int characters = *d.maxChar - *d.minChar + 1;
    if (characters < 2) {
        diagnostics.error("out-of-range", d.maxChar.place,
                          "the last character must come after the first",
                          "a 'maxChar' of more than " + std::to_string(*d.minChar));
        return;
    }
    if (characters > *d.nCols * *d.nRows) {
        diagnostics.warning("out-of-range", d.maxChar.place,
                            std::to_string(characters) + " characters in " +
                                std::to_string(*d.nCols * *d.nRows) + " tiles");
    }
    if (*d.invalidChar < *d.minChar || *d.invalidChar > *d.maxChar) {
        diagnostics.warning("out-of-range", d.invalidChar.place,
                            "the character for all others has no tile itself",
                            std::to_string(*d.minChar) + " to " + std::to_string(*d.maxChar));
    }
    const std::string expected = "one width, or one for each character";
    if (d.charWidths->empty())
        diagnostics.error("wrong-kind", d.charWidths.place, "no widths", expected);
    if (d.charWidths->size() > std::size_t(characters)) {
        diagnostics.error("wrong-kind", d.charWidths.place,
                          std::to_string(d.charWidths->size()) + " widths of " +
                              std::to_string(characters) + " characters",
                          expected);
    }
}

std::shared_ptr<Font> build(const FontElement& d, BuildContext& context) {
    const Texture& texture = *d.tex;
    if (texture.description().target != TextureTarget::texture2D) {
        context.diagnostics().error("wrong-kind", d.tex.place, "letters can't be in this texture",
                                    "a texture2D");
        return nullptr;
    }
    return std::make_shared<Font>(d.tex, Font::Grid{.columns = d.nCols,
                                                    .rows = d.nRows,
                                                    .firstChar = d.minChar,
                                                    .lastChar = d.maxChar,
                                                    .invalidChar = d.invalidChar,
                                                    .widths = *d.charWidths});
}

} // namespace

void declareFont(Registry& registry) {
    using D = FontElement;
    registry.nameInterface<Font>("font");
    registry.resource<Font, D>("font", "Letters, as tiles of a texture.")
        .example(
            R"(<font name="letters" tex="letters.png" nCols="16" nRows="8" minChar="0" maxChar="127"
    invalidChar="63" charWidths="9"/>)")
        .attribute("tex", &D::tex, "the texture2D with the tiles")
        .required()
        .attribute("nCols", &D::nCols, "tiles in a row")
        .required()
        .atLeast(1)
        .atMost(kMostTiles)
        .attribute("nRows", &D::nRows, "rows of tiles")
        .required()
        .atLeast(1)
        .atMost(kMostTiles)
        .attribute("minChar", &D::minChar, "code of the first character, at the top left")
        .required()
        .atLeast(0)
        .atMost(255)
        .attribute("maxChar", &D::maxChar, "code of the last character")
        .required()
        .atLeast(0)
        .atMost(255)
        .attribute("invalidChar", &D::invalidChar, "code of what is drawn for other characters")
        .required()
        .atLeast(0)
        .atMost(255)
        .attribute("charWidths", &D::charWidths,
                   "how far characters advance: one width for all, or one each, the last one for "
                   "the rest")
        .required()
        .atLeast(0)
        .clamped()
        .unit("texels")
        .check(check)
        .build(build);
}

} // namespace terrane
