// SPDX-License-Identifier: BSD-3-Clause
#include "render/glsl_log.h"

#include "core/text.h"
#include "render/glsl_legacy.h"
#include "render/glsl_tokens.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace terrane {

namespace {

// After a missing semicolon the rest is noise; this many say what there is to say.
constexpr std::size_t kMostMessages = 20;

/// Reads pieces off the front of a line; each returns false and moves nothing when it isn't there.
class LineReader {
public:
    explicit LineReader(std::string_view line)
        : rest_(line) {}

    bool number(int& value) {
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        if (error != std::errc{} || value < 0) return false;
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return true;
    }
    bool text(std::string_view expected) {
        if (!rest_.starts_with(expected)) return false;
        rest_.remove_prefix(expected.size());
        return true;
    }
    // "error", "fatal error", "preprocessor error", "warning", in any case.
    bool severity(Severity& severity) {
        for (const std::string_view before : {"preprocessor ", "fatal ", "internal "})
            text(before);
        if (text("error") || text("ERROR") || text("Error"))
            severity = Severity::error;
        else if (text("warning") || text("WARNING") || text("Warning"))
            severity = Severity::warning;
        else
            return false;
        return true;
    }
    std::string_view rest() const { return rest_; }

private:
    std::string_view rest_;
};

// `0:12(5): error: text`
bool readMesa(std::string_view line, GlslMessage& message) {
    LineReader reader(line);
    int source = 0;
    if (!(reader.number(source) && reader.text(":") && reader.number(message.line) &&
          reader.text("(") && reader.number(message.column) && reader.text("): ") &&
          reader.severity(message.severity) && reader.text(":")))
        return false;
    reader.text(" ");
    message.text = reader.rest();
    return true;
}

// `0(12) : error C1008: text`
bool readNvidia(std::string_view line, GlslMessage& message) {
    LineReader reader(line);
    int source = 0;
    int number = 0;
    reader.number(source);
    if (!(reader.text("(") && reader.number(message.line) && reader.text(")"))) return false;
    reader.text(" ");
    if (!reader.text(":")) return false;
    reader.text(" ");
    if (!reader.severity(message.severity)) return false;
    reader.text(" ");
    if (reader.text("C")) reader.number(number);
    reader.text(":");
    reader.text(" ");
    message.text = reader.rest();
    return true;
}

// AMD's own number: `error(#143) text`. NVIDIA has one before its linker's messages: `C5145: text`.
void skipNumber(LineReader& reader) {
    LineReader numbered = reader;
    Severity severity{};
    int number = 0;
    if (numbered.severity(severity) && numbered.text("(#") && numbered.number(number) &&
        numbered.text(")")) {
        numbered.text(":");
        numbered.text(" ");
        reader = numbered;
    }
}

// `ERROR: 0:12: text`, and Mesa's linker: `error: text`
bool readSeverityFirst(std::string_view line, GlslMessage& message) {
    LineReader reader(line);
    if (!(reader.severity(message.severity) && reader.text(":"))) return false;
    reader.text(" ");
    LineReader place = reader;
    int source = 0;
    if (place.number(source) && place.text(":") && place.number(message.line) && place.text(":")) {
        place.text(" ");
        reader = place;
    } else {
        message.line = 0;
    }
    skipNumber(reader);
    message.text = reader.rest();
    return true;
}

// AMD names the text that it found on a line of its own, and NVIDIA one given to `#line` in quotes:
// `"s.glsl"(12) : error C1008: text`
std::string_view withoutFileName(std::string_view line) {
    const std::size_t close = line.starts_with('"') ? line.find('"', 1) : std::string_view::npos;
    return close == std::string_view::npos ? line : line.substr(close + 1);
}

// `0:12: L0001: text`, of mobile drivers
bool readPlaceFirst(std::string_view line, GlslMessage& message) {
    LineReader reader(line);
    int source = 0;
    if (!(reader.number(source) && reader.text(":") && reader.number(message.line) &&
          reader.text(": ")))
        return false;
    if (reader.severity(message.severity)) reader.text(":");
    reader.text(" ");
    message.text = reader.rest();
    return true;
}

bool readMessage(std::string_view line, GlslMessage& message) {
    line = withoutFileName(line);
    for (const auto read : {readMesa, readNvidia, readSeverityFirst, readPlaceFirst}) {
        GlslMessage candidate;
        if (!read(line, candidate)) continue;
        message = std::move(candidate);
        return true;
    }
    return false;
}

// Headings and counts, which say nothing: "2 compilation errors. No code generated.", the stages of
// NVIDIA's linker, AMD's "Vertex shader failed to compile with the following errors:".
bool isSummary(std::string_view text) {
    const auto has = [&](std::string_view words) { return text.find(words) != text.npos; };
    return has("compilation errors") || has("No code generated") ||
           has("with the following errors:") || has("with the following warnings:") ||
           has(" shader(s) linked.") ||
           has(" shader was successfully compiled to run on hardware.") ||
           text.find_first_not_of("- \t") == text.npos || text.ends_with(" info");
}

// Mesa lists the candidates of a failed overload resolution as messages of their own, indented.
bool continues(const GlslMessage& message, const GlslMessage& before) {
    return message.text.starts_with("   ") && message.line == before.line &&
           message.column == before.column;
}

void addDetail(GlslMessage& message, std::string_view line) {
    if (!message.detail.empty()) message.detail += '\n';
    message.detail += line;
}

/// A line as Mesa's compiler sees it: comments and runs of blanks are one space, continued lines
/// are joined. Each byte with its offset in the text.
struct CollapsedLine {
    std::string text;
    std::vector<std::size_t> offsets;
    std::size_t end = 0; // of the line in the original text
};

CollapsedLine collapse(std::string_view text, std::size_t begin) {
    CollapsedLine line;
    bool blank = false;
    std::size_t i = begin;
    while (i < text.size() && text[i] != '\n') {
        const std::size_t afterComment = skipGlslComment(text, i);
        const std::size_t continued = glslContinuation(text, i);
        const bool space = text[i] == ' ' || text[i] == '\t' || text[i] == '\r';
        if (continued > 0) {
            i += continued;
            continue;
        }
        if (afterComment > i || space) {
            if (!blank) {
                line.text += ' ';
                line.offsets.push_back(i);
            }
            blank = true;
            i = std::max(afterComment, i + 1);
            continue;
        }
        blank = false;
        line.text += text[i];
        line.offsets.push_back(i++);
    }
    line.end = i;
    return line;
}

// The name that AMD puts behind the last colon: `Undeclared identifier: x`.
std::string_view nameBehindColon(std::string_view message) {
    const std::size_t colon = message.rfind(": ");
    if (colon == std::string_view::npos) return {};
    std::string_view name = message.substr(colon + 2);
    while (!name.empty() && name.back() == ' ')
        name.remove_suffix(1);
    const bool word = !name.empty() && isGlslIdentifierStart(name[0]) &&
                      std::all_of(name.begin(), name.end(), isGlslIdentifierPart);
    return word ? name : std::string_view{};
}

// `x' as Mesa quotes, 'x' and "x" as the others do; of a syntax error of NVIDIA's, what it found.
std::string_view quotedName(std::string_view message) {
    if (const std::size_t token = message.find("at token \""); token != std::string_view::npos)
        message.remove_prefix(token);
    const std::size_t open = message.find_first_of("`'\"");
    if (open == std::string_view::npos) return nameBehindColon(message);
    const std::size_t close = message.find_first_of("'\"", open + 1);
    if (close == std::string_view::npos) return nameBehindColon(message);
    std::string_view name = message.substr(open + 1, close - open - 1);
    // `f(vec3)' names a function with its arguments.
    name = name.substr(0, name.find('('));
    return !name.empty() && isGlslIdentifierStart(name[0]) ? name : std::string_view{};
}

// Where a name stands on a line as a whole word, nearest to a wanted offset.
std::optional<std::size_t> findName(const std::vector<GlslToken>& tokens, std::string_view name,
                                    std::size_t wanted) {
    std::optional<std::size_t> best;
    const auto distance = [&](std::size_t at) { return at > wanted ? at - wanted : wanted - at; };
    for (const GlslToken& token : tokens) {
        if (token.text == name && (!best || distance(token.offset) < distance(*best)))
            best = token.offset;
    }
    return best;
}

std::optional<std::size_t> firstMacro(const std::vector<GlslToken>& line,
                                      const std::vector<std::string_view>& macros) {
    for (const GlslToken& token : line) {
        if (std::find(macros.begin(), macros.end(), token.text) != macros.end())
            return token.offset;
    }
    return std::nullopt;
}

// Where a name stands in one of the texts for the first time.
Place placeOfName(std::string_view name, const std::vector<const GlslText*>& texts) {
    if (name.empty()) return {};
    for (const GlslText* text : texts) {
        for (const GlslToken& token : scanGlsl(text->text())) {
            if (token.text != name) continue;
            if (Place place = text->place(token.offset)) return place;
        }
    }
    return {};
}

Diagnostic diagnosticOf(const GlslMessage& message, std::string code) {
    return {.severity = message.severity,
            .code = std::move(code),
            .message = originalGlslName(message.text),
            .detail = originalGlslName(message.detail)};
}

} // namespace

std::vector<GlslMessage> parseGlslLog(std::string_view log) {
    std::vector<GlslMessage> messages;
    for (std::string_view line : split(log, '\n')) {
        while (!line.empty() && (line.back() == '\r' || line.back() == '\0'))
            line.remove_suffix(1);
        GlslMessage message;
        if (isBlank(line) || isSummary(line)) continue;
        if (readMessage(line, message)) {
            if (!messages.empty() && continues(message, messages.back()))
                addDetail(messages.back(), message.text);
            else
                messages.push_back(std::move(message));
        } else if (!messages.empty()) {
            addDetail(messages.back(), line);
        } else {
            message.text = line;
            messages.push_back(std::move(message));
        }
    }
    return messages;
}

std::optional<std::size_t> offsetOf(const GlslMessage& message, const GlslText& text) {
    if (message.line < 1) return std::nullopt;
    const std::size_t begin = text.lineStart(message.line);
    const CollapsedLine line = collapse(text.text(), begin);
    std::size_t offset = begin;
    if (message.column > 0 && !line.offsets.empty()) {
        const auto index = static_cast<std::size_t>(message.column) - 1;
        offset = index < line.offsets.size() ? line.offsets[index] : line.offsets.back();
    } else if (!line.offsets.empty()) {
        offset = line.offsets[line.text[0] == ' ' && line.offsets.size() > 1 ? 1 : 0];
    }
    std::vector<GlslToken> tokens =
        scanGlsl(std::string_view(text.text()).substr(begin, line.end - begin));
    for (GlslToken& token : tokens)
        token.offset += begin;
    const std::vector<GlslToken> all = scanGlsl(text.text());
    const auto macro = firstMacro(tokens, definedMacros(all));
    const bool exact = message.column > 0 && (!macro || offset < *macro);
    if (exact) return offset;
    if (const std::string_view name = quotedName(message.text); !name.empty()) {
        if (const auto found = findName(tokens, name, offset)) return found;
    }
    // The name is not on the line, so it came from a macro.
    return macro ? *macro : offset;
}

void reportCompileLog(std::string_view log, bool failed, const GlslText& text,
                      std::string_view stage, const Place& module, Diagnostics& diagnostics) {
    std::vector<GlslMessage> messages = parseGlslLog(log);
    const bool told = std::any_of(messages.begin(), messages.end(), [](const GlslMessage& m) {
        return m.severity == Severity::error;
    });
    if (failed && !told)
        messages.push_back({.text = "the driver refused the " + std::string(stage) +
                                    " stage and did not say why"});
    if (messages.size() > kMostMessages) messages.resize(kMostMessages);
    for (const GlslMessage& message : messages) {
        Diagnostic d = diagnosticOf(message, "glsl-compile");
        if (!failed) d.severity = Severity::warning;
        if (const auto offset = offsetOf(message, text)) {
            d.place = text.place(*offset);
            for (const Place& include : text.inclusions(*offset))
                d.chain.push_back("#include at " + include.toString());
        }
        if (!d.place) {
            d.place = module;
            d.message = std::string(stage) + " stage: " + d.message;
        }
        diagnostics.report(std::move(d));
    }
}

void reportLinkLog(std::string_view log, bool failed, const Place& program,
                   const std::string& programName, const std::vector<const GlslText*>& texts,
                   Diagnostics& diagnostics) {
    std::vector<GlslMessage> messages = parseGlslLog(log);
    const bool told = std::any_of(messages.begin(), messages.end(), [](const GlslMessage& m) {
        return m.severity == Severity::error;
    });
    if (failed && !told)
        messages.push_back({.text = "the driver refused to link and did not say why"});
    if (messages.size() > kMostMessages) messages.resize(kMostMessages);
    for (const GlslMessage& message : messages) {
        Diagnostic d = diagnosticOf(message, "glsl-link");
        if (!failed) d.severity = Severity::warning;
        d.place = placeOfName(quotedName(message.text), texts);
        if (d.place && program) {
            d.chain.push_back("program " + inQuotes(programName) + ", linked at " +
                              program.toString());
        }
        if (!d.place) d.place = program;
        d.message = "program '" + programName + "': " + d.message;
        diagnostics.report(std::move(d));
    }
}

} // namespace terrane
