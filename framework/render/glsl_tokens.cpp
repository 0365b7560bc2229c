// SPDX-License-Identifier: BSD-3-Clause
#include "render/glsl_tokens.h"

namespace terrane {

namespace {

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

std::size_t tokenEnd(std::string_view text, std::size_t i) {
    const bool word = isGlslIdentifierStart(text[i]);
    const bool number =
        isDigit(text[i]) || (text[i] == '.' && i + 1 < text.size() && isDigit(text[i + 1]));
    if (!word && !number) return i + 1;
    ++i;
    while (i < text.size() && (isGlslIdentifierPart(text[i]) || (number && text[i] == '.')))
        ++i;
    return i;
}

GlslToken::Kind kindOf(std::string_view token) {
    if (isGlslIdentifierStart(token[0])) return GlslToken::Kind::identifier;
    const bool number = isDigit(token[0]) || token.size() > 1;
    return number ? GlslToken::Kind::number : GlslToken::Kind::symbol;
}

} // namespace

bool isGlslIdentifierStart(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool isGlslIdentifierPart(char c) {
    return isGlslIdentifierStart(c) || isDigit(c);
}

std::size_t glslContinuation(std::string_view text, std::size_t offset) {
    if (offset >= text.size() || text[offset] != '\\') return 0;
    const std::string_view rest = text.substr(offset + 1);
    if (rest.starts_with("\r\n")) return 3;
    return rest.starts_with('\n') ? 2 : 0;
}

std::size_t skipGlslComment(std::string_view text, std::size_t offset) {
    const std::string_view rest = text.substr(offset);
    if (rest.starts_with("/*")) {
        const std::size_t end = text.find("*/", offset + 2);
        return end == std::string_view::npos ? text.size() : end + 2;
    }
    if (!rest.starts_with("//")) return offset;
    while (offset < text.size() && text[offset] != '\n') {
        const std::size_t continued = glslContinuation(text, offset);
        offset += continued > 0 ? continued : 1;
    }
    return offset;
}

std::vector<GlslToken> scanGlsl(std::string_view text) {
    std::vector<GlslToken> tokens;
    bool lineBegins = true;
    std::string_view directive;
    std::size_t i = 0;
    while (i < text.size()) {
        const std::size_t afterComment = skipGlslComment(text, i);
        const std::size_t continued = glslContinuation(text, i);
        if (afterComment > i || continued > 0) {
            i = afterComment > i ? afterComment : i + continued;
            continue;
        }
        const char c = text[i];
        if (c == '\n') {
            lineBegins = true;
            directive = {};
        }
        if (c == '\n' || c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f') {
            ++i;
            continue;
        }
        const std::size_t end = tokenEnd(text, i);
        const std::string_view token = text.substr(i, end - i);
        const bool hash = c == '#' && lineBegins;
        const bool word = directive == "#" && kindOf(token) == GlslToken::Kind::identifier;
        if (hash || word) directive = token;
        tokens.push_back({kindOf(token), i, token, directive});
        lineBegins = false;
        i = end;
    }
    return tokens;
}

std::string significantGlsl(std::string_view text) {
    std::string result;
    std::size_t end = 0;
    std::string_view directive;
    for (const GlslToken& token : scanGlsl(text)) {
        // A blank may tell one word from two, and `#define F(x)` from `#define F (x)`.
        if (token.directive.data() != directive.data())
            result += '\n';
        else if (token.offset > end)
            result += ' ';
        result += token.text;
        directive = token.directive;
        end = token.offset + token.text.size();
    }
    return result;
}

std::vector<std::string_view> definedMacros(const std::vector<GlslToken>& tokens) {
    std::vector<std::string_view> names;
    for (std::size_t i = 2; i < tokens.size(); ++i) {
        const bool define = tokens[i - 1].text == "define" && tokens[i - 2].text == "#" &&
                            tokens[i].directive == "define";
        if (define && tokens[i].kind == GlslToken::Kind::identifier)
            names.push_back(tokens[i].text);
    }
    return names;
}

} // namespace terrane
