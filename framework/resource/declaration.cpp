// SPDX-License-Identifier: BSD-3-Clause
#include "resource/declaration.h"

#include <algorithm>

namespace terrane {

bool ElementDeclaration::isA(std::type_index interface) const {
    return std::find(provides.begin(), provides.end(), interface) != provides.end();
}

bool ElementDeclaration::matches(std::string_view name) const {
    return prefix ? name.starts_with(tag) : name == tag;
}

std::vector<std::string> ElementDeclaration::tags() const {
    return prefix ? knownTags : std::vector<std::string>{tag};
}

const AttributeDeclaration* ElementDeclaration::attribute(std::string_view name) const {
    for (const AttributeDeclaration& a : attributes) {
        if (a.name == name) return &a;
        if (std::find(a.aliases.begin(), a.aliases.end(), name) != a.aliases.end()) return &a;
    }
    return nullptr;
}

std::vector<std::string> ElementDeclaration::attributeNames() const {
    std::vector<std::string> names;
    for (const AttributeDeclaration& a : attributes)
        names.push_back(a.name);
    return names;
}

} // namespace terrane
