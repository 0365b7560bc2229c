// SPDX-License-Identifier: BSD-3-Clause
#include "resource/schema.h"

#include <algorithm>
#include <set>

namespace terrane {

bool SchemaRule::unbounded() const {
    return atLeast == 0 && atMost == std::numeric_limits<std::size_t>::max();
}

Schema::Schema(const Registry& registry)
    : registry_(registry) {
    for (const std::string& tag : registry.tags()) {
        types_.push_back({tag, registry.find(tag), {}});
        resources_.push_back({tag, &types_.back(), false});
    }
    entries_ = resources_;
    for (const ElementDeclaration* declaration : registry.topLevels()) {
        const SchemaType& type = local(*declaration, "archive");
        for (const std::string& tag : declaration->tags()) {
            // The player looks for these first.
            std::erase_if(entries_, [&](const SchemaElement& e) { return e.tag == tag; });
            entries_.push_back({tag, &type, false});
        }
    }
    std::stable_sort(entries_.begin(), entries_.end(),
                     [](const SchemaElement& a, const SchemaElement& b) { return a.tag < b.tag; });
    // Grows as rules name local elements.
    for (std::size_t i = 0; i < types_.size(); ++i)
        addRules(types_[i]);
}

const SchemaType* Schema::find(const ElementDeclaration& declaration) const {
    const auto found = std::find_if(types_.begin(), types_.end(), [&](const SchemaType& type) {
        return type.declaration == &declaration;
    });
    return found == types_.end() ? nullptr : &*found;
}

const SchemaType& Schema::local(const ElementDeclaration& declaration, const std::string& parent) {
    if (const SchemaType* known = find(declaration)) return *known;
    std::string id = parent + "." + declaration.tag;
    const auto isTaken = [&] {
        return std::any_of(types_.begin(), types_.end(),
                           [&](const SchemaType& type) { return type.id == id; });
    };
    while (isTaken())
        id += "_";
    return types_.emplace_back(SchemaType{id, &declaration, {}});
}

void Schema::addRules(SchemaType& type) {
    // As the parser does, the first rule that allows a tag has it.
    std::set<std::string> taken;
    for (const ChildRule& from : type.declaration->childRules) {
        SchemaRule rule{{}, from.atLeast, from.atMost};
        const auto add = [&](const std::string& tag, const SchemaType& child) {
            if (taken.insert(tag).second) rule.elements.push_back({tag, &child, from.keyed});
        };
        if (from.element && from.element->tags().empty()) continue;
        if (from.element) {
            const SchemaType& child = local(*from.element, type.id);
            for (const std::string& tag : from.element->tags())
                add(tag, child);
        } else {
            for (const SchemaElement& resource : resources_) {
                if (from.anyResource || resource.type->declaration->isA(*from.provides))
                    add(resource.tag, *resource.type);
            }
        }
        if (!rule.elements.empty()) type.rules.push_back(std::move(rule));
    }
}

bool Schema::isKeyed(const SchemaType& type) const {
    for (const SchemaType& parent : types_) {
        for (const SchemaRule& rule : parent.rules) {
            for (const SchemaElement& element : rule.elements) {
                if (element.type == &type && element.keyed) return true;
            }
        }
    }
    return false;
}

} // namespace terrane
