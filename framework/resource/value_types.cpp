// SPDX-License-Identifier: BSD-3-Clause
#include "resource/value_types.h"

#include <algorithm>

namespace terrane {

namespace {

// Of values that nothing restricts but their kind.
std::string commonName(const AttributeDeclaration& a) {
    AttributeDeclaration plain;
    plain.kind = a.kind;
    if (valueForms(plain) != valueForms(a)) return {};
    switch (a.kind) {
    case ValueKind::boolean:
        return "boolean";
    case ValueKind::integer:
        return "integer";
    case ValueKind::real:
        return "number";
    case ValueKind::integerList:
        return "integers";
    case ValueKind::realList:
        return "numbers";
    case ValueKind::reference:
        return "name";
    case ValueKind::target:
        return "target";
    default:
        return {};
    }
}

} // namespace

ValueTypes::ValueTypes(const Schema& schema) {
    for (const SchemaType& type : schema.types()) {
        for (const AttributeDeclaration& a : type.declaration->attributes)
            add(type, a);
    }
    std::sort(types_.begin(), types_.end(),
              [](const Type& a, const Type& b) { return a.name < b.name; });
}

void ValueTypes::add(const SchemaType& type, const AttributeDeclaration& a) {
    std::vector<ValueForm> forms = valueForms(a);
    if (forms.front().anyText() || find(forms)) return;
    std::string name = commonName(a);
    if (name.empty()) name = type.id + "." + a.name;
    while (isTaken(name))
        name += "_";
    types_.push_back({std::move(name), std::move(forms)});
}

const ValueTypes::Type* ValueTypes::find(const std::vector<ValueForm>& forms) const {
    const auto found = std::find_if(types_.begin(), types_.end(),
                                    [&](const Type& type) { return type.forms == forms; });
    return found == types_.end() ? nullptr : &*found;
}

bool ValueTypes::isTaken(const std::string& name) const {
    return std::any_of(types_.begin(), types_.end(),
                       [&](const Type& type) { return type.name == name; });
}

const std::string& ValueTypes::nameOf(const AttributeDeclaration& a) const {
    static const std::string kAnyText;
    const Type* const type = find(valueForms(a));
    return type ? type->name : kAnyText;
}

} // namespace terrane
