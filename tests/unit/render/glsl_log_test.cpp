// SPDX-License-Identifier: BSD-3-Clause
#include "render/glsl_log.h"

#include <doctest/doctest.h>

namespace terrane {

namespace {

GlslText textOf(const std::string& source) {
    const auto file = std::make_shared<const SourceFile>("s.glsl", source);
    GlslText text;
    text.append("#version 330\n", {});
    text.append(file, 0, source.size());
    return text;
}

} // namespace

TEST_CASE("The messages of all drivers are understood") {
    struct Row {
        const char* driver;
        const char* log;
        Severity severity;
        int line, column;
        const char* text;
    };
    const Row rows[] = {
        {"Mesa", "0:12(5): error: `bad' undeclared\n", Severity::error, 12, 5, "`bad' undeclared"},
        {"Mesa, warning", "0:3(41): warning: `x' used uninitialized", Severity::warning, 3, 41,
         "`x' used uninitialized"},
        {"Mesa, preprocessor", "2:5(4): preprocessor error: #error hi there", Severity::error, 5, 4,
         "#error hi there"},
        {"Mesa, linker", "error: vertex shader lacks `main'\n", Severity::error, 0, 0,
         "vertex shader lacks `main'"},
        {"NVIDIA", "0(12) : error C1008: undefined variable \"bad\"\n", Severity::error, 12, 0,
         "undefined variable \"bad\""},
        {"NVIDIA, warning", "0(7) : warning C7050: \"x\" might be used before being initialized",
         Severity::warning, 7, 0, "\"x\" might be used before being initialized"},
        {"NVIDIA, fatal", "0(2) : fatal error C9999: *** exception", Severity::error, 2, 0,
         "*** exception"},
        {"NVIDIA, linker", "(0) : error C6020: Constant register limit exceeded", Severity::error,
         0, 0, "Constant register limit exceeded"},
        {"Mesa, another text",
         "3:120(17): error: value of type vec3 cannot be assigned to variable "
         "of type float",
         Severity::error, 120, 17,
         "value of type vec3 cannot be assigned to variable of type float"},
        {"Mesa, preprocessor's warning", "0:4(9): preprocessor warning: #warning careful",
         Severity::warning, 4, 9, "#warning careful"},
        {"Mesa, linker's input",
         "error: fragment shader input `uv' has no matching output in the previous stage",
         Severity::error, 0, 0,
         "fragment shader input `uv' has no matching output in the previous stage"},
        {"Mesa, linker's warning",
         "warning: fragment shader varying x not written by vertex shader", Severity::warning, 0, 0,
         "fragment shader varying x not written by vertex shader"},
        {"NVIDIA, syntax",
         "0(31) : error C0000: syntax error, unexpected '}', expecting ',' or ';' at token \"}\"",
         Severity::error, 31, 0,
         "syntax error, unexpected '}', expecting ',' or ';' at token \"}\""},
        {"NVIDIA, another text", "2(5) : error C1503: undefined variable \"bad\"", Severity::error,
         5, 0, "undefined variable \"bad\""},
        {"NVIDIA, a name from #line", "\"s.glsl\"(5) : error C1008: undefined variable \"bad\"",
         Severity::error, 5, 0, "undefined variable \"bad\""},
        {"NVIDIA, linker without place",
         "error: \"uv\" not declared as an output from the previous stage", Severity::error, 0, 0,
         "\"uv\" not declared as an output from the previous stage"},
        {"AMD on Windows", "ERROR: 0:12: error(#143) Undeclared identifier: bad", Severity::error,
         12, 0, "Undeclared identifier: bad"},
        {"AMD on Windows, warning",
         "WARNING: 0:3: warning(#402) Implicit truncation of vector from size: 4 to size: 3",
         Severity::warning, 3, 0, "Implicit truncation of vector from size: 4 to size: 3"},
        {"AMD on Windows, linker", "ERROR: error(#280) Not all shaders have valid object code.",
         Severity::error, 0, 0, "Not all shaders have valid object code."},
        {"Intel on Windows", "ERROR: 0:12: 'assign' :  cannot convert from 'const float' to 'vec4'",
         Severity::error, 12, 0, "'assign' :  cannot convert from 'const float' to 'vec4'"},
        {"Apple", "ERROR: 0:12: Use of undeclared identifier 'bad'", Severity::error, 12, 0,
         "Use of undeclared identifier 'bad'"},
        {"Apple, version", "ERROR: 0:1: '' :  version '450' is not supported", Severity::error, 1,
         0, "'' :  version '450' is not supported"},
        {"Apple, linker", "ERROR: Input of fragment shader 'uv' not written by vertex shader",
         Severity::error, 0, 0, "Input of fragment shader 'uv' not written by vertex shader"},
        {"Intel on Windows, Apple", "ERROR: 0:12: 'bad' : undeclared identifier ", Severity::error,
         12, 0, "'bad' : undeclared identifier "},
        {"AMD, warning", "WARNING: 0:3: implicit conversion", Severity::warning, 3, 0,
         "implicit conversion"},
        {"AMD, linker", "ERROR: Linking: no main", Severity::error, 0, 0, "Linking: no main"},
        {"mobile", "0:12: L0001: Undeclared variable 'bad'", Severity::error, 12, 0,
         "L0001: Undeclared variable 'bad'"},
        {"line ends of another system", "0:1(2): error: x\r\n\r\n", Severity::error, 1, 2, "x"},
        {"anything else", "something went wrong", Severity::error, 0, 0, "something went wrong"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.driver);
        const std::vector<GlslMessage> messages = parseGlslLog(row.log);
        REQUIRE(messages.size() == 1);
        CHECK(messages[0].severity == row.severity);
        CHECK(messages[0].line == row.line);
        CHECK(messages[0].column == row.column);
        CHECK(messages[0].text == row.text);
    }
}

TEST_CASE("Lines that continue a message become its detail, summaries are left out") {
    auto messages = parseGlslLog("0:10(5): error: no matching function for call to `f(int)'; "
                                 "candidates are:\n0:10(5): error:    float f(vec2)\n"
                                 "0:10(5): error:    float f(vec3)\n0:11(1): error: next\n");
    REQUIRE(messages.size() == 2);
    CHECK(messages[0].detail == "   float f(vec2)\n   float f(vec3)");
    CHECK(messages[1].text == "next");
    messages = parseGlslLog("Fragment info\n-------------\n0(3) : error C5052: gl_Vertex\n"
                            "    is not accessible\n\nERROR: 1 compilation errors.  No code "
                            "generated.\n");
    REQUIRE(messages.size() == 1);
    CHECK(messages[0].detail == "    is not accessible");
    CHECK(parseGlslLog("").empty());
    CHECK(parseGlslLog("\n \n\r\n").empty());
}

TEST_CASE("Whole logs give the messages in them, and nothing else") {
    struct Row {
        const char* driver;
        const char* log;
        std::vector<std::string> messages; // "line text"
    };
    const Row rows[] = {
        {"AMD on Windows",
         "Fragment shader failed to compile with the following errors:\n"
         "ERROR: 0:12: error(#143) Undeclared identifier: bad\n"
         "ERROR: 0:14: error(#132) Syntax error: \"}\" parse error\n"
         "ERROR: error(#273) 2 compilation errors.  No code generated\n\n",
         {"12 Undeclared identifier: bad", "14 Syntax error: \"}\" parse error"}},
        {"AMD on Windows, all well",
         "Vertex shader was successfully compiled to run on hardware.\n"
         "Vertex shader(s) linked.\n",
         {}},
        {"NVIDIA, linker",
         "Vertex info\n-----------\n0(3) : error C1008: undefined variable \"a\"\n\n"
         "Fragment info\n-------------\n0(9) : warning C7022: unrecognized profile specifier "
         "\"b\"\n(0) : error C2003: incompatible options for link\n",
         {"3 undefined variable \"a\"", "9 unrecognized profile specifier \"b\"",
          "0 incompatible options for link"}},
        {"Intel on Windows",
         "ERROR: 0:12: 'bad' : undeclared identifier \n"
         "ERROR: 0:12: 'assign' :  cannot convert from 'const float' to 'vec4'\n",
         {"12 'bad' : undeclared identifier ",
          "12 'assign' :  cannot convert from 'const float' to 'vec4'"}},
        {"the reference compiler",
         "ERROR: 0:12: 'bad' : undeclared identifier \n"
         "ERROR: 1 compilation errors.  No code generated.\n\n",
         {"12 'bad' : undeclared identifier "}},
    };
    for (const Row& row : rows) {
        CAPTURE(row.driver);
        std::vector<std::string> messages;
        for (const GlslMessage& m : parseGlslLog(row.log))
            messages.push_back(std::to_string(m.line) + " " + m.text);
        CHECK(messages == row.messages);
    }
}

TEST_CASE("Every driver's message about an included file is told in that file") {
    // `bad` stands in the included file, on the third line of what is compiled.
    const auto archive = std::make_shared<const SourceFile>("archive.xml", "<module/>");
    const auto outer = std::make_shared<const SourceFile>("s.glsl", "#include \"light.glsl\"\n");
    const auto inner =
        std::make_shared<const SourceFile>("light.glsl", "vec3 a;\nvec3 b = a + bad;\n");
    GlslText included, text;
    included.append(inner, 0, inner->text().size());
    text.append("#version 330\n", {});
    text.appendIncluded(included, {outer, 0});
    struct Row {
        const char* driver;
        const char* log;
        const char* place;
    };
    const Row rows[] = {
        {"Mesa", "0:3(14): error: `bad' undeclared", "light.glsl:2:14"},
        {"NVIDIA", "0(3) : error C1008: undefined variable \"bad\"", "light.glsl:2:14"},
        {"AMD on Windows", "ERROR: 0:3: error(#143) Undeclared identifier: bad", "light.glsl:2:14"},
        {"Intel on Windows", "ERROR: 0:3: 'bad' : undeclared identifier ", "light.glsl:2:14"},
        {"Apple", "ERROR: 0:3: Use of undeclared identifier 'bad'", "light.glsl:2:14"},
        {"mobile", "0:3: L0002: Undeclared variable 'bad'", "light.glsl:2:14"},
        {"NVIDIA, a syntax error",
         "0(3) : error C0000: syntax error, unexpected identifier, "
         "expecting ';' at token \"bad\"",
         "light.glsl:2:14"},
        {"Intel, no name of the line", "ERROR: 0:3: 'assign' : cannot convert", "light.glsl:2:1"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.driver);
        Diagnostics diagnostics;
        reportCompileLog(row.log, true, text, "fragment", {archive, 0}, diagnostics);
        REQUIRE(diagnostics.all().size() == 1);
        const Diagnostic d = diagnostics.all()[0];
        CHECK(d.place.toString() == row.place);
        CHECK(d.chain == std::vector<std::string>{"#include at s.glsl:1:1"});
    }
}

TEST_CASE("Columns of Mesa's preprocessed lines lead back to the author's") {
    struct Row {
        const char* name;
        const char* source;
        int line, column;
        const char* message;
        const char* place;
    };
    const Row rows[] = {
        {"plain", "c = bad;", 1, 5, "x", "s.glsl:1:5"},
        {"indented", "    c = bad;", 1, 6, "x", "s.glsl:1:9"},
        {"tabs and runs of blanks", "\t\t c  =\t bad;", 1, 6, "x", "s.glsl:1:10"},
        {"comments", "c /* a */ = /**/bad;", 1, 5, "x", "s.glsl:1:17"},
        {"a comment over lines", "c /* a\n b */ = bad;", 1, 5, "x", "s.glsl:2:9"},
        {"a continued line", "c = 1 \\\n  + bad;", 1, 9, "x", "s.glsl:2:5"},
        {"the second line", "a;\n  b;", 2, 2, "x", "s.glsl:2:3"},
        {"past the end of the line", "a;\nb;", 1, 50, "x", "s.glsl:1:2"},
        {"past the end of the text", "a;\nb;", 50, 1, "x", "s.glsl:2:3"},
        {"before a macro", "#define M 1+1\nbad = M;", 2, 1, "`bad' undeclared", "s.glsl:2:1"},
        {"behind a macro", "#define M 1+1+1\nc = M + bad;", 2, 13, "`bad' undeclared",
         "s.glsl:2:9"},
        {"in a macro", "#define M bad\nc = 1 + M;", 2, 9, "`bad' undeclared", "s.glsl:2:9"},
        {"behind a macro, no name", "#define M 1+1+1\nc = M + 1", 2, 9, "syntax error",
         "s.glsl:2:5"},
        {"a driver without columns", "  c = 1 + bad;", 1, 0, "undefined variable \"bad\"",
         "s.glsl:1:11"},
        {"a driver without columns, a call", "c = f(1);", 1, 0, "no overload of 'f(int)'",
         "s.glsl:1:5"},
        {"a driver without columns, no name", "   c = 1", 1, 0, "syntax error", "s.glsl:1:4"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        const GlslText text = textOf(row.source);
        const auto offset =
            offsetOf({.line = row.line + 1, .column = row.column, .text = row.message}, text);
        REQUIRE(offset);
        CHECK(text.place(*offset).toString() == row.place);
    }
    CHECK_FALSE(offsetOf({.text = "linker"}, textOf("a")));
}

TEST_CASE("A driver that fails without a word is reported nevertheless") {
    Diagnostics diagnostics;
    const auto archive = std::make_shared<const SourceFile>("archive.xml", "<module/>");
    reportCompileLog("", true, textOf("a"), "vertex", {archive, 0}, diagnostics);
    REQUIRE(diagnostics.errors() == 1);
    CHECK(diagnostics.all()[0].code == "glsl-compile");
    CHECK(diagnostics.all()[0].place.toString() == "archive.xml:1:1");
    diagnostics.clear();
    reportCompileLog("0:2(1): warning: w\n", true, textOf("a"), "vertex", {archive, 0},
                     diagnostics);
    CHECK(diagnostics.errors() == 1);
    CHECK(diagnostics.warnings() == 1);
    diagnostics.clear();
    reportLinkLog("", true, {archive, 0}, "a;b;", {}, diagnostics);
    REQUIRE(diagnostics.errors() == 1);
    CHECK(diagnostics.all()[0].code == "glsl-link");
    CHECK(diagnostics.all()[0].message.find("a;b;") != std::string::npos);
}

TEST_CASE("A linker's message is told where the name that it quotes stands") {
    const auto archive = std::make_shared<SourceFile>("archive.xml", "<program>");
    const GlslText first = textOf("// light\nvoid main() {}\n");
    const GlslText second = textOf("void main() { light(); }\n");
    struct Row {
        const char* log;
        const char* place;
        std::size_t links; // of the chain
    };
    const Row rows[] = {{"error: unresolved reference to function `light'\n", "s.glsl:1:15", 1},
                        {"error: unresolved reference to function `shade'\n", "archive.xml:1:1", 0},
                        {"error: the driver is in a bad mood\n", "archive.xml:1:1", 0}};
    for (const Row& row : rows) {
        CAPTURE(row.log);
        Diagnostics diagnostics;
        reportLinkLog(row.log, true, {archive, 0}, "a;b;", {&first, &second}, diagnostics);
        REQUIRE(diagnostics.errors() == 1);
        const Diagnostic d = diagnostics.all()[0];
        CHECK(d.place.toString() == row.place);
        CHECK(d.chain.size() == row.links);
        CHECK(d.message.starts_with("program 'a;b;': "));
    }
}

TEST_CASE("What a driver says about good code is no error") {
    Diagnostics diagnostics;
    reportCompileLog("0(1) : error C1: odd\nremark\n", false, textOf("a"), "vertex", {},
                     diagnostics);
    CHECK(diagnostics.errors() == 0);
    CHECK(diagnostics.warnings() == 1);
}

TEST_CASE("Logs without end or sense are bounded") {
    Diagnostics diagnostics;
    std::string log;
    for (int i = 0; i < 10000; ++i)
        log += "0:" + std::to_string(i) + "(1): error: e" + std::to_string(i) + "\n";
    reportCompileLog(log, true, textOf("a\nb"), "vertex", {}, diagnostics);
    CHECK(diagnostics.all().size() <= 20);
    for (const char* odd : {"99999999999999999999:1(1): error: x", "0:-5(3): error: x", "0(",
                            "0:1(", ":::", "ERROR:", "ERROR: 0:", "0:1(2): error", "(", "\0"}) {
        CAPTURE(odd);
        for (const GlslMessage& message : parseGlslLog(odd))
            CHECK(message.line >= 0);
    }
}

} // namespace terrane
