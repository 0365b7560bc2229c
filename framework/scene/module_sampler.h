// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/program.h"
#include "resource/value.h"

#include <memory>
#include <string>
#include <vector>

namespace terrane {

/// A sampler, named by a module that is linked into programs: `target.module:sampler` of archives
/// (ork reference 2.14). GL thread only.
class ModuleSampler {
public:
    ModuleSampler() = default;
    ModuleSampler(Ref<Module> module, std::string sampler);

    explicit operator bool() const { return static_cast<bool>(module_); }

    /// The texture that it has now in the first program with the module in which it is active;
    /// before there is such a program, or when none was set there, the one that the module gives
    /// it. Null without any, and for a texture that the program does not share (tiles).
    std::shared_ptr<Texture> texture();

    /// Whether the module gives it a texture, or a program has a sampler of this name.
    bool exists();

private:
    void findProgram();

    Ref<Module> module_;
    std::string sampler_;
    Ref<Texture> initial_;
    std::vector<Program*> programs_; ///< of the module, when the handle was looked for
    UniformHandle handle_;
};

} // namespace terrane
