// SPDX-License-Identifier: BSD-3-Clause
#include "app/script.h"

#include "app/options.h"
#include "app/script_words.h"
#include "core/text.h"

#include <utility>

namespace terrane {

namespace {

using Parsed = std::optional<ScriptCommand>;

Parsed parseCamera(ScriptWords& words) {
    const auto from = words.view();
    if (!from) return std::nullopt;
    CameraCommand command{*from, std::nullopt, 0};
    if (words.empty()) return command;
    if (!words.literal("to")) return std::nullopt;
    command.to = words.view();
    if (!command.to || !words.literal("in")) return std::nullopt;
    const auto frames = words.count();
    if (!frames || *frames < 1 || !words.literal("frames")) return std::nullopt;
    command.frames = *frames;
    return command;
}

Parsed parseFrames(ScriptWords& words) {
    const auto count = words.count();
    if (!count) return std::nullopt;
    return FramesCommand{*count};
}

Parsed parseWait(ScriptWords& words) {
    if (!words.literal("tiles")) return std::nullopt;
    if (words.empty()) return WaitCommand{kMostFrames};
    const auto frames = words.count();
    if (!frames) return std::nullopt;
    return WaitCommand{*frames};
}

template <class Command>
Parsed parseName(ScriptWords& words) {
    const auto name = words.word();
    if (!name) return std::nullopt;
    return Command{*name};
}

template <class Command>
Parsed parseNothing(ScriptWords&) {
    return Command{};
}

Parsed parseTiles(ScriptWords& words) {
    const auto producer = words.word();
    const auto comparison = words.comparison();
    const auto count = words.real();
    if (!producer || !comparison || !count) return std::nullopt;
    return ExpectTilesCommand{*producer, *comparison, *count};
}

Parsed parseHeight(ScriptWords& words) {
    const auto x = words.real(), y = words.real(), z = words.real(), tolerance = words.real();
    if (!x || !y || !z || !tolerance) return std::nullopt;
    return ExpectHeightCommand{*x, *y, *z, *tolerance};
}

Parsed parseImage(ScriptWords& words) {
    const auto file = words.word();
    if (!file) return std::nullopt;
    ExpectImageCommand command{*file, std::nullopt};
    if (words.empty()) return command;
    const std::string text = *words.word();
    const auto number = parseReal(text);
    if (!number || text.substr(number->length) != "%" || !std::isfinite(number->value))
        return std::nullopt;
    command.percent = number->value;
    return command;
}

Parsed parseDiagnostic(ScriptWords& words) {
    const auto code = words.word(), place = words.word();
    if (!code || !place) return std::nullopt;
    return ExpectDiagnosticCommand{*code, *place};
}

Parsed parseMetric(ScriptWords& words) {
    const auto pointer = words.word();
    const auto comparison = words.comparison();
    const auto value = words.real();
    if (!pointer || !pointer->starts_with('/') || !comparison || !value) return std::nullopt;
    // Times differ from run to run; nothing may depend on them.
    if (pointer->ends_with("ms") || pointer->find("_ms/") != std::string::npos) return std::nullopt;
    return ExpectMetricCommand{*pointer, *comparison, *value};
}

// The resource may have dots in its name, attributes don't.
Parsed parseSet(ScriptWords& words) {
    const auto target = words.word(), value = words.word();
    if (!target || !value) return std::nullopt;
    const std::size_t dot = target->rfind('.');
    if (dot == std::string::npos || dot == 0 || dot + 1 == target->size()) return std::nullopt;
    return SetCommand{target->substr(0, dot), target->substr(dot + 1), *value};
}

/// "down", "up", or nothing for both, one after the other.
std::optional<std::vector<bool>> parseStates(ScriptWords& words) {
    if (words.empty()) return std::vector{true, false};
    if (words.literal("down")) return std::vector{true};
    if (words.literal("up")) return std::vector{false};
    return std::nullopt;
}

/// Takes a character of UTF-8 off the front of a text; U+FFFD for a byte that belongs to none.
char32_t takeCharacter(std::string_view& text) {
    const auto byte = [text](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const unsigned first = byte(0);
    const std::size_t length = first < 0x80         ? 1
                               : first >> 5 == 0x06 ? 2
                               : first >> 4 == 0x0e ? 3
                               : first >> 3 == 0x1e ? 4
                                                    : 0;
    char32_t character = length < 2 ? first : first & (0x7fU >> length);
    bool wellFormed = length > 0;
    for (std::size_t i = 1; i < length; ++i) {
        wellFormed = wellFormed && byte(i) >> 6 == 2;
        character = character << 6 | (byte(i) & 0x3f);
    }
    static constexpr char32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000}; // of this length
    const bool surrogate = character >= 0xd800 && character <= 0xdfff;
    wellFormed = wellFormed && character >= kSmallest[length] && character <= 0x10ffff;
    wellFormed = wellFormed && !surrogate;
    text.remove_prefix(wellFormed ? length : 1);
    return wellFormed ? character : U'\ufffd';
}

std::vector<char32_t> characters(std::string_view text) {
    std::vector<char32_t> result;
    while (!text.empty())
        result.push_back(takeCharacter(text));
    return result;
}

InputCommand typed(std::string_view text) {
    InputCommand command;
    for (const char32_t character : characters(text))
        command.events.push_back(TextEvent{character});
    return command;
}

Parsed parseKey(ScriptWords& words) {
    static constexpr std::pair<std::string_view, bool Modifiers::*> kModifiers[] = {
        {"shift", &Modifiers::shift}, {"control", &Modifiers::control}, {"alt", &Modifiers::alt}};
    const auto name = words.word();
    const auto states = parseStates(words);
    if (!name || !states) return std::nullopt;
    for (const auto& [word, modifier] : kModifiers) {
        if (*name == word) return ModifierCommand{modifier, states->back()};
    }
    const auto key = keyNamed(*name);
    if (!key && characters(*name).size() != 1) return std::nullopt;
    if (!key) return states->front() ? typed(*name) : InputCommand{};
    InputCommand command;
    for (const bool down : *states)
        command.events.push_back(KeyEvent{*key, down, {}});
    return command;
}

Parsed parseMouse(ScriptWords& words) {
    if (words.literal("move")) {
        const auto x = words.real(), y = words.real();
        if (!x || !y) return std::nullopt;
        return InputCommand{{MouseMoveEvent{*x, *y}}};
    }
    const bool down = words.literal("down");
    if (!down && !words.literal("up")) return std::nullopt;
    static constexpr std::pair<std::string_view, MouseButton> kButtons[] = {
        {"left", MouseButton::left},
        {"middle", MouseButton::middle},
        {"right", MouseButton::right}};
    for (const auto& [word, button] : kButtons) {
        if (words.literal(word)) return InputCommand{{MouseButtonEvent{button, down, 0, 0, {}}}};
    }
    return std::nullopt;
}

Parsed parseWheel(ScriptWords& words) {
    const auto steps = words.real();
    if (!steps) return std::nullopt;
    return InputCommand{{WheelEvent{*steps, {}}}};
}

Parsed parseText(ScriptWords& words) {
    auto text = words.word();
    if (!text) return std::nullopt;
    while (!words.empty())
        *text += " " + *words.word();
    return typed(*text);
}

struct Rule {
    std::string_view name;
    std::string_view usage;
    Parsed (*parse)(ScriptWords&);
};

constexpr Rule kExpectations[] = {
    {"tiles", "expect tiles PRODUCER OP N", parseTiles},
    {"height", "expect height X Y Z TOLERANCE (metres; on planets X Y are longitude, latitude)",
     parseHeight},
    {"image", "expect image FILE [PIXELS%]", parseImage},
    {"diagnostic", "expect diagnostic CODE FILE:LINE:COL", parseDiagnostic},
    {"metric", "expect metric /POINTER OP N (counts only, never times)", parseMetric},
    {"no-errors", "expect no-errors", parseNothing<ExpectNoErrorsCommand>},
};

constexpr Rule kCommands[] = {
    {"camera", "camera X0,Y0,THETA,PHI,D [to X0,Y0,THETA,PHI,D in N frames]", parseCamera},
    {"frames", "frames N", parseFrames},
    {"wait", "wait tiles [MAXFRAMES]", parseWait},
    {"screenshot", "screenshot FILE", parseName<ScreenshotCommand>},
    {"mark", "mark", parseNothing<MarkCommand>},
    {"set", "set RESOURCE.ATTRIBUTE VALUE", parseSet},
    {"reload", "reload", parseNothing<ReloadCommand>},
    {"key", "key NAME [down|up] (escape, f5, pageup... or a character; shift, control, alt)",
     parseKey},
    {"mouse", "mouse move X Y (pixels from the top left), or mouse down|up left|middle|right",
     parseMouse},
    {"wheel", "wheel STEPS (up is above 0)", parseWheel},
    {"text", "text STRING", parseText},
    {"archive", "archive PATH", parseName<ArchiveCommand>},
    {"needs", "needs PATH", parseName<NeedsCommand>},
};

template <std::size_t N>
const Rule* find(const Rule (&rules)[N], std::string_view name) {
    for (const Rule& rule : rules) {
        if (rule.name == name) return &rule;
    }
    return nullptr;
}

template <std::size_t N>
void addNames(const Rule (&rules)[N], std::vector<std::string>& names) {
    for (const Rule& rule : rules)
        names.emplace_back(rule.name);
}

std::string unknown(const std::string& what, const std::string& name,
                    const std::vector<std::string>& names) {
    const std::string near = nearestName(name, names);
    return "unknown " + what + " '" + name + "'; " +
           (near.empty() ? "expected " + listOfNames(names) : "did you mean '" + near + "'?");
}

void apply(const Rule& rule, ScriptWords& words, ScriptLine& line) {
    line.command = rule.parse(words);
    if (line.command && words.empty()) return;
    line.command.reset();
    line.problem = "expected: " + std::string(rule.usage);
}

void parseExpect(ScriptWords& words, ScriptLine& line) {
    std::vector<std::string> names;
    addNames(kExpectations, names);
    const auto what = words.word();
    if (!what) {
        line.problem = "expected after 'expect': " + listOfNames(names);
    } else if (const Rule* rule = find(kExpectations, *what)) {
        apply(*rule, words, line);
    } else {
        line.problem = unknown("expectation", *what, names);
    }
}

} // namespace

bool holds(double left, Comparison comparison, double right) {
    switch (comparison) {
    case Comparison::equal:
        return left == right;
    case Comparison::notEqual:
        return left != right;
    case Comparison::less:
        return left < right;
    case Comparison::lessOrEqual:
        return left <= right;
    case Comparison::greater:
        return left > right;
    case Comparison::greaterOrEqual:
        return left >= right;
    }
    return false;
}

std::optional<ScriptLine> parseScriptLine(std::string_view text, int number) {
    ScriptLine line{number, std::string(text), std::nullopt, {}};
    const auto all = wordsOf(text);
    if (!all) {
        line.problem = "a quote is not closed";
        return line;
    }
    if (all->empty() || all->front().starts_with('#')) return std::nullopt;
    ScriptWords words(*all);
    const std::string name = *words.word();
    if (name == "expect") {
        parseExpect(words, line);
    } else if (const Rule* rule = find(kCommands, name)) {
        apply(*rule, words, line);
    } else {
        std::vector<std::string> names{"expect"};
        addNames(kCommands, names);
        line.problem = unknown("command", name, names);
    }
    return line;
}

std::vector<ScriptLine> parseScript(std::string_view text) {
    std::vector<ScriptLine> lines;
    int number = 0;
    for (const std::string_view piece : split(text, '\n')) {
        if (auto line = parseScriptLine(piece, ++number)) lines.push_back(std::move(*line));
    }
    return lines;
}

std::string scriptUsage() {
    std::string text;
    for (const Rule& rule : kCommands)
        text += "  " + std::string(rule.usage) + "\n";
    for (const Rule& rule : kExpectations)
        text += "  " + std::string(rule.usage) + "\n";
    return text;
}

} // namespace terrane
