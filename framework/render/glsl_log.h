// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "render/glsl_text.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace terrane {

/// One message of a GLSL compiler or linker.
struct GlslMessage {
    Severity severity = Severity::error;
    int line = 0;       ///< of the text that was compiled, from 1; 0 when it isn't told
    int column = 0;     ///< from 1; 0 when it isn't told. Mesa counts in its preprocessed line
    std::string text;   ///< without place and severity
    std::string detail; ///< further lines that belong to it, such as candidates
};

/// Takes the log of a compiler or linker apart. Understood are the forms of Mesa
/// (`0:12(5): error: ...`; AMD's and Intel's on Linux are Mesa's), NVIDIA (`0(12) : error C1008:
/// ...`), AMD on Windows (`ERROR: 0:12: error(#143) ...`), Intel on Windows, Apple and other users
/// of the reference compiler (`ERROR: 0:12: ...`), and mobile drivers (`0:12: L0001: ...`); what
/// has none of these becomes the detail of the message before it, or a message without a place. Any
/// bytes are accepted. Pure CPU, any thread.
std::vector<GlslMessage> parseGlslLog(std::string_view log);

/// Where in `text` a message points; nothing when it tells no line. The column is exact for Mesa
/// except behind a macro on the same line; there, and for drivers that tell none, it is that of the
/// name which the message quotes, if the line has it.
std::optional<std::size_t> offsetOf(const GlslMessage& message, const GlslText& text);

/// Reports a compiler's log ("glsl-compile"). When it failed, there is at least one error.
/// @param stage as people read it, for messages without a place
void reportCompileLog(std::string_view log, bool failed, const GlslText& text,
                      std::string_view stage, const Place& module, Diagnostics& diagnostics);

/// Reports a linker's log ("glsl-link"): at the first place in the program's texts of the name that
/// a message quotes, else at the program's.
void reportLinkLog(std::string_view log, bool failed, const Place& program,
                   const std::string& programName, const std::vector<const GlslText*>& texts,
                   Diagnostics& diagnostics);

} // namespace terrane
