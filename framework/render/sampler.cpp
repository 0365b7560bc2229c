// SPDX-License-Identifier: BSD-3-Clause
#include "render/sampler.h"

#include "render/sampling_transfer.h"
#include "render/state_tracker.h"

namespace terrane {

namespace {

struct SamplerCalls {
    const GladGLContext& gl;
    unsigned name;

    void integer(unsigned parameter, int value) const {
        gl.SamplerParameteri(name, parameter, value);
    }
    void real(unsigned parameter, float value) const {
        gl.SamplerParameterf(name, parameter, value);
    }
    void reals(unsigned parameter, const float* values) const {
        gl.SamplerParameterfv(name, parameter, values);
    }
    void integers(unsigned parameter, const int* values) const {
        gl.SamplerParameterIiv(name, parameter, values);
    }
    void unsignedIntegers(unsigned parameter, const unsigned* values) const {
        gl.SamplerParameterIuiv(name, parameter, values);
    }
};

} // namespace

Sampler::Sampler(const GlContext& context, const SamplingParameters& parameters)
    : context_(context)
    , parameters_(parameters)
    , serial_(context.nextSerial()) {
    context.gl().CreateSamplers(1, &name_);
    context.countObject(1);
    sendSampling(context, parameters, {}, SamplerCalls{context.gl(), name_});
}

Sampler::~Sampler() {
    context_.state().forgetSampler(name_);
    context_.gl().DeleteSamplers(1, &name_);
    context_.countObject(-1);
}

} // namespace terrane
