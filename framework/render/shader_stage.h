// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>

namespace terrane {

/// The programmable stages that archives know, in pipeline order.
enum class ShaderStage { vertex, tessControl, tessEvaluation, geometry, fragment };

inline constexpr std::array kShaderStages{ShaderStage::vertex, ShaderStage::tessControl,
                                          ShaderStage::tessEvaluation, ShaderStage::geometry,
                                          ShaderStage::fragment};
inline constexpr std::size_t kShaderStageCount = kShaderStages.size();

/// As people read it: "tessellation control".
constexpr std::string_view stageName(ShaderStage stage) {
    constexpr std::array<std::string_view, kShaderStageCount> names{
        "vertex", "tessellation control", "tessellation evaluation", "geometry", "fragment"};
    return names[static_cast<std::size_t>(stage)];
}

/// The macro that is defined in a module of one file while this stage is compiled.
constexpr std::string_view stageMacro(ShaderStage stage) {
    constexpr std::array<std::string_view, kShaderStageCount> macros{
        "_VERTEX_", "_TESS_CONTROL_", "_TESS_EVAL_", "_GEOMETRY_", "_FRAGMENT_"};
    return macros[static_cast<std::size_t>(stage)];
}

} // namespace terrane
