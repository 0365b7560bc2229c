// SPDX-License-Identifier: BSD-3-Clause
#include "resource/registry.h"

#include "core/text.h"

#include <algorithm>

namespace terrane {

const ElementDeclaration* Registry::find(std::string_view tag) const {
    const auto found = types_.find(tag);
    return found == types_.end() ? nullptr : &found->second;
}

const ElementDeclaration* Registry::findTopLevel(std::string_view tag) const {
    for (const ElementDeclaration* d : topLevel_) {
        if (d->matches(tag)) return d;
    }
    return nullptr;
}

std::vector<std::string> Registry::tags() const {
    std::vector<std::string> names;
    for (const auto& [tag, declaration] : types_)
        names.push_back(tag);
    return names;
}

std::vector<std::string> Registry::entryTags() const {
    std::vector<std::string> names = tags();
    for (const ElementDeclaration* declaration : topLevel_)
        names.push_back(declaration->tag);
    return names;
}

std::vector<std::string> Registry::tagsOf(std::type_index interface) const {
    std::vector<std::string> names;
    for (const auto& [tag, declaration] : types_) {
        if (declaration.isA(interface)) names.push_back(tag);
    }
    return names;
}

void Registry::chapter(const std::string& title, std::string summary) {
    const bool known = std::any_of(chapters_.begin(), chapters_.end(),
                                   [&](const Chapter& each) { return each.title == title; });
    if (!known) chapters_.push_back({title, std::move(summary)});
    chapter_ = title;
}

ElementDeclaration Registry::declared(std::string tag, std::string summary) const {
    ElementDeclaration d;
    d.tag = std::move(tag);
    d.summary = std::move(summary);
    d.chapter = chapter_;
    return d;
}

std::string Registry::interfaceName(std::type_index interface) const {
    const auto named = interfaceNames_.find(interface);
    return named == interfaceNames_.end() ? std::string() : named->second;
}

std::string Registry::describeInterface(std::type_index interface) const {
    const std::string tags = listOfNames(tagsOf(interface));
    const std::string name = interfaceName(interface);
    if (name.empty()) return tags;
    return tags.empty() ? name : name + " (" + tags + ")";
}

} // namespace terrane
