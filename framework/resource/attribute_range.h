// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace terrane {

struct AttributeDeclaration;

/// The numbers that an attribute allows, with their unit: "at least 0 m", "more than 0 and at most
/// 90 degrees"; "a finite number" when every one will do.
std::string rangeOf(const AttributeDeclaration& attribute);

} // namespace terrane
