// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "render/glsl_text.h"
#include "render/shader_stage.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace terrane {

/// Where `#include "name"` finds files. The same file should give the same object every time.
struct GlslFiles {
    /// The file of a name, or null; `place` is that of the include.
    std::function<std::shared_ptr<const SourceFile>(const std::string& name, const Place& place)>
        find;
    /// Optional: names that exist and resemble this one, for "did you mean".
    std::function<std::vector<std::string>(const std::string& name)> namesNear;
};

/// A file with all its includes in place.
struct ExpandedGlsl {
    GlslText text;
    std::vector<std::shared_ptr<const SourceFile>> files; ///< all that were read, each once
    bool complete = true;                                 ///< no include failed
};

/// Replaces each `#include "name"` that stands outside comments by the named file's text, inline
/// and recursively; the rest of the line stays. There are no guards and no conditions: an include
/// inside `#ifdef` is expanded too (ork reference 2.4).
///
/// Errors, at the `#` of the include: "include-missing", "include-cycle", "include-syntax", and
/// "include-limit" for text that grows beyond all reason. The result is never larger than
/// kLongestGlsl. Pure CPU, any thread.
ExpandedGlsl expandGlsl(const std::shared_ptr<const SourceFile>& file, const GlslFiles& files,
                        Diagnostics& diagnostics);

/// 16 MiB: a thousand times the largest shader of the original's archives.
inline constexpr std::size_t kLongestGlsl = std::size_t{16} << 20;

/// Whether a module of one file has a stage: its macro occurs anywhere in the expanded text, even
/// in a comment.
bool mentionsStage(const GlslText& text, ShaderStage stage);

/// What stands above the file in the text of a stage.
struct GlslHeader {
    int version = 330;
    Place versionPlace;
    std::optional<ShaderStage> macro; ///< defined in modules of one file only
    std::vector<std::string> options; ///< "A", "TAPS 4": one `#define` each; empty ones are skipped
    Place optionsPlace;
};

/// The text of one stage as the compiler gets it: `#version`, the stage's macro, the options, the
/// file.
GlslText assembleStage(const GlslHeader& header, const GlslText& expanded);

} // namespace terrane
