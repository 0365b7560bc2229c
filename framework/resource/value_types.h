// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/schema.h"
#include "resource/value_grammar.h"

#include <string>
#include <vector>

namespace terrane {

/// The types of all values of a schema, each once and with a name, for languages that name them:
/// "boolean", "number"; "terrainNode.deform" after the first attribute with that type.
class ValueTypes {
public:
    struct Type {
        std::string name;
        std::vector<ValueForm> forms;
    };

    explicit ValueTypes(const Schema& schema);

    /// Those but for any text.
    const std::vector<Type>& all() const { return types_; }
    /// Empty for any text.
    const std::string& nameOf(const AttributeDeclaration& attribute) const;

private:
    const Type* find(const std::vector<ValueForm>& forms) const;
    void add(const SchemaType& type, const AttributeDeclaration& attribute);
    bool isTaken(const std::string& name) const;

    std::vector<Type> types_;
};

} // namespace terrane
