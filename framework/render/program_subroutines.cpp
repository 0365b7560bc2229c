// SPDX-License-Identifier: BSD-3-Clause
#include "render/program_subroutines.h"

#include <glad/gl.h>

#include <algorithm>
#include <array>

namespace terrane {

namespace {

std::size_t index(ShaderStage stage) {
    return static_cast<std::size_t>(stage);
}

GLenum shaderType(ShaderStage stage) {
    constexpr std::array<GLenum, kShaderStageCount> types{GL_VERTEX_SHADER, GL_TESS_CONTROL_SHADER,
                                                          GL_TESS_EVALUATION_SHADER,
                                                          GL_GEOMETRY_SHADER, GL_FRAGMENT_SHADER};
    return types[index(stage)];
}

GLenum functionsOf(ShaderStage stage) {
    constexpr std::array<GLenum, kShaderStageCount> interfaces{
        GL_VERTEX_SUBROUTINE, GL_TESS_CONTROL_SUBROUTINE, GL_TESS_EVALUATION_SUBROUTINE,
        GL_GEOMETRY_SUBROUTINE, GL_FRAGMENT_SUBROUTINE};
    return interfaces[index(stage)];
}

GLenum uniformsOf(ShaderStage stage) {
    constexpr std::array<GLenum, kShaderStageCount> interfaces{
        GL_VERTEX_SUBROUTINE_UNIFORM, GL_TESS_CONTROL_SUBROUTINE_UNIFORM,
        GL_TESS_EVALUATION_SUBROUTINE_UNIFORM, GL_GEOMETRY_SUBROUTINE_UNIFORM,
        GL_FRAGMENT_SUBROUTINE_UNIFORM};
    return interfaces[index(stage)];
}

std::string nameOf(const GladGLContext& gl, unsigned program, GLenum interface, unsigned index) {
    constexpr GLenum property = GL_NAME_LENGTH;
    GLint length = 0;
    gl.GetProgramResourceiv(program, interface, index, 1, &property, 1, nullptr, &length);
    std::string name(std::size_t(std::max(length, 1)), '\0');
    GLsizei written = 0;
    gl.GetProgramResourceName(program, interface, index, length, &written, name.data());
    name.resize(std::size_t(written));
    return name;
}

} // namespace

SubroutineTable::SubroutineTable(const GlContext& context, unsigned program) {
    for (const ShaderStage stage : kShaderStages) {
        Stage read = readStage(context, program, stage);
        if (!read.uniforms.empty()) stages_.push_back(std::move(read));
    }
}

SubroutineTable::Stage SubroutineTable::readStage(const GlContext& context, unsigned program,
                                                  ShaderStage stage) {
    const auto& gl = context.gl();
    Stage result{.stage = stage, .uniforms = {}, .indices = {}};
    GLint count = 0;
    gl.GetProgramInterfaceiv(program, uniformsOf(stage), GL_ACTIVE_RESOURCES, &count);
    for (GLuint i = 0; i < GLuint(count); ++i) {
        constexpr std::array<GLenum, 3> properties{GL_LOCATION, GL_ARRAY_SIZE,
                                                   GL_NUM_COMPATIBLE_SUBROUTINES};
        std::array<GLint, 3> values{};
        gl.GetProgramResourceiv(program, uniformsOf(stage), i, 3, properties.data(), 3, nullptr,
                                values.data());
        const auto [location, size, functions] = values;
        std::vector<GLint> indices(std::size_t(std::max(functions, 0)));
        constexpr GLenum compatible = GL_COMPATIBLE_SUBROUTINES;
        gl.GetProgramResourceiv(program, uniformsOf(stage), i, 1, &compatible, functions, nullptr,
                                indices.data());
        Uniform uniform{.name = nameOf(gl, program, uniformsOf(stage), i),
                        .location = unsigned(location),
                        .compatible = {}};
        for (const GLint function : indices) {
            uniform.compatible.push_back(
                {nameOf(gl, program, functionsOf(stage), GLuint(function)), unsigned(function)});
        }
        if (uniform.compatible.empty()) continue;
        const std::string base = uniform.name.substr(0, uniform.name.rfind("[0]"));
        const bool array = base.size() < uniform.name.size();
        for (GLint element = 0; element < std::max(size, 1); ++element) {
            if (array) uniform.name = base + "[" + std::to_string(element) + "]";
            uniform.location = unsigned(location + element);
            result.uniforms.push_back(uniform);
        }
    }
    if (result.uniforms.empty()) return result; // maybe there is no such stage at all
    GLint locations = 0;
    gl.GetProgramStageiv(program, shaderType(stage), GL_ACTIVE_SUBROUTINE_UNIFORM_LOCATIONS,
                         &locations);
    result.indices.resize(std::size_t(std::max(locations, 0)));
    for (const Uniform& uniform : result.uniforms)
        result.indices[uniform.location] = uniform.compatible.front().index;
    return result;
}

const SubroutineTable::Uniform* SubroutineTable::find(ShaderStage stage,
                                                      std::string_view uniform) const {
    for (const Stage& s : stages_) {
        if (s.stage != stage) continue;
        for (const Uniform& u : s.uniforms) {
            if (u.name == uniform || u.name == std::string(uniform) + "[0]") return &u;
        }
    }
    return nullptr;
}

SubroutineTable::Result SubroutineTable::chooseInitially(ShaderStage stage,
                                                         std::string_view uniform,
                                                         std::string_view function) {
    const Uniform* const found = find(stage, uniform);
    if (!found) return Result::noUniform;
    for (const Function& candidate : found->compatible) {
        if (candidate.name != function) continue;
        for (Stage& s : stages_) {
            if (s.stage == stage) s.indices[found->location] = candidate.index;
        }
        return Result::done;
    }
    return Result::noFunction;
}

SubroutineTable::Result SubroutineTable::choose(ShaderStage stage, std::string_view uniform,
                                                std::string_view function) {
    const Result result = chooseInitially(stage, uniform, function);
    if (result != Result::noFunction) choices_[{stage, std::string(uniform)}] = function;
    return result;
}

std::string_view SubroutineTable::chosen(ShaderStage stage, std::string_view uniform) const {
    const Uniform* const found = find(stage, uniform);
    if (!found) return {};
    for (const Stage& s : stages_) {
        if (s.stage != stage) continue;
        for (const Function& candidate : found->compatible) {
            if (candidate.index == s.indices[found->location]) return candidate.name;
        }
    }
    return {};
}

std::vector<std::string> SubroutineTable::functions(ShaderStage stage,
                                                    std::string_view uniform) const {
    std::vector<std::string> names;
    if (const Uniform* const found = find(stage, uniform)) {
        for (const Function& function : found->compatible)
            names.push_back(function.name);
    }
    return names;
}

void SubroutineTable::inherit(const SubroutineTable& previous) {
    for (const auto& [key, function] : previous.choices_) {
        chooseInitially(key.first, key.second, function);
        choices_[key] = function; // even if it has gone for now
    }
}

void SubroutineTable::send(const GlContext& context) const {
    for (const Stage& stage : stages_) {
        context.gl().UniformSubroutinesuiv(shaderType(stage.stage), GLsizei(stage.indices.size()),
                                           stage.indices.data());
    }
}

} // namespace terrane
