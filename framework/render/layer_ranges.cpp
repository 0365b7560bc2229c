// SPDX-License-Identifier: BSD-3-Clause
#include "render/layer_ranges.h"

#include "core/source.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <string>

namespace terrane {

namespace {

// A layer is some 100 texels wide: one loop for a row keeps a GPU as busy as several small passes.
constexpr const char* kShader = R"(
#ifdef _FRAGMENT_

uniform sampler2DArray layers;
uniform int current;       // number of the texture in `layers`
uniform ivec2 inside;      // first texel within the border, and how many there are
uniform vec4 requests[16]; // number of the texture, layer, point; x < 0 for the whole layer

layout(location = 0) out vec2 range;

float elevation(ivec2 texel, int layer) {
    ivec2 last = ivec2(textureSize(layers, 0).xy) - 1;
    return texelFetch(layers, ivec3(clamp(texel, ivec2(0), last), layer), 0).z;
}

void main() {
    vec4 request = requests[int(gl_FragCoord.y)];
    if (int(request.x) != current) discard;
    int layer = int(request.y);
    if (request.z >= 0.0) {
        ivec2 texel = ivec2(floor(request.zw));
        vec2 f = fract(request.zw);
        float low = mix(elevation(texel, layer), elevation(texel + ivec2(1, 0), layer), f.x);
        float high = mix(elevation(texel + ivec2(0, 1), layer),
                         elevation(texel + ivec2(1, 1), layer), f.x);
        range = vec2(mix(low, high, f.y));
        return;
    }
    const float largest = 3.402823466e38;
    range = vec2(largest, -largest);
    int row = inside.x + int(gl_FragCoord.x);
    for (int i = 0; i < inside.y; ++i) {
        vec2 shown = texelFetch(layers, ivec3(inside.x + i, row, layer), 0).yz;
        if (!isnan(shown.x)) range = vec2(min(range.x, shown.x), max(range.y, shown.x));
        if (!isnan(shown.y)) range = vec2(min(range.x, shown.y), max(range.y, shown.y));
    }
}

#endif
)";

std::shared_ptr<Program> makeProgram(ProgramBindings& bindings, Diagnostics& diagnostics) {
    const std::string name = "layerRanges";
    ModuleSource source{.name = name};
    source.file = std::make_shared<SourceFile>("<" + name + ">", kShader);
    auto module = Module::compile(bindings.context, std::move(source), diagnostics);
    if (!module) return nullptr;
    return Program::link(bindings, {.name = name, .modules = {std::move(module)}}, diagnostics);
}

} // namespace

std::unique_ptr<LayerRanges> LayerRanges::make(ProgramBindings& bindings, int size, int border,
                                               Diagnostics& diagnostics) {
    assert(size > 2 * border && "LayerRanges: nothing is within the border");
    auto program = makeProgram(bindings, diagnostics);
    if (!program) return nullptr;
    return std::unique_ptr<LayerRanges>(
        new LayerRanges(std::move(program), bindings.context, size, border));
}

LayerRanges::LayerRanges(std::shared_ptr<Program> program, const GlContext& context, int size,
                         int border)
    : rows_(size - 2 * border)
    , program_(std::move(program))
    , target_(std::make_shared<Texture>(
          context,
          TextureDescription{.format = InternalFormat::rg32f, .width = rows_, .height = kMost}))
    , framebuffer_(context)
    , quad_(context, makeQuadMesh())
    , layers_(program_->uniform<Texture>("layers"))
    , current_(program_->uniform<int>("current"))
    , inside_(program_->uniform<glm::ivec2>("inside"))
    , border_(border) {
    for (int i = 0; i < kMost; ++i)
        requests_[i] = program_->uniform<glm::vec4>("requests[" + std::to_string(i) + "]");
    framebuffer_.attach(AttachmentPoint::colour0, {target_});
    framebuffer_.setDrawBuffers({AttachmentPoint::colour0});
    framebuffer_.setReadBuffer(AttachmentPoint::colour0);
}

void LayerRanges::draw(std::span<const Request> requests) {
    assert(requests.size() <= kMost && "LayerRanges::draw: too many requests");
    std::array<const Texture*, kMost> textures{};
    int textureCount = 0;
    for (std::size_t i = 0; i < requests.size(); ++i) {
        const Request& request = requests[i];
        const auto end = textures.begin() + textureCount;
        const auto found = std::find(textures.begin(), end, request.texture);
        if (found == end) textures[textureCount++] = request.texture;
        const glm::vec2 point = request.point.value_or(glm::vec2(-1));
        requests_[i].set({found - textures.begin(), request.layer, point.x, point.y});
    }
    framebuffer_.state.viewport = {0, 0, rows_, static_cast<int>(requests.size())};
    inside_.set({border_, rows_});
    for (int i = 0; i < textureCount; ++i) {
        layers_.set(*textures[i]);
        current_.set(i);
        framebuffer_.use();
        program_->use();
        quad_.draw();
    }
    layers_.set(std::shared_ptr<const Texture>()); // they may die before the next draw
}

LayerRanges::Range LayerRanges::combined(std::span<const Range> rows) {
    constexpr float kLargest = std::numeric_limits<float>::max();
    Range all{kLargest, -kLargest};
    for (const Range& row : rows) {
        all.zmin = std::min(all.zmin, row.zmin);
        all.zmax = std::max(all.zmax, row.zmax);
    }
    return all;
}

} // namespace terrane
