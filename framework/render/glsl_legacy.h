// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "render/glsl_text.h"
#include "render/shader_stage.h"

#include <string>
#include <string_view>
#include <vector>

namespace terrane {

/// Archives of the original were written for drivers that took spellings which core OpenGL 4
/// refuses. These rewrite them, token by token, lines kept:
///
/// - texture functions of the old extensions: `texture2DArrayGrad` and its family to `textureGrad`,
///   `texelFetch2D`, `textureSize2D`...; from GLSL 4.20 on also `texture2D`, `shadow2D`...
/// - `gl_PositionIn[i]` to `gl_in[i].gl_Position`, likewise `gl_PointSizeIn`, `gl_VerticesIn`
/// - words that are reserved in the module's version (`filter`, `input`; from 4.00 on `sample`,
///   `patch`...; from 4.30 on `buffer`, `shared`) and stand as identifiers: a prefix is put before
///   them, which reflection takes off again (originalGlslName)
/// - from GLSL 4.20 on `attribute`, `varying`; `gl_FragColor` and `gl_FragData` to declared outputs
///   (the former to the first draw buffer only, no longer to all of them)
/// - `#extension` lines for what is core by now; `#line`, which would confuse places
///
/// What an author defines (a macro or a function of that name) is left alone.

/// One rewriting, for the report.
struct LegacyChange {
    Place place;
    std::string from;
    std::string to; ///< empty: taken out
};

/// Rewrites a text of one stage (before its header is put above it). `macros` are defined outside
/// the text, by the module's options. Appends what it changed. Pure CPU, any thread.
GlslText rewriteLegacyGlsl(const GlslText& text, int version, ShaderStage stage,
                           const std::vector<std::string>& macros,
                           std::vector<LegacyChange>& changes);

/// One warning ("legacy-glsl") for each file, at the first change in it, which lists them all.
void reportLegacyGlsl(const std::vector<LegacyChange>& changes, Diagnostics& diagnostics);

/// The name that an author wrote for one that the compiler knows (`a.terrane_filter[1]` was
/// `a.filter[1]`), also for all names in a compiler's message.
std::string originalGlslName(std::string_view name);

} // namespace terrane
