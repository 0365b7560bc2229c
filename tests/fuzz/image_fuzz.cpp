// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a picture or a table of raw floats; what starts with '<' as the element of a
// texture, which is parsed and checked, but not made.
#include "core/image.h"
#include "render/texture_resource.h"
#include "require.h"
#include "resource/parser.h"
#include "resource/registry.h"
#include "resource/xml.h"

#include <cstdint>
#include <string>
#include <string_view>

using namespace terrane;
using test::require;

namespace {

// A picture of more pixels is not encoded again, which would only cost time.
constexpr int kMostEncoded = 1 << 12;

/// The types of textures, declared once.
struct Textures {
    Textures() { declareTextures(registry); }
    Registry registry;
};

std::optional<Image> decode(std::string_view bytes) {
    Diagnostics diagnostics;
    auto image = decodeImage(bytes, "an image", diagnostics, {});
    require(image.has_value() == (diagnostics.errors() == 0), "either an image or an error");
    test::requireToldWell(diagnostics);
    return image;
}

void checkPicture(std::string_view bytes) {
    const auto image = decode(bytes);
    if (!image) return;
    require(image->width >= 1 && image->height >= 1, "an image has pixels");
    require(image->channels >= 1 && image->channels <= 4, "an image has 1 to 4 channels");
    require(image->depth >= 0 && (image->depth == 0 || image->height % image->depth == 0),
            "slices divide the height");
    require(image->bytes.size() == image->byteSize(), "there are as many bytes as it says");
    // Also finds what depends on memory that nobody set.
    require(decode(bytes)->bytes == image->bytes, "the same bytes give the same image");
    const bool small = std::int64_t{image->width} * image->height <= kMostEncoded;
    if (image->type != PixelType::u8 || !small) return;
    const auto again = decode(encodePng(*image));
    require(again && again->bytes == image->bytes, "a PNG of it is the same image");
}

void checkElement(std::string_view text) {
    static const Textures textures;
    Diagnostics diagnostics;
    const auto document =
        XmlDocument::parse(std::make_shared<SourceFile>("a.xml", std::string(text)), diagnostics);
    const auto* const declaration =
        document ? textures.registry.find(document->root().tag()) : nullptr;
    if (!declaration) return;
    const auto element =
        parseElement(document->root(), *declaration, textures.registry, diagnostics);
    require(element.valid == (diagnostics.errors() == 0), "either a texture or an error");
    test::requireToldWell(diagnostics);
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it so.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    if (bytes.starts_with('<')) {
        checkElement(bytes);
    } else {
        checkPicture(bytes);
    }
    return 0;
}
