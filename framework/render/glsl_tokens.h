// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace terrane {

/// A word, number or symbol of GLSL text. Comments, blanks and line continuations give none.
struct GlslToken {
    enum class Kind { identifier, number, symbol };

    Kind kind = Kind::symbol;
    std::size_t offset = 0;
    std::string_view text;      ///< points into the scanned text; symbols are single characters
    std::string_view directive; ///< "define", "if"...: of the line it stands in, with the '#'; else
                                ///< empty. "#" for a line of which the name is missing
};

/// All tokens, in order. Any bytes are accepted: what is no GLSL becomes symbols.
std::vector<GlslToken> scanGlsl(std::string_view text);

/// What counts of a text: all but comments, and the blanks between words. Two texts with the same
/// compile to the same, but for __LINE__.
std::string significantGlsl(std::string_view text);

/// The names that `#define` lines give a meaning.
std::vector<std::string_view> definedMacros(const std::vector<GlslToken>& tokens);

/// The end of the comment that starts at `offset`, or `offset` when none starts there. A `//`
/// comment ends before its line break (one that is not continued by '\'); one without an end goes
/// to the end of the text.
std::size_t skipGlslComment(std::string_view text, std::size_t offset);

/// The length of the continued line break ('\' and the end of the line) at `offset`, or 0.
std::size_t glslContinuation(std::string_view text, std::size_t offset);

bool isGlslIdentifierStart(char c);
bool isGlslIdentifierPart(char c);

} // namespace terrane
