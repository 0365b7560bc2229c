// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "render/context.h"
#include "render/glsl_source.h"
#include "render/shader_object.h"
#include "render/shader_stage.h"
#include "render/texture.h"
#include "render/uniform_type.h"
#include "resource/resource.h"
#include "resource/value.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace terrane {

class Program;

/// A value that a module gives to a uniform of the programs it is linked into.
struct InitialUniform {
    std::string name; ///< `u`, `u[2]`, `s.m`, `Block.member`
    Place place;
    UniformValue value;   ///< for everything but samplers
    Ref<Texture> texture; ///< for samplers, when it names a resource
};

/// A function that a module chooses for a subroutine uniform of the programs it is linked into.
struct InitialSubroutine {
    std::string uniform; ///< `u`, `u[2]`
    std::string function;
    ShaderStage stage = ShaderStage::fragment;
    Place place; ///< of the function's name
};

enum class FeedbackMode { separate, interleaved };

/// Vertex outputs that a program captures.
struct Feedback {
    FeedbackMode mode = FeedbackMode::separate;
    std::vector<std::string> varyings;
    Place place;
};

/// What a module is made of (ork reference 2.3).
struct ModuleSource {
    std::string name; ///< for messages
    Place place;
    int version = 330;
    Place versionPlace;
    std::vector<std::string> options;
    Place optionsPlace;
    /// Of all stages; they exist if the text mentions their macros. Null: a file for each stage.
    std::shared_ptr<const SourceFile> file;
    std::array<std::shared_ptr<const SourceFile>, kShaderStageCount> stageFiles;
    GlslFiles includes;
    std::vector<InitialUniform> uniforms;
    std::vector<InitialSubroutine> subroutines = {};
    std::optional<Feedback> feedback;
};

/// Compiled GLSL of one or more stages, to be linked into programs together with other modules: a
/// shader, or a part of one, or a library of functions. Immutable once finished. GL thread only.
class Module : public Resource {
public:
    /// Puts the text together and starts compiling all stages. Null, with diagnostics, when an
    /// include is missing.
    static std::shared_ptr<Module> start(const GlContext& context, ModuleSource source,
                                         Diagnostics& diagnostics);
    /// start() and finish(): null when it does not compile.
    static std::shared_ptr<Module> compile(const GlContext& context, ModuleSource source,
                                           Diagnostics& diagnostics);

    /// Waits for the compiler and reports what it says, the first time. True when all stages
    /// compiled.
    bool finish(Diagnostics& diagnostics);

    const std::string& name() const { return source_.name; }
    const Place& place() const { return source_.place; }
    const std::vector<ShaderObject>& shaders() const { return shaders_; }
    bool hasStage(ShaderStage stage) const;
    /// The text that was compiled, or null when there is no such stage.
    const GlslText* text(ShaderStage stage) const;
    const std::vector<InitialUniform>& uniforms() const { return source_.uniforms; }
    const std::vector<InitialSubroutine>& subroutines() const { return source_.subroutines; }
    const std::optional<Feedback>& feedback() const { return source_.feedback; }
    /// All files that were read, includes too, each once: changes of these call for a new module.
    const std::vector<std::shared_ptr<const SourceFile>>& files() const { return files_; }

    /// The programs that live with this module in them, in the order in which they were linked.
    const std::vector<Program*>& programs() const { return programs_; }

private:
    friend class Program;

    Module(const GlContext& context, ModuleSource source);
    bool assemble(Diagnostics& diagnostics);
    void warnUnusedOptions(Diagnostics& diagnostics) const;
    void compileStages(Diagnostics& diagnostics);

    const GlContext& context_;
    ModuleSource source_;
    std::array<std::optional<GlslText>, kShaderStageCount> texts_;
    std::vector<ShaderObject> shaders_;
    std::vector<std::shared_ptr<const SourceFile>> files_;
    std::vector<Program*> programs_;
    bool finished_ = false;
    bool good_ = false;
};

} // namespace terrane
