// SPDX-License-Identifier: BSD-3-Clause
#include "resource/parser.h"

#include "core/text.h"

#include <algorithm>
#include <set>

namespace terrane {

namespace {

// Deeper nesting than any archive needs, and shallow enough for the stack.
constexpr int kMaxDepth = 200;

class Parser {
public:
    Parser(const Registry& registry, Diagnostics& diagnostics)
        : registry_(registry)
        , diagnostics_(diagnostics) {}

    ParsedElement parse(const XmlElement& element, const ElementDeclaration& declaration,
                        bool keyed, int depth) {
        ParsedElement result{&declaration, declaration.makeDescription(), true, {}};
        result.description->tag = element.tag();
        result.description->place = element.place();
        if (depth == 0 || declaration.build)
            result.description->fingerprint = element.fingerprint();
        result.description->name.place = result.description->id.place = element.place();
        result.valid &= readAttributes(element, declaration, keyed, depth, *result.description);
        if (declaration.planned) {
            diagnostics_.warning("not-built-yet", element.place(),
                                 asTag(element.tag()) + " has no effect yet");
        }
        if (!declaration.acceptsAnything && !hasStandIn(element, declaration)) {
            warnText(element);
            result.valid &= readChildren(element, declaration, *result.description, depth);
        }
        if (result.valid && declaration.check) {
            const std::size_t before = diagnostics_.errors();
            declaration.check(*result.description, diagnostics_);
            result.valid = diagnostics_.errors() == before;
        }
        return result;
    }

    const std::vector<AttributeText>& files() const { return files_; }

private:
    bool readAttributes(const XmlElement& element, const ElementDeclaration& declaration,
                        bool keyed, int depth, ElementDescription& description) {
        bool good = true;
        std::set<const AttributeDeclaration*> seen;
        std::set<std::string> names;
        for (const XmlAttribute& xml : element.attributes()) {
            if (depth == 0 && isHint(xml.name)) continue;
            if (!names.insert(xml.name).second) {
                diagnostics_.error("duplicate-attribute", xml.namePlace,
                                   "attribute " + inQuotes(xml.name) + " is given twice",
                                   "it once");
                good = false;
                continue;
            }
            const AttributeDeclaration* const a = declaration.attribute(xml.name);
            if (a && !seen.insert(a).second) {
                diagnostics_.error("duplicate-attribute", xml.namePlace,
                                   inQuotes(xml.name) +
                                       " is another name of an attribute given already",
                                   "'" + a->name + "' once");
                good = false;
            } else if (a) {
                good &= readDeclared(*a, xml, description);
            } else if (!readCommon(xml, declaration, keyed, description) &&
                       !declaration.acceptsAnything) {
                const bool lenient = declaration.lenient || hasStandIn(element, declaration);
                unknownAttribute(xml, declaration, keyed, element.tag(), lenient);
                good &= lenient;
            }
        }
        good &= checkRequired(element, declaration, seen);
        if (keyed && !description.id.given) {
            missingAttribute(element, "id");
            good = false;
        }
        for (const AttributeDeclaration& a : declaration.attributes) {
            if (a.locate && !seen.contains(&a)) a.locate(description, description.place);
        }
        return good;
    }

    // What tells editors the schema of a file, at its root.
    static bool isHint(const std::string& name) {
        return name.starts_with("xmlns:") || name.starts_with("xsi:");
    }

    // Whether the attribute that stands for everything else is given.
    static bool hasStandIn(const XmlElement& element, const ElementDeclaration& declaration) {
        return !declaration.standsForAll.empty() &&
               !element.attribute(declaration.standsForAll.c_str()).empty();
    }

    bool readDeclared(const AttributeDeclaration& a, const XmlAttribute& xml,
                      ElementDescription& description) {
        if (a.planned) {
            diagnostics_.warning("not-built-yet", xml.namePlace,
                                 "attribute '" + a.name + "' has no effect yet");
        }
        // The original took it; but nothing finds what has no name.
        if (a.kind == ValueKind::text && a.required && xml.value.empty()) {
            diagnostics_.warning("empty-value", xml.valuePlace, "'" + a.name + "' is empty",
                                 a.summary);
        }
        if (a.kind == ValueKind::file) files_.push_back({xml.value, xml.namePlace, xml.valuePlace});
        return !a.read ||
               a.read({xml.value, xml.namePlace, xml.valuePlace}, description, diagnostics_);
    }

    // Text is ignored wherever it stands, but it is often what is left of a tag.
    void warnText(const XmlElement& element) {
        const Place place = element.textPlace();
        if (!place) return;
        diagnostics_.warning("text-ignored", place,
                             "the text in " + asTag(element.tag()) + " is ignored",
                             "elements and comments");
    }

    static bool readCommon(const XmlAttribute& xml, const ElementDeclaration& declaration,
                           bool keyed, ElementDescription& description) {
        Attr<std::string>* attr = nullptr;
        if (xml.name == "name" && declaration.named) attr = &description.name;
        if (xml.name == "id" && (keyed || declaration.acceptsAnything)) attr = &description.id;
        if (!attr) return false;
        attr->value = xml.value;
        attr->place = xml.valuePlace;
        attr->given = true;
        return true;
    }

    void unknownAttribute(const XmlAttribute& xml, const ElementDeclaration& declaration,
                          bool keyed, const std::string& tag, bool lenient) {
        std::vector<std::string> names = declaration.attributeNames();
        if (declaration.named && !declaration.attribute("name")) names.push_back("name");
        if (keyed) names.push_back("id");
        std::sort(names.begin(), names.end());
        diagnostics_.report({.severity = lenient ? Severity::warning : Severity::error,
                             .code = "unknown-attribute",
                             .place = xml.namePlace,
                             .message = asTag(tag) + " has no attribute " + inQuotes(xml.name),
                             .expected = names.empty() ? "no attribute" : listOfNames(names),
                             .suggestion = nearestName(xml.name, names)});
    }

    void missingAttribute(const XmlElement& element, const std::string& name) {
        diagnostics_.error("missing-attribute", element.place(),
                           asTag(element.tag()) + " needs the attribute '" + name + "'");
    }

    bool checkRequired(const XmlElement& element, const ElementDeclaration& declaration,
                       const std::set<const AttributeDeclaration*>& seen) {
        bool good = true;
        for (const AttributeDeclaration& a : declaration.attributes) {
            if (!a.required || seen.contains(&a)) continue;
            missingAttribute(element, a.name);
            good = false;
        }
        return good;
    }

    bool readChildren(const XmlElement& element, const ElementDeclaration& declaration,
                      ElementDescription& description, int depth) {
        if (depth > kMaxDepth) {
            diagnostics_.error("too-deep", element.place(), "elements are nested too deeply",
                               "at most " + std::to_string(kMaxDepth) + " levels");
            return false;
        }
        bool good = true;
        std::vector<std::size_t> counts(declaration.childRules.size(), 0);
        for (const XmlElement& child : element.children()) {
            const std::size_t rule = findRule(child, declaration);
            if (rule == counts.size()) {
                unknownElement(child, element.tag(), declaration);
                good = false;
                continue;
            }
            ++counts[rule];
            good &= readChild(child, declaration.childRules[rule], description, depth);
        }
        return good & checkCounts(element, declaration, counts);
    }

    std::size_t findRule(const XmlElement& child, const ElementDeclaration& declaration) const {
        const std::string tag = child.tag();
        const ElementDeclaration* resource = registry_.find(tag);
        for (std::size_t i = 0; i < declaration.childRules.size(); ++i) {
            const ChildRule& rule = declaration.childRules[i];
            if (rule.element && rule.element->matches(tag)) return i;
            if (resource && (rule.anyResource || (rule.provides && resource->isA(*rule.provides))))
                return i;
        }
        return declaration.childRules.size();
    }

    bool readChild(const XmlElement& child, const ChildRule& rule, ElementDescription& description,
                   int depth) {
        const ElementDeclaration* declaration =
            rule.element ? rule.element : registry_.find(child.tag());
        ParsedElement parsed = parse(child, *declaration, rule.keyed, depth + 1);
        description.children.push_back({declaration, std::move(parsed.description), nullptr});
        return parsed.valid;
    }

    // Of prefixes, the tags that are known, or the prefix.
    std::vector<std::string> allowedTags(const ElementDeclaration& declaration, bool known) const {
        std::vector<std::string> tags;
        for (const ChildRule& rule : declaration.childRules) {
            if (rule.element && known) {
                const std::vector<std::string> more = rule.element->tags();
                tags.insert(tags.end(), more.begin(), more.end());
            } else if (rule.element) {
                tags.push_back(rule.element->tag);
            } else {
                const auto more =
                    rule.anyResource ? registry_.tags() : registry_.tagsOf(*rule.provides);
                tags.insert(tags.end(), more.begin(), more.end());
            }
        }
        return tags;
    }

    void unknownElement(const XmlElement& child, const std::string& parent,
                        const ElementDeclaration& declaration) {
        const std::vector<std::string> tags = allowedTags(declaration, false);
        // A rule for any resource allows too many tags to list them.
        constexpr std::size_t kListed = 24;
        std::string expected = "no child element";
        if (!tags.empty()) expected = tags.size() <= kListed ? listOfNames(tags) : "";
        diagnostics_.report(
            {.code = "unknown-element",
             .place = child.place(),
             .message = asTag(child.tag()) + " can't stand in " + asTag(parent),
             .expected = std::move(expected),
             .suggestion = nearestName(child.tag(), allowedTags(declaration, true))});
    }

    bool checkCounts(const XmlElement& element, const ElementDeclaration& declaration,
                     const std::vector<std::size_t>& counts) {
        bool good = true;
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const ChildRule& rule = declaration.childRules[i];
            if (counts[i] >= rule.atLeast && counts[i] <= rule.atMost) continue;
            const std::string what = rule.element ? asTag(rule.element->tag) : rule.summary;
            const bool few = counts[i] < rule.atLeast;
            diagnostics_.error(few ? "missing-element" : "too-many-elements", element.place(),
                               asTag(element.tag()) + " has " + std::to_string(counts[i]) +
                                   " child element(s) for " + what,
                               few ? "at least " + std::to_string(rule.atLeast)
                                   : "at most " + std::to_string(rule.atMost));
            good = false;
        }
        return good;
    }

    const Registry& registry_;
    Diagnostics& diagnostics_;
    std::vector<AttributeText> files_;
};

} // namespace

ParsedElement parseElement(const XmlElement& element, const ElementDeclaration& declaration,
                           const Registry& registry, Diagnostics& diagnostics) {
    Parser parser(registry, diagnostics);
    ParsedElement parsed = parser.parse(element, declaration, false, 0);
    parsed.files = parser.files();
    return parsed;
}

std::vector<std::pair<const AttributeDeclaration*, RefBase*>>
references(const ElementDeclaration& declaration, ElementDescription& description, bool onDemand) {
    std::vector<std::pair<const AttributeDeclaration*, RefBase*>> result;
    for (const AttributeDeclaration& a : declaration.attributes) {
        if (!a.references || a.onDemand != onDemand) continue;
        std::vector<RefBase*> list;
        a.references(description, list);
        for (RefBase* ref : list) {
            if (ref->given()) result.emplace_back(&a, ref);
        }
    }
    for (const Child& child : description.children) {
        const auto nested = references(*child.declaration, *child.description, onDemand);
        result.insert(result.end(), nested.begin(), nested.end());
    }
    return result;
}

} // namespace terrane
