// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/sampling_parameters.h"
#include "resource/declaration.h"

#include <string>

namespace terrane {

const Words<MinFilter>& minFilterWords();
const Words<MagFilter>& magFilterWords();
const Words<Wrap>& wrapWords();
const Words<CompareFunction>& compareFunctionWords();
const Words<BorderType>& borderTypeWords();

/// The attributes of elements that say how a texture is sampled; a description of such an element
/// derives from this, besides ElementDescription.
///
///     struct LakeDescription : ElementDescription, SamplingAttributes { ... };
///     auto lake = registry.resource<Lake, LakeDescription>("lake", "...");
///     declareFilters(lake);
///     lake.check([](const auto& d, Diagnostics& diagnostics) { d.checkSampling(diagnostics); })
///         .build([](const auto& d, BuildContext& c) { ... d.sampling() ... });
struct SamplingAttributes {
    Attr<MinFilter> min = MinFilter::nearest;
    Attr<MagFilter> mag = MagFilter::linear;
    Attr<Wrap> wraps = Wrap::clampToEdge;
    Attr<Wrap> wrapt = Wrap::clampToEdge;
    Attr<Wrap> wrapr = Wrap::clampToEdge;
    Attr<float> minLod = -1000;
    Attr<float> maxLod = 1000;
    Attr<float> minLevel = 0;
    Attr<float> maxLevel = 1000;
    Attr<float> bias = 0;
    Attr<float> anisotropy = 1;
    Attr<std::string> swizzle = "rgba";
    Attr<CompareFunction> compare = CompareFunction::always;
    Attr<BorderType> borderType = BorderType::normalizedInteger;
    Attr<double> borderr = 0;
    Attr<double> borderg = 0;
    Attr<double> borderb = 0;
    Attr<double> bordera = 0;

    /// Of attributes that passed checkSampling.
    SamplingParameters sampling() const;
    /// Reports what the attributes can't say together or one by one.
    void checkSampling(Diagnostics& diagnostics) const;
};

namespace detail {
template <class D, class V>
V D::*memberOf(V SamplingAttributes::*member) {
    return member;
}
template <class D>
D describedBy(const ElementBuilder<LocalElementBuilder<D>, D>&);
template <class T, class D>
D describedBy(const ElementBuilder<ResourceBuilder<T, D>, D>&);
} // namespace detail

/// Declares min, mag, the limits of levels, bias, anisotropy and swizzle.
template <class Builder>
void declareFilters(Builder& builder) {
    using D = decltype(detail::describedBy(builder));
    using S = SamplingAttributes;
    const auto of = [](auto member) { return detail::memberOf<D>(member); };
    builder
        .attribute("min", of(&S::min),
                   "filter where pixels are smaller on the screen; the mipmap ones make mipmaps",
                   minFilterWords())
        .attribute("mag", of(&S::mag), "filter where pixels are larger on the screen",
                   magFilterWords())
        .attribute("minLod", of(&S::minLod), "lower limit of the level of detail")
        .orInfinite()
        .alias("minLOD")
        .attribute("maxLod", of(&S::maxLod), "upper limit of the level of detail")
        .orInfinite()
        .alias("maxLOD")
        .attribute("minLevel", of(&S::minLevel), "first mipmap level in use")
        .atLeast(0)
        .atMost(1000)
        .attribute("maxLevel", of(&S::maxLevel), "last mipmap level in use")
        .atLeast(0)
        .atMost(1000)
        .attribute("bias", of(&S::bias), "added to the level of detail")
        .attribute("anisotropy", of(&S::anisotropy),
                   "maximum anisotropy of the filter, where the driver has it")
        .alias("maxAniso")
        .attribute("swizzle", of(&S::swizzle),
                   "what shaders read as red, green, blue and alpha: four of rgba01");
}

/// Declares wraps, and wrapt and wrapr for textures with so many dimensions.
template <class Builder>
void declareWraps(Builder& builder, int dimensions) {
    using D = decltype(detail::describedBy(builder));
    using S = SamplingAttributes;
    const auto of = [](auto member) { return detail::memberOf<D>(member); };
    builder.attribute("wraps", of(&S::wraps), "what lies beyond the left and right edges",
                      wrapWords());
    if (dimensions >= 2)
        builder.attribute("wrapt", of(&S::wrapt), "what lies beyond the lower and upper edges",
                          wrapWords());
    if (dimensions >= 3)
        builder.attribute("wrapr", of(&S::wrapr), "what lies beyond the first and last slices",
                          wrapWords());
}

/// Declares the depth comparison and the border colour.
template <class Builder>
void declareComparisonAndBorder(Builder& builder) {
    using D = decltype(detail::describedBy(builder));
    using S = SamplingAttributes;
    const auto of = [](auto member) { return detail::memberOf<D>(member); };
    builder
        .attribute("compare", of(&S::compare),
                   "how shadow samplers compare a depth texture; ALWAYS: not",
                   compareFunctionWords())
        .attribute("borderType", of(&S::borderType), "how the border colour is meant",
                   borderTypeWords())
        .attribute("borderr", of(&S::borderr), "red of the border colour")
        .attribute("borderg", of(&S::borderg), "green of the border colour")
        .attribute("borderb", of(&S::borderb), "blue of the border colour")
        .attribute("bordera", of(&S::bordera), "alpha of the border colour");
}

} // namespace terrane
