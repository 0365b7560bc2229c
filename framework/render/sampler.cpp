// SPDX-License-Identifier: BSD-3-Clause
#include "render/sampler.h"

#include "render/sampling_transfer.h"
#include "render/state_tracker.h"

namespace terrane {

Sampler::Sampler(const GlContext& context, const SamplingParameters& parameters)
    : context_(context)
    , parameters_(parameters)
    , serial_(context.nextSerial()) {
    const auto& gl = context.gl();
    gl.CreateSamplers(1, &name_);
    context.countObject(1);
    sendSampling(context, parameters, {},
                 {name_, gl.SamplerParameteri, gl.SamplerParameterf, gl.SamplerParameterfv,
                  gl.SamplerParameterIiv, gl.SamplerParameterIuiv});
}

Sampler::~Sampler() {
    context_.state().forgetSampler(name_);
    context_.gl().DeleteSamplers(1, &name_);
    context_.countObject(-1);
}

} // namespace terrane
