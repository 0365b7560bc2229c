// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/context.h"
#include "render/sampling_parameters.h"

#include <cstdint>

namespace terrane {

/// A way to read textures that is independent of them: where a uniform has one, it counts in place
/// of the texture's own sampling, but for swizzle and first and last level. Immutable, move-only;
/// GL thread only, with its context current.
///
///     const auto nearest = std::make_shared<Sampler>(context, SamplingParameters{});
///     program->find("map").set(texture);
///     program->find("map").setSampler(nearest);
class Sampler {
public:
    Sampler(const GlContext& context, const SamplingParameters& parameters);
    ~Sampler();
    Sampler(const Sampler&) = delete;
    Sampler& operator=(const Sampler&) = delete;

    const SamplingParameters& parameters() const { return parameters_; }
    unsigned name() const { return name_; }
    std::uint64_t serial() const { return serial_; }

private:
    const GlContext& context_;
    SamplingParameters parameters_;
    unsigned name_ = 0;
    std::uint64_t serial_ = 0;
};

} // namespace terrane
