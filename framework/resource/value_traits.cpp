// SPDX-License-Identifier: BSD-3-Clause
#include "resource/value_traits.h"

#include "core/text.h"
#include "resource/attribute_range.h"
#include "resource/declaration.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>

namespace terrane::detail {

namespace {

// Bytes that an entity of XML stands for; 0 when the text starts with none.
std::size_t entityLength(std::string_view text, std::size_t& decoded) {
    const std::size_t end = text.substr(0, 12).find(';');
    if (text.empty() || text[0] != '&' || end == std::string_view::npos) return 0;
    const std::string_view name = text.substr(1, end - 1);
    decoded = 1;
    if (name.starts_with('#')) {
        const int base = name.starts_with("#x") ? 16 : 10;
        const long code =
            std::strtol(std::string(name.substr(base == 16 ? 2 : 1)).c_str(), nullptr, base);
        decoded = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
        return end + 1;
    }
    const bool known =
        name == "amp" || name == "lt" || name == "gt" || name == "quot" || name == "apos";
    return known ? end + 1 : 0;
}

void wrongKind(const AttributeText& text, const AttributeDeclaration& a, std::string expected,
               Diagnostics& diagnostics) {
    diagnostics.error("wrong-kind", text.valuePlace,
                      inQuotes(text.text) + " is no value of '" + a.name + "'",
                      std::move(expected));
}

// What follows a number is ignored, as archives of the original rely on, but told.
void checkRest(std::string_view piece, std::size_t length, const Place& place,
               const AttributeDeclaration& a, Diagnostics& diagnostics) {
    const std::string_view rest = piece.substr(length);
    if (isBlank(rest)) return;
    ValueWalker walker(place);
    walker.advance(length);
    diagnostics.warning("trailing-garbage", walker.place(),
                        inQuotes(rest) + " after the number of '" + a.name + "' is ignored",
                        "a number alone");
}

bool isInRange(double value, const AttributeDeclaration& a) {
    const bool low = a.minimumExcluded ? value <= a.minimum : value < a.minimum;
    const bool finite = std::isfinite(value) || (a.infinite && !std::isnan(value));
    return !low && !(value > a.maximum) && finite;
}

// Puts a value into the range of its attribute, if that is all that is wrong with it.
template <class T>
bool fit(T& value, std::string_view piece, const Place& place, const AttributeDeclaration& a,
         Diagnostics& diagnostics) {
    if (isInRange(static_cast<double>(value), a)) return true;
    const double nearest = std::clamp(static_cast<double>(value), a.minimum, a.maximum);
    if (a.clamped && isInRange(nearest, a)) {
        value = static_cast<T>(nearest);
        diagnostics.warning("out-of-range", place,
                            "'" + a.name + "' of " + inQuotes(piece) + " counts as " +
                                fmt::format("{}", value),
                            rangeOf(a));
        return true;
    }
    diagnostics.error("out-of-range", place,
                      "'" + a.name + "' of " + inQuotes(piece) + " is out of range", rangeOf(a));
    return false;
}

template <class T, class Parse>
bool readPiece(std::string_view piece, const Place& place, const AttributeText& text,
               const AttributeDeclaration& a, const char* expected, Parse parse, T& value,
               Diagnostics& diagnostics) {
    const auto number = parse(piece);
    if (!number) {
        wrongKind({std::string(piece), text.namePlace, place}, a, expected, diagnostics);
        return false;
    }
    checkRest(piece, number->length, place, a, diagnostics);
    value = static_cast<T>(number->value);
    // As it is stored: what is too large for it is infinite.
    return fit(value, piece, place, a, diagnostics);
}

template <class T, class Parse>
bool readList(const AttributeText& text, const AttributeDeclaration& a, const char* expected,
              Parse parse, std::vector<T>& values, Diagnostics& diagnostics) {
    values.clear();
    bool good = true;
    ValueWalker walker(text.valuePlace);
    for (const std::string_view piece : split(text.text, ',')) {
        const std::size_t blanks = std::min(piece.find_first_not_of(" \t\r\n"), piece.size());
        walker.advance(blanks);
        const Place place = walker.place();
        walker.advance(piece.size() + 1 - blanks);
        if (piece.empty()) continue;
        T value{};
        good &=
            readPiece(piece.substr(blanks), place, text, a, expected, parse, value, diagnostics);
        values.push_back(value);
    }
    return good;
}

} // namespace

void ValueWalker::advance(std::size_t bytes) {
    if (!place_.file) return;
    const std::string_view text = place_.file->text();
    for (std::size_t read = 0; read < bytes && place_.offset < text.size();) {
        const std::string_view rest = text.substr(place_.offset);
        std::size_t decoded = 1;
        std::size_t written = entityLength(rest, decoded);
        if (written == 0) written = rest.starts_with("\r\n") ? 2 : 1;
        place_.offset += written;
        read += decoded;
    }
}

bool readBool(const AttributeText& text, const AttributeDeclaration& a, bool& value,
              Diagnostics& diagnostics) {
    value = a.trueUnlessFalse ? text.text != "false" : text.text == "true";
    if (text.text != "true" && text.text != "false") {
        diagnostics.warning("boolean-word", text.valuePlace,
                            inQuotes(text.text) + " counts as " + (value ? "true" : "false"),
                            "'true' or 'false'");
    }
    return true;
}

bool readInt(const AttributeText& text, const AttributeDeclaration& a, int& value,
             Diagnostics& diagnostics) {
    return readPiece(text.text, text.valuePlace, text, a, "an integer",
                     a.bits ? parseBits : parseInt, value, diagnostics);
}

bool readReal(const AttributeText& text, const AttributeDeclaration& a, double& value,
              Diagnostics& diagnostics) {
    return readPiece(text.text, text.valuePlace, text, a, "a number", parseReal, value,
                     diagnostics);
}

bool readFloat(const AttributeText& text, const AttributeDeclaration& a, float& value,
               Diagnostics& diagnostics) {
    return readPiece(text.text, text.valuePlace, text, a, "a number", parseReal, value,
                     diagnostics);
}

bool readIntList(const AttributeText& text, const AttributeDeclaration& a, std::vector<int>& values,
                 Diagnostics& diagnostics) {
    return readList(text, a, "integers separated by commas", parseInt, values, diagnostics);
}

bool readRealList(const AttributeText& text, const AttributeDeclaration& a,
                  std::vector<float>& values, Diagnostics& diagnostics) {
    return readList(text, a, "numbers separated by commas", parseReal, values, diagnostics);
}

bool readTextList(const AttributeText& text, const AttributeDeclaration&,
                  std::vector<std::string>& values, Diagnostics&) {
    values.clear();
    for (const std::string_view piece : split(text.text, ','))
        values.emplace_back(piece);
    return true;
}

bool readFileName(const AttributeText& text, const AttributeDeclaration&, DataFile& value,
                  Diagnostics&) {
    value.name = text.text;
    return true;
}

bool readTarget(const AttributeText& text, const AttributeDeclaration& a, Target& value,
                Diagnostics& diagnostics) {
    const std::size_t dot = text.text.find('.');
    const bool qualified = dot != std::string::npos;
    value.node = qualified ? text.text.substr(0, dot) : "";
    value.name = qualified ? text.text.substr(dot + 1) : text.text;
    if (!value.name.empty() && (!qualified || !value.node.empty()) && value.node != "$")
        return true;
    wrongKind(text, a, "a name, or 'this.name', '$variable.name' or 'flag.name'", diagnostics);
    return false;
}

bool readReference(const AttributeText& text, const AttributeDeclaration& a, std::string& name,
                   Diagnostics& diagnostics) {
    name = text.text;
    if (!name.empty()) return true;
    wrongKind(text, a, "the name of a resource", diagnostics);
    return false;
}

int readWord(const AttributeText& text, const AttributeDeclaration& a, Diagnostics& diagnostics) {
    for (std::size_t i = 0; i < a.words.size(); ++i) {
        if (a.words[i] == text.text) return static_cast<int>(i);
    }
    const auto byDefault = std::find(a.words.begin(), a.words.end(), a.defaultText);
    const bool useDefault = a.otherWordsMeanDefault && byDefault != a.words.end();
    diagnostics.report({.severity = useDefault ? Severity::warning : Severity::error,
                        .code = "unknown-word",
                        .place = text.valuePlace,
                        .message = inQuotes(text.text) + " is no value of '" + a.name + "'" +
                                   (useDefault ? ", and counts as '" + a.defaultText + "'" : ""),
                        .expected = listOfNames(a.words),
                        .suggestion = nearestName(text.text, a.words)});
    return useDefault ? static_cast<int>(byDefault - a.words.begin()) : -1;
}

bool readWords(const AttributeText& text, const AttributeDeclaration& a, std::vector<int>& indices,
               Diagnostics& diagnostics) {
    bool good = !text.text.empty() || readWord(text, a, diagnostics) >= 0;
    ValueWalker walker(text.valuePlace);
    for (const std::string_view piece : split(text.text, ',')) {
        const Place place = walker.place();
        walker.advance(piece.size() + 1);
        const int index = readWord({std::string(piece), text.namePlace, place}, a, diagnostics);
        if (index >= 0) indices.push_back(index);
        good &= index >= 0;
    }
    return good;
}

std::string print(bool value) {
    return value ? "true" : "false";
}
std::string print(int value) {
    return fmt::format("{}", value);
}
std::string print(double value) {
    return fmt::format("{}", value);
}
std::string print(float value) {
    return fmt::format("{}", value);
}

std::string print(const std::vector<int>& value) {
    return fmt::format("{}", fmt::join(value, ","));
}
std::string print(const std::vector<float>& value) {
    return fmt::format("{}", fmt::join(value, ","));
}
std::string print(const std::vector<std::string>& value) {
    return fmt::format("{}", fmt::join(value, ","));
}

std::string print(const Target& value) {
    return value.node.empty() ? value.name : value.node + "." + value.name;
}

void referTo(AttributeDeclaration& attribute, std::type_index interface) {
    attribute.refersTo = interface;
}

} // namespace terrane::detail
