// SPDX-License-Identifier: BSD-3-Clause
#include "scene/module_sampler.h"

namespace terrane {

ModuleSampler::ModuleSampler(Ref<Module> module, std::string sampler)
    : module_(std::move(module))
    , sampler_(std::move(sampler)) {
    for (const InitialUniform& uniform : module_->uniforms()) {
        if (uniform.name == sampler_) initial_ = uniform.texture;
    }
}

std::shared_ptr<Texture> ModuleSampler::texture() {
    findProgram();
    std::shared_ptr<Texture> texture = handle_.sharedTexture();
    return texture || handle_.texture() ? texture : initial_.shared();
}

bool ModuleSampler::exists() {
    findProgram();
    return initial_.given() || handle_.type().isSampler();
}

void ModuleSampler::findProgram() {
    const auto& programs = module_->programs();
    if (programs == programs_) return;
    programs_ = programs;
    handle_ = {};
    for (Program* program : programs) {
        const UniformHandle handle = program->find(sampler_);
        if (!handle.active()) continue;
        handle_ = handle;
        return;
    }
}

} // namespace terrane
