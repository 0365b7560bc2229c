// SPDX-License-Identifier: BSD-3-Clause
#include "core/files.h"
#include "environment.h"
#include "render/context_attempt.h"
#include "terrane_program.h"
#include "xmllint.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

using namespace terrane;
namespace fs = std::filesystem;

namespace {

using Terrane = test::TerraneProgram;

bool contains(const std::string& text, const std::string& part) {
    INFO("text: ", text);
    const bool found = text.find(part) != std::string::npos;
    CHECK(found);
    return found;
}

} // namespace

TEST_CASE_FIXTURE(Terrane, "wrong usage exits with 2 and says why") {
    writeColour("1.0, 1.0, 1.0");
    struct Row {
        const char* words;
        const char* message;
    };
    const Row rows[] = {
        {"", "subcommand"},
        {"paly x", "there is no subcommand 'paly'"},
        {"play", "archive is required"},
        {"play % --headless --frames many", "--frames"},
        {"play % --headless --frames 0", "--frames"},
        {"play % --headless --size 3", "no size such as 1024x768"},
        {"play % --headless --camera 1,2,3", "no view such as"},
        {"play % --headless --bogus", "--bogus"},
        {"play % --headless=cave", "cave"},
        {"play % --headless --time-step 1 --real-time", "--time-step excludes --real-time"},
        {"play % --headless --log-level loud", "loud"},
        {"play % --headless --plugin x.so", "not built yet"},
        {"play % --headless --samples 4", "not built yet"},
        {"check", "archive is required"},
        {"schema --format yaml", "--format"},
        {"pack %", "output is required"},
        {"pack % out.tar", "is to end with .zip"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.words);
        const Result result = run(row.words);
        CHECK(result.status == 2);
        contains(result.err, row.message);
        CHECK(result.out == "");
    }
    CHECK(run("test %/nothing").status == 2);
}

TEST_CASE_FIXTURE(Terrane, "help and version are no failures") {
    contains(run("--help").out, "terrane play archives/mountains --headless");
    const std::string help = run("play --help").out;
    contains(help, "--screenshot");
    contains(help, "wait tiles [MAXFRAMES]");
    contains(help, "set RESOURCE.ATTRIBUTE VALUE");
    contains(run("--version").out, "terrane ");
    for (const char* words : {"--help", "play --help", "check --help", "test --help", "--version"})
        CHECK(run(words).status == 0);
}

TEST_CASE_FIXTURE(Terrane, "without a display there is no window, and a hint") {
    writeColour("1.0, 1.0, 1.0");
    const test::Environment none("DISPLAY", std::nullopt);
    const test::Environment noWayland("WAYLAND_DISPLAY", std::nullopt);
    const Result result = run("play %");
    CHECK(result.status == 1);
    contains(result.err, "error: no window can be opened: ");
    contains(result.err, "add --headless --screenshot FILE");
}

TEST_CASE_FIXTURE(Terrane, "a driver with too old an OpenGL is told by version and name") {
    writeColour("1.0, 1.0, 1.0");
    const test::Environment old("MESA_GL_VERSION_OVERRIDE", "4.1");
    for (const char* kind : {"--headless", "--headless=osmesa", "--headless=egl"}) {
        CAPTURE(kind);
        const Result result = run(std::string("play % --frames 1 ") + kind);
        CHECK(result.status == 1);
        contains(result.err, "OpenGL 4.1 (llvmpipe");
        contains(result.err, "expected: OpenGL 4.5 core");
    }
}

TEST_CASE_FIXTURE(Terrane, "what can't be had without a window is replaced, with a warning") {
    writeColour("1.0, 1.0, 1.0");
    const std::string play = "play % --frames 1 ";
    CHECK(run(play + "--headless=egl --log-level warning").err == "");
    if (!builtWithOsMesa()) {
        const Result result = run(play + "--headless=osmesa");
        CHECK(result.status == 0);
        contains(result.err, "this build is without OSMesa; drawing with EGL instead");
        return;
    }
    const test::Environment nowhere("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json");
    const Result result = run(play + "--headless=egl");
    CHECK(result.status == 0);
    contains(result.err, "warning: EGL has");
    contains(result.err, "drawing with OSMesa instead [context-fallback]");
}

TEST_CASE_FIXTURE(Terrane, "play writes what it is told to") {
    writeColour("1.0, 0.5, 0.0");
    const std::string play = "play % --headless --size 64x48 ";
    const Result result = run(play + "--frames 2 --screenshot %/a.png --metrics %/m.json "
                                     "--trace %/t.json");
    CHECK(result.status == 0);
    CHECK((result.err == "" || result.err.starts_with("drawn in software")));
    CHECK(run(play + "--frames 1 --log-level warning").err == "");
    contains(readFile(*this / "m.json").value_or(""), "\"peak_rss_bytes\"");
    contains(readFile(*this / "t.json").value_or(""), "\"traceEvents\"");
    CHECK(run(play + "--frames 2 --screenshot %/b.png").status == 0);
    const auto a = readFile(*this / "a.png"), b = readFile(*this / "b.png");
    REQUIRE(a);
    CHECK(a == b); // bit for bit
    CHECK(
        run(play + "--frames 1 --screenshot %/new/folder/a.png --metrics %/other/m.json").status ==
        0); // folders are made
    CHECK(std::filesystem::exists(*this / "new/folder/a.png"));
    CHECK(std::filesystem::exists(*this / "other/m.json"));
    CHECK(run(play + "--screenshot %/a.png/a.png").status == 1);
    contains(run(play + "--screenshot %/a.png/a.png").err, "can't write");
}

TEST_CASE_FIXTURE(Terrane, "a script that fails makes the run fail") {
    writeColour("1.0, 0.5, 0.0");
    const std::string play = "play % --headless --size 64x48 --script %/script";
    write("script", "frames 1\nexpect no-errors\n");
    CHECK(run(play).status == 0);
    write("script", "frames 1\nexpect tiles x == 1\nmark\nset x.y 1\n");
    const Result failed = run(play);
    CHECK(failed.status == 1);
    contains(failed.err, "script:2: error: there is no producer 'x'\n    expect tiles x == 1\n");
    contains(failed.err, "script:4: error: there is no resource 'x'");
    write("script", "frames 1\nexpct\n");
    contains(run(play).err, "script:2: error: unknown command 'expct'");
    CHECK(run("play % --headless --script %/none").status == 1);
}

TEST_CASE_FIXTURE(Terrane, "an interactive script answers each line") {
    writeColour("1.0, 0.5, 0.0");
    const Result result = run("play % --headless --size 64x48 --script -",
                              "frames 2\nexpect metric /frames/1/tiles == 0\nnonsense\n"
                              "expect metric /size/0 == 65\nexpect no-errors\n");
    CHECK(result.status == 0);
    CHECK(result.out.starts_with("ok\nok\nerror: unknown command 'nonsense'"));
    CHECK(result.out.ends_with("\nerror: '/size/0' is 64\nok\n"));
}

TEST_CASE_FIXTURE(Terrane, "errors of an archive go to standard error and exit with 1") {
    writeColour("1.0, 0.5, 0.0");
    std::string scene = kScene;
    scene.insert(scene.find("        <drawMesh"), "        <drawMesh name=\"nothing\"/>\n");
    write("archive.xml", scene);
    const Result played = run("play % --headless --screenshot %/a.png");
    CHECK(played.status == 1);
    contains(played.err, "archive.xml:5:");
    CHECK(!std::filesystem::exists(*this / "a.png"));
    CHECK(run("play % --headless --keep-going --screenshot %/a.png").status == 0);
    CHECK(std::filesystem::exists(*this / "a.png"));

    const Result checked = run("check %");
    CHECK(checked.status == 1);
    CHECK(checked.out == "1 error, 0 warnings\n");
    contains(checked.err, "archive.xml:5:");
    CHECK(run("check --json %").status == 1);
    contains(run("check --json %").out, "\"line\": 5");
    CHECK(run("play %/nowhere --headless").status == 1);
}

TEST_CASE_FIXTURE(Terrane, "warnings fail a strict check only") {
    write("archive.xml", "<archive><tweakBar name=\"a\"/></archive>");
    CHECK(run("check %").status == 0);
    CHECK(run("check --strict %").status == 1);
    CHECK(run("check %").out == "0 errors, 1 warning\n");
}

TEST_CASE_FIXTURE(Terrane, "fixtures run in processes of their own and are reported") {
    writeColour("0.0, 1.0, 0.0", "f/good");
    write("f/good/script", "frames 1\nexpect no-errors\n");
    writeColour("0.0, 1.0, 0.0", "f/bad");
    write("f/bad/script", "frames 1\nexpect tiles x == 1\n");
    writeColour("0.0, 1.0, 0.0", "f/missing");
    write("f/missing/script", "needs no/such/data\n");
    const Result result = run("test %/f");
    CHECK(result.status == 1);
    contains(result.out, "passed  ");
    contains(result.out, "FAILED  ");
    contains(result.out, "script:2: expect tiles x == 1\n        there is no producer 'x'\n");
    contains(result.out, "skipped ");
    contains(result.out, "    needs no/such/data\n");
    CHECK(result.out.ends_with("1 passed, 1 failed, 1 skipped\n"));
    CHECK(run("test %/f/good %/f/missing").status == 0);
}

TEST_CASE_FIXTURE(Terrane, "a new archive works at once, and its editor knows the schema") {
    const Result made = run("new %/mine");
    CHECK(made.status == 0);
    contains(made.out, "terrane play");
    CHECK(run("check --strict %/mine").status == 0);
    CHECK(run("play %/mine --headless --size 64x48 --frames 1").status == 0);
    const Result again = run("new %/mine"); // nothing is overwritten
    CHECK(again.status == 1);
    contains(again.err, "exists already");

    const Result spaced = run("new '%/it'\\''s mine'");
    CHECK(spaced.status == 0);
    // The command can be copied.
    contains(spaced.out, "terrane play '" + (*this / "it'\\''s mine").string() + "' --headless");

    const std::string archive = readFile(*this / "mine/archive.xml").value_or("");
    contains(archive, "xsi:noNamespaceSchemaLocation=\"schema/terrane.xsd\"");
    CHECK(fs::exists(*this / "mine/schema/terrane.rnc"));
    contains(readFile(*this / "mine/schemas.xml").value_or(""), "schema/terrane.rnc");
    if (test::Xmllint::installed()) {
        const std::string file = (*this / "mine/archive.xml").string();
        auto verdicts =
            test::Xmllint::validate("--schema", *this / "mine/schema/terrane.xsd", {file});
        CHECK(verdicts[file].valid);
    }
}

TEST_CASE_FIXTURE(Terrane, "what tells an editor the schema may stand at the root of any file") {
    writeColour("1.0, 1.0, 1.0");
    write("node.xml", "<node xmlns:xsi='http://www.w3.org/2001/XMLSchema-instance'\n"
                      "    xsi:noNamespaceSchemaLocation='terrane.xsd'/>");
    std::string archive = kScene;
    archive.insert(archive.find("</archive>"),
                   "<node name='a'><node value='node'/><node xsi:nil='true'/></node>");
    write("archive.xml", archive);
    const Result checked = run("check %");
    contains(checked.err, "no attribute 'xsi:nil'"); // elsewhere it is a mistake
    CHECK(checked.out == "1 error, 0 warnings\n");
}

TEST_CASE_FIXTURE(Terrane, "schema writes each format, on request into files") {
    contains(run("schema").out, "<xs:schema");
    contains(run("schema --format rnc").out, "start =");
    contains(run("schema --format md").out, "# Reference of archives");
    CHECK(run("schema --output %/a.xsd").status == 0);
    contains(readFile(*this / "a.xsd").value_or(""), "<xs:schema");
    CHECK(run("schema --format md --output %/manual").status == 0);
    contains(readFile(*this / "manual/README.md").value_or(""), "(scene.md#node)");
    const Result refused = run("schema --output %/missing/a.xsd");
    CHECK(refused.status == 1);
    contains(refused.err, "can't write");
}
