// SPDX-License-Identifier: BSD-3-Clause
#include "resource/registry.h"

#include "core/text.h"

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

std::string Registry::describeInterface(std::type_index interface) const {
    std::string tags = listOfNames(tagsOf(interface));
    const auto named = interfaceNames_.find(interface);
    if (named == interfaceNames_.end()) return tags;
    return tags.empty() ? named->second : named->second + " (" + tags + ")";
}

} // namespace terrane
