// SPDX-License-Identifier: BSD-3-Clause
#include "render/texture_resource.h"

#include "core/files.h"
#include "core/image.h"
#include "core/text.h"
#include "render/sampling_attributes.h"
#include "render/texture.h"
#include "resource/build_context.h"
#include "resource/manager.h"
#include "resource/registry.h"

#include <cstdint>

namespace terrane {

namespace {

using T = TextureTarget;

struct TextureElement : ElementDescription, SamplingAttributes {
    Attr<DataFile> source;
    Attr<InternalFormat> internalformat = InternalFormat::rgba8;
    Attr<TransferFormat> format = TransferFormat::rgba;
    Attr<TransferType> type = TransferType::u8;
    Attr<int> width = 0;
    Attr<int> height = 0;
    Attr<int> depth = 0;
    Attr<int> layers = 0;
};

/// The numbers of an element once the file, if there is one, has had its say: `height` is that of
/// all slices, layers or faces, stacked.
struct Geometry {
    int width = 1;
    int height = 1;
    int count = 0; ///< of slices or layers; 0 when nobody says
};

std::string times(int width, int height) {
    return std::to_string(width) + " x " + std::to_string(height);
}

/// The texture's own sizes, or a text that tells why there are none.
std::string describe(T target, const Geometry& g, TextureDescription& d) {
    d.target = target;
    d.width = g.width;
    switch (target) {
    case T::texture1D:
        break;
    case T::texture1DArray:
        d.layers = g.height;
        break;
    case T::texture2D:
    case T::rectangle:
        d.height = g.height;
        break;
    case T::texture2DArray:
    case T::texture3D: {
        const std::string what = target == T::texture3D ? " slices" : " layers";
        if (g.count < 1) return "the number of" + what + " is missing";
        if (g.height % g.count != 0) {
            return "the total height of " + std::to_string(g.height) + " is no multiple of the " +
                   std::to_string(g.count) + what;
        }
        d.height = g.height / g.count;
        (target == T::texture3D ? d.depth : d.layers) = g.count;
        break;
    }
    case T::cube:
        if (std::int64_t(g.height) != 6 * std::int64_t(g.width)) {
            return "six stacked faces can't be " + times(g.width, g.height);
        }
        d.height = g.width;
        break;
    case T::cubeArray:
        if (g.height % (6 * std::int64_t(g.width)) != 0) {
            return "cubes of six stacked faces can't be " + times(g.width, g.height);
        }
        d.height = g.width;
        d.layers = g.height / (6 * g.width);
        break;
    case T::multisample2D:
    case T::multisample2DArray:
    case T::buffer:
        return "archives can't describe such a texture"; // nor does one of their tags
    }
    return {};
}

bool hasHeight(T target) {
    return target != T::texture1D;
}

void needAttribute(const TextureElement& d, const char* name, Diagnostics& diagnostics) {
    diagnostics.error("missing-attribute", d.place,
                      "<" + d.tag + "> without a source needs the attribute '" + name + "'");
}

void checkSizes(T target, const TextureElement& d, Diagnostics& diagnostics) {
    const std::size_t before = diagnostics.errors();
    if (!d.format.given) needAttribute(d, "format", diagnostics);
    if (!d.type.given) needAttribute(d, "type", diagnostics);
    if (!d.width.given) needAttribute(d, "width", diagnostics);
    if (hasHeight(target) && !d.height.given) needAttribute(d, "height", diagnostics);
    const bool counted = d.depth.given || (target == T::texture2DArray && d.layers.given);
    if ((target == T::texture3D || target == T::texture2DArray) && !counted) {
        needAttribute(d, target == T::texture3D ? "depth" : "layers", diagnostics);
    }
    if (diagnostics.errors() > before) return;
    TextureDescription ignored;
    const Geometry geometry{d.width, hasHeight(target) ? *d.height : 1,
                            d.depth.given ? *d.depth : *d.layers};
    const std::string problem = describe(target, geometry, ignored);
    if (!problem.empty()) diagnostics.error("bad-texture", d.height.place, problem);
}

void checkTexture(T target, const TextureElement& d, Diagnostics& diagnostics) {
    d.checkSampling(diagnostics);
    if (!d.source.given) checkSizes(target, d, diagnostics);
    if (target == T::rectangle && d.sampling().mipmapped()) {
        diagnostics.warning("unused-attribute", d.min.place, "rectangle textures have no mipmaps",
                            "'NEAREST' or 'LINEAR'");
    }
}

/// Tells what the file overrules (Ork reference 1.4).
void warnOverruled(const TextureElement& d, const Image& image, Diagnostics& diagnostics) {
    if (d.width.given && *d.width != image.width) {
        diagnostics.warning("unused-attribute", d.width.place,
                            "the file is " + std::to_string(image.width) + " pixels wide");
    }
    if (d.format.given && channelCount(d.format) != image.channels) {
        diagnostics.warning("unused-attribute", d.format.place,
                            "the file has " + std::to_string(image.channels) + " channels");
    }
    const auto type = image.type == PixelType::f32 ? TransferType::f32 : TransferType::u8;
    if (d.type.given && *d.type != type) {
        diagnostics.warning("unused-attribute", d.type.place,
                            image.type == PixelType::f32 ? "the file holds floats"
                                                         : "the file holds bytes");
    }
}

std::optional<Image> loadImage(const TextureElement& d, BuildContext& context) {
    const auto bytes = context.readFile(d.source->name, d.source.place);
    if (!bytes) return std::nullopt;
    return decodeImage(*bytes, d.source->name, context.diagnostics(), d.source.place);
}

/// Why pixels of a file can't become such a texture; empty when they can.
std::string mismatch(const InternalFormatInfo& format, const Image& image) {
    const std::string name(format.name);
    if (format.integer() && image.type == PixelType::f32) {
        return "floats can't fill a texture of integers (" + name + ")";
    }
    if (format.kind == ChannelKind::depthStencil || format.kind == ChannelKind::stencil) {
        return "a file can't fill a texture with stencil (" + name + ")";
    }
    if (format.kind == ChannelKind::depth && image.channels != 1) {
        return "depth (" + name + ") has one channel, the file has " +
               std::to_string(image.channels);
    }
    return {};
}

TransferLayout layoutOf(const TextureElement& d, const InternalFormatInfo& format,
                        const Image& image) {
    const auto type = image.type == PixelType::f32 ? TransferType::f32 : TransferType::u8;
    const TransferLayout layout = transferLayout(format, image.channels, type);
    // The author's word counts for the order of channels, such as BGR.
    const bool fits = d.format.given && channelCount(d.format) == image.channels &&
                      isInteger(d.format) == isInteger(layout.format) && !format.hasDepth();
    return fits ? TransferLayout{d.format, type} : layout;
}

/// What is to blame for sizes that don't go together: one that is written, else the file.
Place sizePlace(const TextureElement& d) {
    for (const Attr<int>* size : {&d.height, &d.depth, &d.layers}) {
        if (size->given) return size->place;
    }
    return d.source.given ? d.source.place : d.place;
}

std::shared_ptr<Texture> make(T target, const TextureElement& d, const Geometry& geometry,
                              BuildContext& context) {
    const auto& gl = context.service<GlContext>();
    TextureDescription description{.format = d.internalformat};
    std::string problem = describe(target, geometry, description);
    const Place place = problem.empty() ? d.place : sizePlace(d);
    if (problem.empty()) problem = Texture::problem(gl, description);
    if (!problem.empty()) {
        context.diagnostics().error("bad-texture", place, problem);
        return nullptr;
    }
    auto texture = std::make_shared<Texture>(gl, description, d.sampling());
    if (texture->allocated()) return texture;
    context.diagnostics().error("out-of-memory", d.place, "the driver has no memory for it",
                                "a smaller texture");
    return nullptr;
}

std::shared_ptr<Texture> buildFromFile(T target, const TextureElement& d, BuildContext& context) {
    const auto image = loadImage(d, context);
    if (!image) return nullptr;
    const auto& format = formatInfo(d.internalformat);
    warnOverruled(d, *image, context.diagnostics());
    std::string problem = mismatch(format, *image);
    const int height = !hasHeight(target) ? 1 : d.height.given ? *d.height : image->height;
    if (problem.empty() && height > image->height) {
        problem = "the file is only " + std::to_string(image->height) + " pixels high";
    }
    if (!problem.empty()) {
        context.diagnostics().error("bad-texture", d.source.place, problem);
        return nullptr;
    }
    const int count = image->depth > 0 ? image->depth : d.depth.given ? *d.depth : *d.layers;
    const auto texture = make(target, d, {image->width, height, count}, context);
    if (texture) {
        texture->upload(layoutOf(d, format, *image),
                        std::as_bytes(std::span(image->bytes.data(), image->bytes.size())));
    }
    return texture;
}

std::shared_ptr<Texture> buildTexture(T target, const TextureElement& d, BuildContext& context) {
    if (d.source.given) return buildFromFile(target, d, context);
    const int count = d.depth.given ? *d.depth : *d.layers;
    const auto texture =
        make(target, d, {d.width, hasHeight(target) ? *d.height : 1, count}, context);
    if (texture) texture->clear();
    return texture;
}

void declareTexture(Registry& registry, const std::string& tag, T target, std::string summary,
                    std::string example = {}) {
    using D = TextureElement;
    auto texture = registry.resource<Texture, D>(tag, std::move(summary));
    texture.example(std::move(example))
        .attribute("source", &D::source,
                   "picture (JPEG, PNG, BMP, TGA, PSD, HDR) or raw float file; several slices, "
                   "layers or faces are stacked, the first at the bottom")
        .attribute("internalformat", &D::internalformat, "how pixels are stored",
                   internalFormatWords())
        .required()
        .attribute("format", &D::format,
                   "order of the channels in the file, or of a texture without one, which needs it",
                   transferFormatWords())
        .attribute("type", &D::type,
                   "type of a channel; a file knows its own, a texture without one needs it",
                   transferTypeWords())
        .attribute("width", &D::width, "width; a picture knows its own")
        .unit("pixels")
        .atLeast(1);
    if (hasHeight(target)) {
        texture
            .attribute("height", &D::height,
                       target == T::texture1DArray
                           ? "number of layers"
                           : "height of all slices, layers or faces together")
            .unit(target == T::texture1DArray ? "" : "pixels")
            .atLeast(1);
    }
    if (target == T::texture3D || target == T::texture2DArray) {
        texture.attribute("depth", &D::depth, "number of slices or layers stacked in the height")
            .atLeast(1);
    }
    if (target == T::texture2DArray) {
        texture.attribute("layers", &D::layers, "number of layers, if 'depth' does not say it")
            .atLeast(1);
    }
    declareFilters(texture);
    declareWraps(texture, target == T::texture3D                                  ? 3
                          : target == T::texture1D || target == T::texture1DArray ? 1
                                                                                  : 2);
    if (target != T::texture3D) declareComparisonAndBorder(texture);
    texture
        .check([target](const D& d, Diagnostics& diagnostics) {
            checkTexture(target, d, diagnostics);
        })
        .build([target](const D& d, BuildContext& context) {
            return buildTexture(target, d, context);
        });
}

} // namespace

void declareTextures(Registry& registry) {
    registry.nameInterface<Texture>("texture");
    declareTexture(registry, "texture1D", T::texture1D,
                   "A texture of one dimension: a line of pixels.");
    declareTexture(registry, "texture1DArray", T::texture1DArray,
                   "Several lines of pixels; shaders choose one by its number.");
    declareTexture(
        registry, "texture2D", T::texture2D,
        "A texture of two dimensions: a picture. An image file is one by its name alone: "
        "'rock.png'.",
        R"(<texture2D name="grass" source="grass.jpg" internalformat="RGB8" min="LINEAR_MIPMAP_LINEAR"
    mag="LINEAR" wraps="REPEAT" wrapt="REPEAT"/>)");
    declareTexture(registry, "texture2DArray", T::texture2DArray,
                   "Several pictures of one size; shaders choose one by its number.");
    declareTexture(registry, "texture3D", T::texture3D,
                   "A texture of three dimensions: a volume, of slices.");
    declareTexture(registry, "textureCube", T::cube,
                   "Six square pictures around a point, stacked in the file: +X -X +Y -Y +Z -Z "
                   "from the bottom.");
    declareTexture(registry, "textureCubeArray", T::cubeArray,
                   "Several cubes; shaders choose one by its number.");
    declareTexture(registry, "textureRectangle", T::rectangle,
                   "A picture whose coordinates in shaders are pixels.");
}

} // namespace terrane
