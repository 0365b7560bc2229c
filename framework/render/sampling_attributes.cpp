// SPDX-License-Identifier: BSD-3-Clause
#include "render/sampling_attributes.h"

#include "core/text.h"

#include <algorithm>
#include <string_view>

namespace terrane {

namespace {

constexpr std::string_view kSwizzleLetters = "rgba01";

Swizzle swizzleOf(char letter) {
    constexpr Swizzle values[] = {Swizzle::red,   Swizzle::green, Swizzle::blue,
                                  Swizzle::alpha, Swizzle::zero,  Swizzle::one};
    const std::size_t index = kSwizzleLetters.find(letter);
    return index < kSwizzleLetters.size() ? values[index] : Swizzle::red; // told by its rule
}

} // namespace

const Words<MinFilter>& minFilterWords() {
    static const Words<MinFilter> words{{"NEAREST", MinFilter::nearest},
                                        {"LINEAR", MinFilter::linear},
                                        {"NEAREST_MIPMAP_NEAREST", MinFilter::nearestMipmapNearest},
                                        {"NEAREST_MIPMAP_LINEAR", MinFilter::nearestMipmapLinear},
                                        {"LINEAR_MIPMAP_NEAREST", MinFilter::linearMipmapNearest},
                                        {"LINEAR_MIPMAP_LINEAR", MinFilter::linearMipmapLinear}};
    return words;
}

const Words<MagFilter>& magFilterWords() {
    static const Words<MagFilter> words{{"NEAREST", MagFilter::nearest},
                                        {"LINEAR", MagFilter::linear}};
    return words;
}

const Words<Wrap>& wrapWords() {
    static const Words<Wrap> words{{"CLAMP_TO_EDGE", Wrap::clampToEdge},
                                   {"CLAMP_TO_BORDER", Wrap::clampToBorder},
                                   {"REPEAT", Wrap::repeat},
                                   {"MIRRORED_REPEAT", Wrap::mirroredRepeat}};
    return words;
}

const Words<CompareFunction>& compareFunctionWords() {
    using C = CompareFunction;
    static const Words<C> words{{"LEQUAL", C::lequal}, {"GEQUAL", C::gequal},
                                {"LESS", C::less},     {"GREATER", C::greater},
                                {"EQUAL", C::equal},   {"NOTEQUAL", C::notEqual},
                                {"ALWAYS", C::always}, {"NEVER", C::never}};
    return words;
}

const Words<BorderType>& borderTypeWords() {
    static const Words<BorderType> words{{"INT", BorderType::normalizedInteger},
                                         {"FLOAT", BorderType::real},
                                         {"IINT", BorderType::integer},
                                         {"IUNSIGNED_INT", BorderType::unsignedInteger}};
    return words;
}

SamplingParameters SamplingAttributes::sampling() const {
    SamplingParameters s;
    s.min = min;
    s.mag = mag;
    s.wrapS = wraps;
    s.wrapT = wrapt;
    s.wrapR = wrapr;
    s.minLod = minLod;
    s.maxLod = maxLod;
    s.minLevel = int(*minLevel);
    s.maxLevel = int(*maxLevel);
    s.bias = bias;
    s.anisotropy = std::max(1.0F, *anisotropy);
    std::transform(swizzle->begin(), swizzle->end(), s.swizzle.begin(), swizzleOf);
    s.compare = compare;
    s.borderType = borderType;
    if (borderr.given) s.border = {*borderr, *borderg, *borderb, *bordera};
    return s;
}

void SamplingAttributes::checkSampling(Diagnostics& diagnostics) const {
    if (swizzle->size() != 4 || swizzle->find_first_not_of(kSwizzleLetters) != std::string::npos) {
        diagnostics.error("wrong-kind", swizzle.place, inQuotes(*swizzle) + " is no swizzle",
                          "four of the letters r, g, b, a, 0, 1, such as 'rgba'");
    }
    for (const auto* other : {&borderg, &borderb, &bordera}) {
        if (other->given && !borderr.given) {
            diagnostics.warning("unused-attribute", other->place,
                                "the border colour is only used when 'borderr' is given");
            break;
        }
    }
}

} // namespace terrane
