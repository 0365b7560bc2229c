// SPDX-License-Identifier: BSD-3-Clause
#include "core/text.h"

#include <clocale>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>

using namespace terrane;

TEST_CASE("a text is split at every separator") {
    struct Row {
        const char* text;
        std::vector<std::string_view> pieces;
    };
    const Row rows[] = {
        {"", {}},
        {"a", {"a"}},
        {"a;b", {"a", "b"}},
        {"a;b;", {"a", "b", ""}},
        {";", {"", ""}},
        {";;a", {"", "", "a"}},
        {" a ; b", {" a ", " b"}},
    };
    for (const Row& row : rows) {
        CAPTURE(row.text);
        CHECK(split(row.text, ';') == row.pieces);
    }
}

TEST_CASE("the nearest name is a likely misspelling or none") {
    const std::vector<std::string> names{"internalformat", "format", "min", "mag", "width"};
    struct Row {
        const char* name;
        std::string given;
        const char* nearest;
    };
    const Row rows[] = {
        {"a letter missing", "forma", "format"},
        {"a letter too many", "widtth", "width"},
        {"a wrong letter", "wodth", "width"},
        {"two letters swapped", "fromat", "format"},
        {"another case", "InternalFormat", "internalformat"},
        {"a short one", "mab", "mag"},
        {"another word", "colour", ""},
        {"nothing", "", ""},
        {"far too long", std::string(100000, 'w'), ""},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        CHECK(nearestName(row.given, names) == row.nearest);
    }
    CHECK(nearestName("width", {}).empty());
    // What goes on where the name ends is nearer than what differs in it.
    const std::vector<std::string> formats{"RGB12", "RGB16", "RGB32F", "RGB32I", "RG32F"};
    CHECK(nearestName("RGB32", formats) == "RGB32F");
    CHECK(nearestName("rgb32", formats) == "RGB32F");
    CHECK(nearestName("RGB3", {"RGB5", "RGB32"}) == "RGB32");
    CHECK(nearestName("RGB17", formats) == "RGB12");
    CHECK(nearestName("RGB", {"RGA", "RGBABCD"}) == "RGA");
}

TEST_CASE("a noun has its article") {
    CHECK(withArticle("program") == "a program");
    CHECK(withArticle("elevationProducer") == "an elevationProducer");
    CHECK(withArticle("") == "a ");
}

TEST_CASE("an integer whose bits count may need them all") {
    CHECK(parseBits("4294967295x")->value == -1);
    CHECK(parseBits("4294967295x")->length == 10);
    CHECK(parseBits("-2147483648")->value == std::numeric_limits<int>::min());
    CHECK(parseBits("+7")->value == 7);
    for (const char* text : {"4294967296", "-2147483649", "x", "", "99999999999999999999"})
        CHECK_FALSE(parseBits(text));
}

TEST_CASE("names are listed as in a sentence") {
    CHECK(listOfNames({}).empty());
    CHECK(listOfNames({"a"}) == "'a'");
    CHECK(listOfNames({"a", "b"}) == "'a' or 'b'");
    CHECK(listOfNames({"a", "b", "c"}) == "'a', 'b' or 'c'");
    const std::string many = listOfNames(std::vector<std::string>(25, "a"));
    CHECK(many.starts_with("'a', 'a', "));
    CHECK(many.ends_with("'a' or 13 others"));
}

TEST_CASE("what an author wrote is quoted on one short line") {
    CHECK(inQuotes("") == "''");
    CHECK(inQuotes("a b") == "'a b'");
    CHECK(inQuotes("a\nb\x1b[2J\tc") == "'a b [2J c'");
    CHECK(inQuotes("\xc3\xa9") == "'\xc3\xa9'");
    CHECK(inQuotes(std::string(120, 'a')) == "'" + std::string(120, 'a') + "'");
    CHECK(inQuotes(std::string(121, 'a')) == "'" + std::string(120, 'a') + "...'");
    CHECK(inQuotes(std::string(119, 'a') + "\xc3\xa9") == "'" + std::string(119, 'a') + "...'");
    CHECK(asTag("node") == "<node>");
    CHECK(asTag(std::string(121, 'a')).size() == 125);
}

TEST_CASE("an integer is read from the start of a text") {
    struct Row {
        const char* text;
        bool found;
        int value;
        std::size_t length;
    };
    const Row rows[] = {
        {"42", true, 42, 2},
        {"-7", true, -7, 2},
        {"+7", true, 7, 2},
        {" \t\n7x", true, 7, 4},
        {"2147483647", true, 2147483647, 10},
        {"2147483648", false, 0, 0},
        {"-2147483649", false, 0, 0},
        {"1.5", true, 1, 1},
        {"0x10", true, 0, 1},
        {"", false, 0, 0},
        {"   ", false, 0, 0},
        {"+", false, 0, 0},
        {"-", false, 0, 0},
        {"+-1", false, 0, 0},
        {"--1", false, 0, 0},
        {"- 1", false, 0, 0},
        {"x", false, 0, 0},
    };
    for (const Row& row : rows) {
        CAPTURE(row.text);
        const auto number = parseInt(row.text);
        REQUIRE(number.has_value() == row.found);
        if (!number) continue;
        CHECK(number->value == row.value);
        CHECK(number->length == row.length);
    }
}

TEST_CASE("a real number is read from the start of a text") {
    struct Row {
        const char* text;
        bool found;
        double value;
        std::size_t length;
    };
    const Row rows[] = {
        {"1.5", true, 1.5, 3},  {"-.5", true, -.5, 3},      {"5.", true, 5, 2},
        {"1e3", true, 1000, 3}, {"1e", true, 1, 1},         {"+2.5f", true, 2.5, 4},
        {" 1,5", true, 1, 2},   {"inf", true, INFINITY, 3}, {"-inf", true, -INFINITY, 4},
        {"1e999", false, 0, 0}, {"", false, 0, 0},          {".", false, 0, 0},
        {"e5", false, 0, 0},    {"+-1", false, 0, 0},
    };
    for (const Row& row : rows) {
        CAPTURE(row.text);
        const auto number = parseReal(row.text);
        REQUIRE(number.has_value() == row.found);
        if (!number) continue;
        CHECK(number->value == row.value);
        CHECK(number->length == row.length);
    }
    CHECK(std::isnan(parseReal("nan")->value));
}

TEST_CASE("a text that is not ended is not read past its end") {
    CHECK(parseInt(std::string_view("12345").substr(0, 2))->value == 12);
    CHECK_FALSE(parseReal(std::string_view("-1").substr(0, 1)));
}

TEST_CASE("blank is what holds nothing but white space") {
    CHECK(isBlank(""));
    CHECK(isBlank(" \t\r\n"));
    CHECK_FALSE(isBlank(" a "));
    CHECK_FALSE(isBlank("\xa0"));
}
