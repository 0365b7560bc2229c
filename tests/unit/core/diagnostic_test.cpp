// SPDX-License-Identifier: BSD-3-Clause
#include "core/diagnostic.h"

#include <doctest/doctest.h>
#include <thread>

using namespace terrane;

namespace {

Place placeIn(std::string text, std::size_t offset) {
    return {std::make_shared<SourceFile>("a.xml", std::move(text)), offset};
}

} // namespace

TEST_CASE("a diagnostic is printed as a compiler does") {
    struct Row {
        const char* name;
        Diagnostic diagnostic;
        const char* text;
    };
    const Row rows[] = {
        {"no place",
         {.code = "no-context", .message = "no OpenGL"},
         "error: no OpenGL [no-context]\n"},
        {"everything",
         {.severity = Severity::warning,
          .code = "unknown-attribute",
          .place = placeIn("<a>\n  <b kind='1'/>\n</a>", 9),
          .message = "unknown attribute 'kind'",
          .expected = "'king' or 'name'",
          .suggestion = "king",
          .detail = "line one\nline two\n",
          .chain = {"b 'x' (a.xml:2:3)", "archive (a.xml:1:1)"}},
         "a.xml:2:6: warning: unknown attribute 'kind' [unknown-attribute]\n"
         "      <b kind='1'/>\n"
         "         ^\n"
         "    expected: 'king' or 'name'\n"
         "    did you mean 'king'?\n"
         "    line one\n"
         "    line two\n"
         "    needed by b 'x' (a.xml:2:3)\n"
         "    needed by archive (a.xml:1:1)\n"},
        {"tabs in front of the caret stay tabs",
         {.severity = Severity::note, .code = "c", .place = placeIn("\t\tx", 2), .message = "m"},
         "a.xml:1:3: note: m [c]\n    \t\tx\n    \t\t^\n"},
        {"characters of several bytes are one column on the screen",
         {.code = "c", .place = placeIn("\xc3\xa9\xe2\x82\xac x", 6), .message = "m"},
         "a.xml:1:7: error: m [c]\n    \xc3\xa9\xe2\x82\xac x\n       ^\n"},
        {"a carriage return is not shown",
         {.code = "c", .place = placeIn("ab\r\ncd", 1), .message = "m"},
         "a.xml:1:2: error: m [c]\n    ab\n     ^\n"},
        {"what a terminal would act upon is not shown",
         {.code = "c",
          .place = placeIn(std::string("\x1b[2J\0\x7f"
                                       "a",
                                       7),
                           6),
          .message = "m"},
         "a.xml:1:7: error: m [c]\n     [2J  a\n          ^\n"},
        {"a byte order mark belongs to no line",
         {.code = "c", .place = placeIn("\xef\xbb\xbf<a", 4), .message = "m"},
         "a.xml:1:2: error: m [c]\n    <a\n     ^\n"},
        {"the end of an empty file",
         {.code = "c", .place = placeIn("", 5), .message = "m"},
         "a.xml:1:1: error: m [c]\n    \n    ^\n"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        CHECK(toString(row.diagnostic) == row.text);
    }
}

TEST_CASE("a very long line is shown around the caret") {
    const std::string line = std::string(5000, 'a') + 'X' + std::string(5000, 'b');
    const std::string text = toString({.code = "c", .place = placeIn(line, 5000), .message = "m"});
    CHECK(text.size() < 500);
    const std::size_t shown = text.find('\n') + 1;
    const std::size_t caret = text.find('^');
    const std::size_t caretLine = text.rfind('\n', caret) + 1;
    CHECK(text[shown + (caret - caretLine)] == 'X');
}

TEST_CASE("a long line is not cut inside a character") {
    for (std::size_t shift = 0; shift < 3; ++shift) {
        std::string line(shift, 'a');
        for (int i = 0; i < 500; ++i)
            line += "\xe2\x82\xac";
        const std::string text =
            toString({.code = "c", .place = placeIn(line, shift + 3 * 250), .message = "m"});
        const std::size_t start = text.find('\n') + 5;
        const std::string shown = text.substr(start, text.find('\n', start) - start);
        CHECK(shown.size() % 3 == 0);
        CHECK(shown.starts_with("\xe2\x82\xac"));
        // The caret has as many characters before it as are shown there.
        const std::size_t caret = text.find('^') - (text.rfind('\n', text.find('^')) + 5);
        CHECK(caret < shown.size() / 3);
    }
}

TEST_CASE("ten thousand diagnostics are kept and told apart") {
    Diagnostics diagnostics;
    const Place place = placeIn(std::string(20000, 'a'), 0);
    for (int round = 0; round < 2; ++round) {
        for (std::size_t i = 0; i < 10000; ++i)
            diagnostics.error("c", {place.file, i}, "message");
    }
    CHECK(diagnostics.errors() == 10000);
    CHECK(diagnostics.all()[9999].place.offset == 9999);
}

TEST_CASE("a diagnostic met again is told once") {
    Diagnostics diagnostics;
    int heard = 0;
    diagnostics.onReport([&](const Diagnostic&) { ++heard; });
    const Place place = placeIn("text", 1);
    diagnostics.error("a", place, "first");
    diagnostics.error("a", place, "first");
    diagnostics.error("a", place, "second");
    diagnostics.error("b", place, "first");
    diagnostics.error("a", Place{place.file, 2}, "first");
    diagnostics.warning("w", {}, "third", "what is right");
    CHECK(heard == 5);
    CHECK(diagnostics.errors() == 4);
    CHECK(diagnostics.warnings() == 1);
    CHECK(diagnostics.all().size() == 5);
    CHECK(diagnostics.all().back().expected == "what is right");
    diagnostics.clear();
    CHECK(diagnostics.errors() == 0);
    CHECK(diagnostics.warnings() == 0);
    diagnostics.error("a", place, "first");
    CHECK(heard == 6);
}

TEST_CASE("a listener may look at the diagnostics") {
    Diagnostics diagnostics;
    std::size_t seen = 0;
    diagnostics.onReport([&](const Diagnostic&) { seen = diagnostics.all().size(); });
    diagnostics.error("a", {}, "message");
    CHECK(seen == 1);
}

TEST_CASE("threads may report at once") {
    Diagnostics diagnostics;
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&, t] {
            for (int i = 0; i < 50; ++i) {
                diagnostics.error("own", {}, std::to_string(t) + " " + std::to_string(i));
                diagnostics.warning("shared", {}, std::to_string(i));
            }
        });
    for (std::thread& thread : threads)
        thread.join();
    CHECK(diagnostics.errors() == 200);
    CHECK(diagnostics.warnings() == 50);
}
