// SPDX-License-Identifier: BSD-3-Clause
#include "resource/schema_text.h"

#include "core/text.h"
#include "resource/attribute_range.h"
#include "resource/value_grammar.h"

#include <algorithm>
#include <cctype>

namespace terrane {

namespace {

bool isNumber(ValueKind kind) {
    return kind == ValueKind::integer || kind == ValueKind::real ||
           kind == ValueKind::integerList || kind == ValueKind::realList;
}

std::string rangeSentence(const AttributeDeclaration& a) {
    if (!isNumber(a.kind)) return {};
    const std::string range = rangeOf(a);
    if (range != "a finite number") return asSentence(range);
    return a.unit.empty() ? "" : "In " + a.unit + ".";
}

} // namespace

std::string asSentence(std::string text) {
    if (text.empty()) return text;
    // What is a name, such as mat4, stays as it is spelt.
    const std::string_view word = std::string_view(text).substr(0, text.find_first_of(" :,;"));
    const auto rest = word.substr(std::min<std::size_t>(1, word.size()));
    const bool isName = std::any_of(rest.begin(), rest.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return std::isupper(byte) || std::isdigit(byte) || c == '.' || c == '_';
    });
    if (!isName) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    if (text.back() != '.' && text.back() != '?') text += '.';
    return text;
}

std::vector<std::string> referredTags(const Registry& registry, const AttributeDeclaration& a) {
    std::vector<std::string> tags;
    if (!a.refersTo || *a.refersTo == std::type_index(typeid(Resource))) return tags;
    for (const std::string& tag : registry.tagsOf(*a.refersTo)) {
        if (!registry.find(tag)->planned) tags.push_back(tag);
    }
    return tags;
}

std::string referredName(const Registry& registry, const AttributeDeclaration& a) {
    if (!a.refersTo) return {};
    if (*a.refersTo == std::type_index(typeid(Resource))) return "any resource";
    std::string name = registry.interfaceName(*a.refersTo);
    if (name.starts_with("a ")) name.erase(0, 2);
    return name;
}

std::string documentation(const ElementDeclaration& element) {
    std::string text = asSentence(element.summary);
    if (element.planned) text += " Not built yet: accepted, without effect.";
    return text;
}

std::string documentation(const Schema& schema, const ElementDeclaration& element,
                          const AttributeDeclaration& a) {
    std::string text = asSentence(a.summary);
    const auto add = [&](const std::string& sentence) {
        if (!sentence.empty()) text += " " + sentence;
    };
    add(rangeSentence(a));
    if (a.refersTo) {
        const std::string name = referredName(schema.registry(), a);
        const std::vector<std::string> tags = referredTags(schema.registry(), a);
        const bool plain = tags.empty() || (tags.size() == 1 && tags[0] == name);
        std::string list = listOfNames(tags);
        if (!plain && !name.empty()) list = name + ": " + list;
        add("Refers to " + (plain ? name : list) + ".");
    }
    for (const std::string& alias : a.aliases)
        add("Also spelt '" + alias + "'.");
    if (const auto byDefault = writtenDefault(element, a)) add("Default: " + *byDefault + ".");
    if (a.planned) add("Has no effect yet.");
    return text;
}

} // namespace terrane
