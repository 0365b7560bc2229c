// SPDX-License-Identifier: BSD-3-Clause
#include "render/glsl_source.h"

#include <doctest/doctest.h>

#include <map>

namespace terrane {

namespace {

using Source = std::shared_ptr<const SourceFile>;

/// Files by name, as a loader would give them.
struct Files {
    std::map<std::string, Source> files;
    Diagnostics diagnostics;

    Source add(const std::string& name, const std::string& text) {
        return files[name] = std::make_shared<const SourceFile>(name, text);
    }
    GlslFiles lookup() {
        return {.find = [this](const std::string& name, const Place&) -> Source {
                    const auto found = files.find(name);
                    return found == files.end() ? nullptr : found->second;
                },
                .namesNear =
                    [this](const std::string&) {
                        std::vector<std::string> names;
                        for (const auto& [name, file] : files)
                            names.push_back(name);
                        return names;
                    }};
    }
    ExpandedGlsl expand(const std::string& name) {
        return expandGlsl(files.at(name), lookup(), diagnostics);
    }
    std::string codes() const {
        std::string codes;
        for (const Diagnostic& d : diagnostics.all())
            codes += d.place.toString() + " " + d.code + "\n";
        return codes;
    }
};

} // namespace

TEST_CASE("Includes are replaced by the text of their files") {
    struct Row {
        const char* name;
        const char* main;
        const char* included;
        const char* expanded;
    };
    const Row rows[] = {
        {"on a line of its own", "a\n#include \"x\"\nb", "1\n2\n", "a\n1\n2\n\nb"},
        {"in the middle of a line", "a #include \"x\" + c;", "b", "a b + c;"},
        {"twice", "#include \"x\"#include \"x\"", "1", "11"},
        {"in a macro", "#define A #include \"x\"\nb", "1", "#define A 1\nb"},
        {"with blanks", "#  include\t \"x\"", "1", "1"},
        {"not in a line comment", "// #include \"x\"\n", "1", "// #include \"x\"\n"},
        {"not in a block comment", "/* #include \"x\"\n*/", "1", "/* #include \"x\"\n*/"},
        {"not in a continued line comment", "// \\\n#include \"x\"\n", "1",
         "// \\\n#include \"x\"\n"},
        {"behind a comment", "/* a *//**/#include \"x\"", "1", "/* a *//**/1"},
        {"behind a slash that starts no comment", "a / #include \"x\"", "1", "a / 1"},
        {"in what a condition leaves out", "#if 0\n#include \"x\"\n#endif", "1",
         "#if 0\n1\n#endif"},
        {"but no other directive", "#includes \"x\"\n#if 1", "1", "#includes \"x\"\n#if 1"},
        {"with an empty file", "a#include \"x\"b", "", "ab"},
        {"with the line ends of another system", "#include \"x\"\r\nb\r\n", "1\r\n",
         "1\r\n\r\nb\r\n"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        Files files;
        files.add("main", row.main);
        files.add("x", row.included);
        CHECK(files.expand("main").text.text() == row.expanded);
        CHECK(files.codes() == "");
    }
}

TEST_CASE("Included files include others, and each is listed once") {
    Files files;
    files.add("main", "#include \"a\"\n#include \"b\"\n");
    files.add("a", "A #include \"b\"");
    files.add("b", "B");
    const ExpandedGlsl expanded = files.expand("main");
    CHECK(expanded.text.text() == "A B\nB\n");
    REQUIRE(expanded.files.size() == 3);
    CHECK(expanded.files[0]->path() == "main");
    CHECK(expanded.files[1]->path() == "a");
    CHECK(expanded.files[2]->path() == "b");
    CHECK(expanded.complete);
}

TEST_CASE("Every byte of expanded text knows its place and the includes that brought it in") {
    Files files;
    files.add("main", "m1\nm2 #include \"a\" m3\nm4");
    files.add("a", "a1\n#include \"b\"\na2");
    files.add("b", "b1\nb2");
    const GlslText text = files.expand("main").text;
    CHECK(text.text() == "m1\nm2 a1\nb1\nb2\na2 m3\nm4");
    const auto placeOf = [&](const char* word) {
        return text.place(text.text().find(word)).toString();
    };
    CHECK(placeOf("m1") == "main:1:1");
    CHECK(placeOf("m2") == "main:2:1");
    CHECK(placeOf("a1") == "a:1:1");
    CHECK(placeOf("b2") == "b:2:1");
    CHECK(placeOf("a2") == "a:3:1");
    CHECK(placeOf("m3") == "main:2:17");
    CHECK(placeOf("m4") == "main:3:1");
    const std::vector<Place> inclusions = text.inclusions(text.text().find("b2"));
    REQUIRE(inclusions.size() == 2);
    CHECK(inclusions[0].toString() == "a:2:1");
    CHECK(inclusions[1].toString() == "main:2:4");
    CHECK(text.inclusions(text.text().find("m3")).empty());
}

TEST_CASE("What is wrong with an include is told at its place") {
    Files files;
    SUBCASE("missing") {
        files.add("main", "a\n  #include \"noice\"\nb");
        files.add("noise", "");
        const ExpandedGlsl expanded = files.expand("main");
        CHECK(files.codes() == "main:2:3 include-missing\n");
        CHECK(files.diagnostics.all()[0].suggestion == "noise");
        CHECK_FALSE(expanded.complete);
        CHECK(expanded.text.text() == "a\n  \nb");
    }
    SUBCASE("missing in an included file") {
        files.add("main", "#include \"a\"");
        files.add("a", "\n\n x #include \"b\"");
        files.expand("main");
        CHECK(files.codes() == "a:3:4 include-missing\n");
    }
    SUBCASE("all that are missing") {
        files.add("main", "#include \"a\"\n#include \"b\"");
        files.expand("main");
        CHECK(files.codes() == "main:1:1 include-missing\nmain:2:1 include-missing\n");
    }
    SUBCASE("of itself") {
        files.add("main", "x\n#include \"main\"\ny");
        const ExpandedGlsl expanded = files.expand("main");
        CHECK(files.codes() == "main:2:1 include-cycle\n");
        CHECK(expanded.text.text() == "x\n\ny");
    }
    SUBCASE("of itself by others") {
        files.add("main", "#include \"a\"");
        files.add("a", "#include \"b\"");
        files.add("b", " #include \"a\"");
        files.expand("main");
        CHECK(files.codes() == "b:1:2 include-cycle\n");
        CHECK(files.diagnostics.all()[0].message.find("a, b, a") != std::string::npos);
    }
    SUBCASE("without a name") {
        for (const char* text : {"#include", "#include <x>", "#include \"x\n\"", "#include \"\"",
                                 "#include x", "#include \""}) {
            CAPTURE(text);
            Files bad;
            bad.add("main", text);
            bad.add("x", "");
            CHECK_FALSE(bad.expand("main").complete);
            CHECK(bad.codes() == "main:1:1 include-syntax\n");
        }
    }
}

TEST_CASE("Hostile sources end, and stay within bounds") {
    Files files;
    SUBCASE("each file includes the next twice") {
        for (int i = 0; i < 40; ++i) {
            const std::string next = "#include \"" + std::to_string(i + 1) + "\"\n";
            files.add(std::to_string(i), next + next);
        }
        files.add("40", "x");
        CHECK_FALSE(files.expand("0").complete);
        CHECK(files.codes().find("include-limit") != std::string::npos);
    }
    SUBCASE("a huge file many times") {
        files.add("big", std::string(3 << 20, 'x'));
        std::string main;
        for (int i = 0; i < 100; ++i)
            main += "#include \"big\"\n";
        files.add("main", main);
        const ExpandedGlsl expanded = files.expand("main");
        CHECK_FALSE(expanded.complete);
        CHECK(expanded.text.text().size() <= kLongestGlsl);
        CHECK(files.diagnostics.all().size() == 1);
    }
    SUBCASE("a chain without an end") {
        int made = 0;
        const GlslFiles endless{.find = [&](const std::string& name, const Place&) {
            ++made;
            return std::make_shared<const SourceFile>(name, "#include \"" + name + "x\"");
        }};
        const auto main = std::make_shared<const SourceFile>("m", "#include \"m1\"");
        CHECK_FALSE(expandGlsl(main, endless, files.diagnostics).complete);
        CHECK(made < 1000);
    }
    SUBCASE("comments without an end, zeros, other encodings") {
        const std::string text("/* #include \"main\" \0 \xff\xfe /", 26);
        files.add("main", text);
        CHECK(files.expand("main").text.text() == text);
        for (const char* odd : {"", "/", "//", "/*", "\\", "#", "//\\", "//\\\n", "/*/"}) {
            CAPTURE(odd);
            files.add("main", odd);
            CHECK(files.expand("main").text.text() == odd);
        }
        CHECK(files.codes() == "");
    }
}

TEST_CASE("A stage exists if its macro occurs anywhere in the text") {
    struct Row {
        const char* text;
        bool vertex, control, evaluation, geometry, fragment;
    };
    const Row rows[] = {
        {"void main() {}", false, false, false, false, false},
        {"#ifdef _VERTEX_\n#endif", true, false, false, false, false},
        {"// _FRAGMENT_", false, false, false, false, true},
        {"a_GEOMETRY_b", false, false, false, true, false},
        {"_TESS_CONTROL_ _TESS_EVAL_", false, true, true, false, false},
        {"_vertex_ _VERTEX", false, false, false, false, false},
    };
    for (const Row& row : rows) {
        CAPTURE(row.text);
        GlslText text;
        text.append(row.text, {});
        CHECK(mentionsStage(text, ShaderStage::vertex) == row.vertex);
        CHECK(mentionsStage(text, ShaderStage::tessControl) == row.control);
        CHECK(mentionsStage(text, ShaderStage::tessEvaluation) == row.evaluation);
        CHECK(mentionsStage(text, ShaderStage::geometry) == row.geometry);
        CHECK(mentionsStage(text, ShaderStage::fragment) == row.fragment);
    }
}

TEST_CASE("A stage's text is version, macro, options, file") {
    const auto archive = std::make_shared<const SourceFile>("archive.xml", "<module version=330/>");
    GlslText body;
    body.append("void main() {}\n", {archive, 3});
    GlslHeader header{.version = 330,
                      .versionPlace = {archive, 8},
                      .macro = ShaderStage::geometry,
                      .options = {"A", "TAPS 4", "", " ", "B\n3"},
                      .optionsPlace = {archive, 1}};
    const GlslText text = assembleStage(header, body);
    CHECK(text.text() == "#version 330\n#define _GEOMETRY_\n#define A\n#define TAPS 4\n"
                         "#define B 3\nvoid main() {}\n");
    CHECK(text.place(0).offset == 8);
    CHECK(text.place(text.text().find("TAPS")).offset == 1);
    header.macro.reset();
    header.options.clear();
    CHECK(assembleStage(header, body).text() == "#version 330\nvoid main() {}\n");
}

} // namespace terrane
