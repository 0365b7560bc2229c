// SPDX-License-Identifier: BSD-3-Clause
#include "resource/manual_section.h"

#include "resource/attribute_range.h"
#include "resource/markdown.h"
#include "resource/schema_text.h"
#include "resource/value_grammar.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace terrane {

namespace {

// More words than these don't fit into a cell.
constexpr std::size_t kWordsInCell = 6;
// More types than these are told by the word for all of them.
constexpr std::size_t kTypesInCell = 3;

std::string tagText(const ElementDeclaration& d) {
    return "<" + d.tag + (d.prefix ? "*" : "") + ">";
}

std::vector<std::string> asCodes(const std::vector<std::string>& words) {
    std::vector<std::string> codes;
    for (const std::string& word : words)
        codes.push_back(asCode(word));
    return codes;
}

std::string numberText(const std::string& noun, const AttributeDeclaration& a) {
    const std::string range = rangeOf(a);
    std::string text = noun;
    if (range != "a finite number")
        text += ", " + range;
    else if (!a.unit.empty())
        text += ", in " + a.unit;
    return text + (a.infinite ? ", or infinite" : "");
}

std::string countText(const ChildRule& rule) {
    if (rule.atLeast == 1 && rule.atMost == 1) return ", exactly one";
    if (rule.atLeast == 0 && rule.atMost == 1) return ", at most one";
    if (rule.atLeast == 1) return ", at least one";
    return "";
}

} // namespace

ManualSections::ManualSections(const Schema& schema)
    : schema_(schema) {
    for (const SchemaElement& resource : schema.resources())
        byTag_[resource.tag] = resource.type;
    std::set<const SchemaType*> entries;
    for (const SchemaElement& entry : schema.entries())
        entries.insert(entry.type);
    for (const SchemaType& type : schema.types()) {
        for (const SchemaRule& rule : type.rules) {
            for (const SchemaElement& element : rule.elements) {
                const bool local = !entries.contains(element.type);
                if (local && element.type != &type) parent_.try_emplace(element.type, &type);
            }
        }
    }
    // A list stands at its first use, in the order of pages.
    const auto collect = [&](const std::string& chapter) {
        for (const SchemaType& type : schema.types()) {
            if (chapterOf(type) != chapter) continue;
            for (const AttributeDeclaration& a : type.declaration->attributes) {
                if (a.words.size() > kWordsInCell) longLists_.try_emplace(a.words, &type);
            }
        }
    };
    for (const Chapter& chapter : schema.registry().chapters())
        collect(chapter.title);
    collect("Others");
}

std::string ManualSections::chapterOf(const SchemaType& type) {
    return type.declaration->chapter.empty() ? "Others" : type.declaration->chapter;
}

std::string ManualSections::heading(const SchemaType& type) const {
    std::string text = asCode(tagText(*type.declaration));
    const auto parent = parent_.find(&type);
    if (parent != parent_.end()) text += " in " + asCode(tagText(*parent->second->declaration));
    return text;
}

std::string ManualSections::link(const SchemaType& type, const std::string& chapter) const {
    const std::string page = chapterOf(type);
    return asLink(asCode(tagText(*type.declaration)),
                  (page == chapter ? "" : pageOf(page)) + "#" + anchorOf(heading(type)));
}

std::string ManualSections::list(const Types& types, const std::string& chapter,
                                 const std::string& lastWord) const {
    std::vector<std::string> links;
    for (const SchemaType* type : types)
        links.push_back(link(*type, chapter));
    return alternatives(links, lastWord);
}

std::string ManualSections::write(const SchemaType& type) const {
    const bool local = parent_.contains(&type);
    std::string text = (local ? "### " : "## ") + heading(type) + "\n\n";
    text += asMarkdown(documentation(*type.declaration)) + "\n";
    if (type.declaration->prefix) {
        text += "\nTags: ";
        std::string tags;
        for (const std::string& tag : asCodes(type.declaration->tags()))
            tags += (tags.empty() ? "" : ", ") + tag;
        text += tags + ".\n";
    }
    text += parents(type);
    if (!type.declaration->example.empty())
        text += "\n```xml\n" + type.declaration->example + "\n```\n";
    text += attributes(type) + words(type) + children(type) + usedBy(type);
    for (const SchemaType* nested : locals(type))
        text += "\n" + write(*nested);
    return text;
}

// Those that stand in the type before they stand anywhere else.
ManualSections::Types ManualSections::locals(const SchemaType& type) const {
    Types result;
    for (const SchemaRule& rule : type.rules) {
        for (const SchemaElement& element : rule.elements) {
            const auto parent = parent_.find(element.type);
            const bool own = parent != parent_.end() && parent->second == &type;
            if (own && std::find(result.begin(), result.end(), element.type) == result.end())
                result.push_back(element.type);
        }
    }
    return result;
}

// Resources may stand in archives, which the index says; here is where else.
std::string ManualSections::parents(const SchemaType& type) const {
    if (parent_.contains(&type)) return {};
    Types found;
    for (const SchemaType& parent : schema_.types()) {
        for (const SchemaRule& rule : parent.rules) {
            for (const SchemaElement& element : rule.elements) {
                if (element.type == &type && !element.keyed) found.push_back(&parent);
            }
        }
    }
    if (found.empty()) return {};
    return "\nStands in an archive, or in " + list(found, chapterOf(type)) + ".\n";
}

std::string ManualSections::attributes(const SchemaType& type) const {
    if (type.declaration->attributes.empty()) return {};
    std::string text =
        "\n" + tableRow({"Attribute", "Value", "Default", "Meaning"}) + "|---|---|---|---|\n";
    for (const AttributeDeclaration& a : type.declaration->attributes)
        text += row(type, a);
    return text;
}

std::string ManualSections::row(const SchemaType& type, const AttributeDeclaration& a) const {
    const auto byDefault = writtenDefault(*type.declaration, a);
    std::string meaning = asMarkdown(asSentence(a.summary));
    for (const std::string& alias : a.aliases)
        meaning += " Also spelt " + asCode(alias) + ".";
    if (a.planned) meaning += " Has no effect yet.";
    return tableRow({asCode(a.name), value(type, a),
                     a.required  ? "**required**"
                     : byDefault ? asCode(*byDefault)
                                 : "",
                     meaning});
}

std::string ManualSections::value(const SchemaType& type, const AttributeDeclaration& a) const {
    switch (a.kind) {
    case ValueKind::boolean:
        return "`true` or `false`";
    case ValueKind::integer:
        return numberText("integer", a);
    case ValueKind::real:
        return numberText("number", a);
    case ValueKind::integerList:
        return numberText("list of integers", a);
    case ValueKind::realList:
        return numberText("list of numbers", a);
    case ValueKind::enumeration:
        return a.words.size() <= kWordsInCell ? alternatives(asCodes(a.words))
                                              : "a word, see below";
    case ValueKind::enumerationList:
        return (a.words.size() <= kWordsInCell ? "list of " + alternatives(asCodes(a.words))
                                               : "list of words, see below");
    case ValueKind::reference:
        return "name of " + referred(type, a);
    case ValueKind::referenceList:
        return "list of names of " + referred(type, a);
    case ValueKind::target:
        return asLink("target", "README.md#targets");
    case ValueKind::file:
        return "file";
    case ValueKind::textList:
        return "list of texts";
    case ValueKind::text:
        break;
    }
    return a.read ? "text" : "ignored";
}

std::string ManualSections::referred(const SchemaType& type, const AttributeDeclaration& a) const {
    Types types;
    for (const std::string& tag : referredTags(schema_.registry(), a))
        types.push_back(byTag_.at(tag));
    const std::string name = referredName(schema_.registry(), a);
    if (types.empty()) return name;
    if (types.size() > kTypesInCell) {
        const std::string article = a.kind == ValueKind::reference ? "a " : "";
        return article + asLink(name, pageOf(chapterOf(*types.front())));
    }
    return list(types, chapterOf(type));
}

// Attributes with the same words share a line.
std::string ManualSections::words(const SchemaType& type) const {
    std::vector<std::pair<std::string, const std::vector<std::string>*>> lines;
    for (const AttributeDeclaration& a : type.declaration->attributes) {
        if (a.words.size() <= kWordsInCell) continue;
        const auto same = std::find_if(lines.begin(), lines.end(),
                                       [&](const auto& line) { return *line.second == a.words; });
        if (same == lines.end())
            lines.emplace_back(asCode(a.name), &a.words);
        else
            same->first += ", " + asCode(a.name);
    }
    std::string text;
    for (const auto& [names, list] : lines) {
        const SchemaType* const first = longLists_.at(*list);
        std::string all;
        for (const std::string& word : asCodes(*list))
            all += (all.empty() ? "" : ", ") + word;
        if (first != &type) all = "as of " + link(*first, chapterOf(type));
        text += fmt::format("\nWords of {}: {}.\n", names, all);
    }
    return text;
}

std::string ManualSections::children(const SchemaType& type) const {
    const std::vector<ChildRule>& rules = type.declaration->childRules;
    std::string text;
    for (const ChildRule& rule : rules) {
        std::string what;
        if (rule.element && rule.element->tags().empty()) continue;
        if (rule.element) {
            const auto found =
                std::find_if(schema_.types().begin(), schema_.types().end(),
                             [&](const SchemaType& t) { return t.declaration == rule.element; });
            what = link(*found, chapterOf(type)) + countText(rule) + ": " +
                   asMarkdown(asSentence(rule.element->summary));
        } else if (rule.anyResource) {
            what = "any other resource, with an attribute `id`: " +
                   asMarkdown(asSentence(rule.summary));
        } else {
            const std::string name = schema_.registry().interfaceName(*rule.provides);
            const std::string types = builtTypes(*rule.provides, chapterOf(type));
            what = (name.starts_with("a ") ? "" : "a ") + name + countText(rule) + ": " +
                   asMarkdown(asSentence(rule.summary)) +
                   (types.empty() ? "" : " One of " + types + ".");
        }
        text += "- " + what + "\n";
    }
    return text.empty() ? "" : "\nChildren:\n\n" + text;
}

std::string ManualSections::builtTypes(std::type_index interface,
                                       const std::string& chapter) const {
    Types types;
    for (const std::string& tag : schema_.registry().tagsOf(interface)) {
        if (!schema_.registry().find(tag)->planned) types.push_back(byTag_.at(tag));
    }
    return list(types, chapter);
}

// Attributes that name resources of the type, by the elements that have them.
std::string ManualSections::usedBy(const SchemaType& type) const {
    if (!byTag_.contains(type.id) || type.declaration->planned) return {};
    std::vector<std::pair<std::string, Types>> users;
    for (const SchemaType& user : schema_.types()) {
        std::string names;
        for (const AttributeDeclaration& a : user.declaration->attributes) {
            const bool refers = a.refersTo && *a.refersTo != std::type_index(typeid(Resource)) &&
                                type.declaration->isA(*a.refersTo);
            if (refers) names += (names.empty() ? "" : ", ") + asCode(a.name);
        }
        if (names.empty()) continue;
        const auto known = std::find_if(users.begin(), users.end(),
                                        [&](const auto& each) { return each.first == names; });
        if (known == users.end())
            users.push_back({names, {&user}});
        else
            known->second.push_back(&user);
    }
    std::string text;
    for (const auto& [names, types] : users)
        text += (text.empty() ? "" : "; ") + names + " of " + list(types, chapterOf(type), " and ");
    return text.empty() ? "" : "\nNamed by " + text + ".\n";
}

} // namespace terrane
