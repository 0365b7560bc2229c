// SPDX-License-Identifier: BSD-3-Clause
#include "core/source.h"

#include <doctest/doctest.h>

using namespace terrane;

TEST_CASE("an offset is a line and a column, counted in bytes from 1") {
    struct Row {
        const char* name;
        std::string text;
        std::size_t offset;
        int line, column;
    };
    const Row rows[] = {
        {"an empty file", "", 0, 1, 1},
        {"past the end of an empty file", "", 99, 1, 1},
        {"the first character", "ab\ncd", 0, 1, 1},
        {"the line break belongs to its line", "ab\ncd", 2, 1, 3},
        {"after a line break", "ab\ncd", 3, 2, 1},
        {"past the end", "ab\ncd", 99, 2, 3},
        {"after the last line break", "ab\n", 3, 2, 1},
        {"a carriage return counts as a column", "ab\r\ncd", 4, 2, 1},
        {"a lone carriage return starts no line", "ab\rcd", 3, 1, 4},
        {"UTF-8 counts bytes", "\xc3\xa9 x", 3, 1, 4},
        {"a tab is one column", "\tx", 1, 1, 2},
        {"a zero byte is a character", std::string("a\0b\nc", 5), 4, 2, 1},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        const SourceFile file("a.xml", row.text);
        const LineColumn at = file.position(row.offset);
        CHECK(at.line == row.line);
        CHECK(at.column == row.column);
        if (row.offset <= row.text.size()) CHECK(file.offset(at) == row.offset);
    }
}

TEST_CASE("a position outside the text is the nearest one inside") {
    const SourceFile file("a.xml", "ab\ncdef\r\n");
    struct Row {
        const char* name;
        LineColumn position;
        std::size_t offset;
    };
    const Row rows[] = {
        {"an unknown line", {0, 0}, 0},           {"a negative line", {-5, 3}, 0},
        {"an unknown column", {2, 0}, 3},         {"past the end of a line", {1, 99}, 2},
        {"before a carriage return", {2, 99}, 7}, {"past the last line", {99, 1}, 9},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        CHECK(file.offset(row.position) == row.offset);
    }
}

TEST_CASE("a line is told without its line break") {
    const SourceFile file("a.xml", "one\r\n\ntwo\n");
    CHECK(file.line(1) == "one");
    CHECK(file.line(2).empty());
    CHECK(file.line(3) == "two");
    CHECK(file.line(4).empty());
    CHECK(file.line(0).empty());
    CHECK(file.line(-1).empty());
    CHECK(file.line(5).empty());
}

TEST_CASE("a place keeps its file and prints as file, line and column") {
    Place place;
    CHECK_FALSE(place);
    CHECK(place.toString().empty());
    CHECK(place.position().line == 0);
    {
        const auto file = std::make_shared<SourceFile>("folder/a.xml", "x\n yz");
        place = Place{file, 4};
    }
    CHECK(place);
    CHECK(place.toString() == "folder/a.xml:2:3");
}

TEST_CASE("a place is found again in a later version of its text") {
    const auto text = [](const char* what) { return std::make_shared<SourceFile>("a.xml", what); };
    const auto before = text("one\ntwo\nthree\nfour\n");
    struct Row {
        const char* name;
        const char* after;
        LineColumn place, expected; ///< line 0: it stays in the old text
    };
    const Row rows[] = {
        {"nothing changed", "one\ntwo\nthree\nfour\n", {3, 2}, {3, 2}},
        {"a line above", "zero\none\ntwo\nthree\nfour\n", {3, 2}, {4, 2}},
        {"a line above, gone", "one\nthree\nfour\n", {3, 2}, {2, 2}},
        {"a line below", "one\ntwo\nthree\nthree and a half\nfour\n", {2, 3}, {2, 3}},
        {"in the line itself", "one\ntwo\nthirty\nfour\n", {3, 4}, {0, 0}},
        {"further back in the line", "one\ntwo\nthree!\nfour\n", {3, 2}, {3, 2}},
        {"before it in the line", "one\ntwo\nno three\nfour\n", {3, 2}, {3, 5}},
        {"all of it", "", {3, 2}, {0, 0}},
        {"repeated lines", "one\none\ntwo\nthree\nfour\n", {4, 1}, {5, 1}},
    };
    for (const Row& row : rows) {
        CAPTURE(std::string(row.name));
        const auto after = text(row.after);
        const Place place = relocated({before, before->offset(row.place)}, after);
        const bool moved = row.expected.line > 0;
        CHECK((place.file == after) == moved);
        if (!moved) continue;
        CHECK(place.position().line == row.expected.line);
        CHECK(place.position().column == row.expected.column);
    }
    CHECK_FALSE(relocated({}, before));
}
