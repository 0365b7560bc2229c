// SPDX-License-Identifier: BSD-3-Clause
#include "resource/attribute_place.h"

#include <doctest/doctest.h>
#include <string>

using namespace terrane;

TEST_CASE("the name of an attribute is found from its value") {
    struct Row {
        std::string name;
        const char* text; // '^' marks the value; the name is 'x', or the value itself is the answer
        std::size_t offset;
    };
    const Row rows[] = {
        {"plain", "<a x=\"^1\"/>", 3},
        {"single quotes", "<a y='2' x='^1'/>", 9},
        {"an empty value", "<a x=\"^\"/>", 3},
        {"blanks", "<a\n  x\t=\r\n \"^1\"/>", 5},
        {"in the middle of a value", "<a x=\"1,^2\"/>", 8},
        {"no attribute", "^<a/>", 0},
        {"only a quote", "\"^", 1},
        {"only an equals sign", "=\"^", 2},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        std::string text = row.text;
        const std::size_t value = text.find('^');
        text.erase(value, 1);
        const auto file = std::make_shared<SourceFile>("a.xml", text);
        CHECK(attributeName({file, value}).offset == row.offset);
    }
    CHECK_FALSE(attributeName({}));
}
