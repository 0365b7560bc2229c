// SPDX-License-Identifier: BSD-3-Clause
#include "render/glsl_legacy_names.h"

#include <algorithm>
#include <array>

namespace terrane {

namespace {

// GLSL specifications 3.30 to 4.50, section 3.6 "Keywords".
constexpr std::array kReservedWords{
    ReservedWord{"active", 130},
    ReservedWord{"asm", 130},
    ReservedWord{"cast", 130},
    ReservedWord{"class", 130},
    ReservedWord{"common", 130},
    ReservedWord{"enum", 130},
    ReservedWord{"extern", 130},
    ReservedWord{"external", 130},
    ReservedWord{"filter", 130},
    ReservedWord{"fixed", 130},
    ReservedWord{"goto", 130},
    ReservedWord{"half", 130},
    ReservedWord{"inline", 130},
    ReservedWord{"input", 130},
    ReservedWord{"interface", 130},
    ReservedWord{"long", 130},
    ReservedWord{"namespace", 130},
    ReservedWord{"noinline", 130},
    ReservedWord{"output", 130},
    ReservedWord{"packed", 130},
    ReservedWord{"partition", 130},
    ReservedWord{"public", 130},
    ReservedWord{"short", 130},
    ReservedWord{"sizeof", 130},
    ReservedWord{"static", 130},
    ReservedWord{"superp", 130},
    ReservedWord{"template", 130},
    ReservedWord{"this", 130},
    ReservedWord{"typedef", 130},
    ReservedWord{"union", 130},
    ReservedWord{"unsigned", 130},
    ReservedWord{"using", 130},
    ReservedWord{"resource", 420},
    ReservedWord{"patch", 400, true},
    ReservedWord{"precise", 400, true},
    ReservedWord{"sample", 400, true},
    ReservedWord{"coherent", 420, true},
    ReservedWord{"readonly", 420, true},
    ReservedWord{"restrict", 420, true},
    ReservedWord{"volatile", 130, true},
    ReservedWord{"writeonly", 420, true},
    ReservedWord{"buffer", 430, true},
    ReservedWord{"shared", 430, true},
};

constexpr std::array<std::string_view, 3> kAbsorbedExtensions{
    "GL_EXT_gpu_shader4", "GL_EXT_geometry_shader4", "GL_EXT_texture_array"};

bool startsWithAny(std::string_view& text, std::initializer_list<std::string_view> choices) {
    for (const std::string_view choice : choices) {
        if (!text.starts_with(choice)) continue;
        text.remove_prefix(choice.size());
        return true;
    }
    return false;
}

bool isLookupSuffix(std::string_view suffix) {
    constexpr std::array<std::string_view, 12> suffixes{
        "",       "Proj",       "Lod",       "ProjLod",       "Grad",       "ProjGrad",
        "Offset", "ProjOffset", "LodOffset", "ProjLodOffset", "GradOffset", "ProjGradOffset"};
    return std::find(suffixes.begin(), suffixes.end(), suffix) != suffixes.end();
}

// Part of the deprecated names that core GLSL had until 4.10.
bool wasCore(std::string_view dimension, std::string_view suffix, bool shadow) {
    const bool plain = suffix.empty() || suffix == "Lod";
    const bool projected = suffix == "Proj" || suffix == "ProjLod";
    if (dimension == "1D" || dimension == "2D") return plain || projected;
    if (shadow) return false;
    return dimension == "3D" ? plain || projected : dimension == "Cube" && plain;
}

} // namespace

const ReservedWord* findReservedWord(std::string_view word) {
    const auto found = std::find_if(kReservedWords.begin(), kReservedWords.end(),
                                    [&](const auto& reserved) { return reserved.word == word; });
    return found == kReservedWords.end() ? nullptr : &*found;
}

bool isAbsorbedExtension(std::string_view name) {
    return std::find(kAbsorbedExtensions.begin(), kAbsorbedExtensions.end(), name) !=
           kAbsorbedExtensions.end();
}

std::optional<NewName> newTextureFunction(std::string_view name, int version) {
    std::string_view rest = name;
    std::string_view base;
    bool shadow = false;
    if (startsWithAny(rest, {"texelFetch"}))
        base = "texelFetch";
    else if (startsWithAny(rest, {"textureSize"}))
        base = "textureSize";
    else if (startsWithAny(rest, {"texture"}))
        base = "texture";
    else if (startsWithAny(rest, {"shadow"}))
        shadow = true;
    else
        return std::nullopt;
    const std::string_view from = rest;
    if (!startsWithAny(rest, {"1DArray", "2DArray", "2DRect", "CubeArray", "Cube", "Buffer", "1D",
                              "2D", "3D"}))
        return std::nullopt;
    const std::string_view dimension = from.substr(0, from.size() - rest.size());
    if (base == "textureSize") {
        if (!rest.empty()) return std::nullopt;
        return NewName{"textureSize"};
    }
    if (base == "texelFetch") {
        if (!rest.empty() && rest != "Offset") return std::nullopt;
        return NewName{"texelFetch" + std::string(rest)};
    }
    for (const std::string_view vendor : {"ARB", "EXT"}) {
        if (rest.ends_with(vendor)) rest.remove_suffix(vendor.size());
    }
    if (!isLookupSuffix(rest)) return std::nullopt;
    const bool vendorName =
        name.size() != (shadow ? 6 : base.size()) + dimension.size() + rest.size();
    if (!vendorName && wasCore(dimension, rest, shadow) && version < kRemovalVersion)
        return std::nullopt;
    // Core GLSL has rectangle textures, but their old function stayed valid where it was.
    if (shadow) return NewName{"vec4(texture" + std::string(rest), true};
    return NewName{"texture" + std::string(rest)};
}

} // namespace terrane
