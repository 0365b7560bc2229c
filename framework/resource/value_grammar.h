// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace terrane {

struct AttributeDeclaration;
struct ElementDeclaration;

/// A set of texts, in the terms that schema languages share (the data types of XML Schema).
struct ValueForm {
    enum class Base { text, integer, real };
    struct Bound {
        std::string value;
        bool excluded = false;
        bool operator==(const Bound&) const = default;
    };

    Base base = Base::text;
    std::vector<std::string> words; ///< if any: one of these
    std::string pattern;            ///< if any: a regular expression of XML Schema
    bool notEmpty = false;
    std::optional<Bound> minimum, maximum;

    bool anyText() const;
    bool operator==(const ValueForm&) const = default;
};

/// What may be written as an attribute's value: one of these forms. They hold what the reader of
/// the attribute takes without a word, neither an error nor a warning, but for numbers of lists,
/// whose range no pattern can tell.
std::vector<ValueForm> valueForms(const AttributeDeclaration& attribute);

/// The default as it would be written. Nothing when there is none, or when it stands for "not
/// given" and could not be written.
std::optional<std::string> writtenDefault(const ElementDeclaration& element,
                                          const AttributeDeclaration& attribute);

} // namespace terrane
