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
