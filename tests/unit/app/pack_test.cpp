// SPDX-License-Identifier: BSD-3-Clause
#include "app/pack.h"

#include "app/check.h"
#include "app/edit_follower.h"
#include "archive_edits.h"
#include "core/zip_file.h"
#include "core/zip_writer.h"
#include "edited_archive.h"
#include "terrane_program.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

using namespace terrane;
namespace fs = std::filesystem;

namespace {

using Terrane = test::TerraneProgram;

PackResult pack(const fs::path& archive, const fs::path& output,
                const std::vector<fs::path>& paths = {}) {
    return packArchive(standardRegistry(), archive, paths, output);
}

std::string joined(std::string list, const std::string& word) {
    return list + (list.empty() ? "" : " ") + word;
}

std::string names(const PackResult& result) {
    std::string list;
    for (const PackedFile& file : result.files)
        list = joined(list, file.name);
    return list;
}

std::string codes(const std::vector<Diagnostic>& diagnostics) {
    std::string list;
    for (const Diagnostic& diagnostic : diagnostics)
        list = joined(list, diagnostic.code);
    return list;
}

PlayerOptions small(const fs::path& archive) {
    return {.archive = archive, .width = 160, .height = 120, .debug = true};
}

Image pictureOf(const fs::path& archive) {
    Player player(standardRegistry(), small(archive));
    const bool loaded = player.load();
    for (const Diagnostic& diagnostic : player.diagnostics().all())
        FAIL_CHECK(toString(diagnostic));
    REQUIRE(loaded);
    REQUIRE(player.drawUntilComplete());
    return player.capture();
}

constexpr const char* kShader = "#ifdef _FRAGMENT_\nvoid main() {}\n#endif\n";

constexpr const char* kMesh = "0 1 0 1 0 0 points 1 0 3 float false\n1 0 0 0\n0\n";

using Names = std::vector<std::string>;

} // namespace

TEST_CASE("A packed archive draws the picture of its folder, byte for byte") {
    test::TemporaryFolder folder;
    for (const char* name : {"mountains", "planet", "quadtree"}) {
        CAPTURE(name);
        const fs::path archive = exampleArchive(name);
        const fs::path zip = folder / (std::string(name) + ".zip");
        const PackResult result = pack(archive, zip);
        CHECK(codes(result.diagnostics).empty());
        REQUIRE(result.size > 0);
        CHECK(pictureOf(zip).bytes == pictureOf(archive).bytes);
    }
}

TEST_CASE("A zip has all that an archive reaches, and nothing else") {
    EditedArchive archive;
    archive.write("unused.glsl", "not reached");
    test::TemporaryFolder folder;
    const PackResult result = pack(archive.path(), folder / "a.zip");
    CHECK(codes(result.diagnostics).empty());
    // Of Terrane's own what the archive has copies of; the font and its texture stay out.
    CHECK(names(result) ==
          "DEM.dat archive.xml branch.glsl common.glsl normal.glsl normalShader.xml paint.glsl "
          "sky.glsl tint.png upsample.glsl upsampleShader.xml whole.mesh");
    CHECK(result.builtIn > 0);
    CHECK(result.size == fs::file_size(folder / "a.zip"));

    Diagnostics diagnostics;
    const auto zip = ZipFile::open(folder / "a.zip", diagnostics);
    REQUIRE(zip);
    CHECK_FALSE(zip->find("DEM.dat")->deflated); // read in pieces, in place
    CHECK_FALSE(zip->find("tint.png")->deflated);
    CHECK(zip->find("archive.xml")->deflated);

    const auto bytes = readFile(folder / "a.zip");
    CHECK(pack(archive.path(), folder / "b.zip").size == result.size);
    CHECK(readFile(folder / "b.zip") == bytes);
    // A zip is an archive as any other.
    const PackResult again = pack(folder / "a.zip", folder / "c.zip");
    CHECK(codes(again.diagnostics).empty());
    CHECK(readFile(folder / "c.zip") == bytes);
    // And whoever has it open does not notice.
    CHECK(pack(folder / "a.zip", folder / "a.zip").size == result.size);
    CHECK(readFile(folder / "a.zip") == bytes);
}

TEST_CASE("What is found in other folders goes next to the archive") {
    test::TemporaryFolder folder;
    folder.file("scenes/a/archive.xml", R"(<archive>
        <mesh name="one" source="one.mesh"/>
        <mesh name="two" source="deep/two.mesh"/>
        <mesh name="three" source="three.mesh"/>
        <mesh name="four" source=".\deep\FOUR.mesh"/>
        <program name="p"><module name="five"/></program>
        <program name="q"><module name="six"/></program>
    </archive>)");
    folder.file("scenes/a/one.mesh", kMesh);
    folder.file("more/deep/two.mesh", kMesh);
    folder.file("more/one.mesh", "shadowed");
    folder.file("scenes/meshes/three.mesh", kMesh);
    folder.file("scenes/meshes/deep/Four.mesh", kMesh);
    folder.file("scenes/meshes/five.xml", R"(<module version="330" source="m.glsl"/>)");
    folder.file("scenes/methods/Six.xml", R"(<module version="330" source="m.glsl"/>)");
    folder.file("scenes/shaders/m.glsl", kShader);
    const PackResult result = pack(folder / "scenes/a", folder / "a.zip", {folder / "more"});
    CHECK(codes(result.diagnostics) == "case-differs case-differs");
    CHECK(names(result) ==
          "Six.xml archive.xml deep/Four.mesh deep/two.mesh five.xml m.glsl one.mesh three.mesh");
    CHECK(codes(checkArchive(standardRegistry(), folder / "a.zip", {})) ==
          "case-differs case-differs");

    SUBCASE("names that differ in their case alone are refused") {
        folder.file("scenes/meshes/ONE.mesh", kMesh);
        folder.file("scenes/a/archive.xml", R"(<archive>
            <mesh name="a" source="one.mesh"/><mesh name="b" source="ONE.mesh"/></archive>)");
        const PackResult bad = pack(folder / "scenes/a", folder / "b.zip");
        CHECK(codes(bad.diagnostics) == "pack-collision");
        CHECK(bad.size == 0);
        CHECK_FALSE(fs::exists(folder / "b.zip"));
    }
}

TEST_CASE("Data that is not prepared is left out, and told so in the zip, too") {
    test::TemporaryFolder folder;
    folder.file("a/archive.xml", R"(<archive>
        <mesh name="big" source="big.mesh"/>
        <mesh name="twice" source="one.mesh"/>
        <mesh name="twice" source="unused.mesh"/>
    </archive>)");
    folder.file("a/prepare", "#!/bin/sh\n# makes: big.mesh\n");
    folder.file("a/one.mesh", kMesh);
    folder.file("a/unused.mesh", kMesh);
    const PackResult result = pack(folder / "a", folder / "a.zip");
    CHECK(codes(result.diagnostics) == "data-not-prepared duplicate-name");
    CHECK(names(result) == "archive.xml one.mesh prepare unused.mesh");
    const auto found = checkArchive(standardRegistry(), folder / "a.zip", {});
    CHECK(codes(found) == "data-not-prepared duplicate-name");
    CHECK(checkArchive(standardRegistry(), folder / "a", {}).size() == found.size());
    // Laid into a folder that names are looked up in, it is found.
    folder.file("more/big.mesh", kMesh);
    CHECK(codes(checkArchive(standardRegistry(), folder / "a.zip", {folder / "more"})) ==
          "duplicate-name");
}

TEST_CASE("What can't be packed is told, and nothing is written") {
    test::TemporaryFolder folder;
    folder.file("a/archive.xml", "<archive/>");
    folder.file("a/other.xml", "<archive/>");
    folder.file("old.zip", "old");
    const auto refused = [&](const fs::path& archive, const std::string& code) {
        const PackResult result = pack(archive, folder / "old.zip");
        CHECK(codes(result.diagnostics) == code);
        CHECK(result.size == 0);
        CHECK(result.files.empty());
        CHECK(readFile(folder / "old.zip") == "old");
    };
    SUBCASE("an archive with errors") {
        folder.file("a/archive.xml", R"(<archive><mesh name="a" source="gone.mesh"/></archive>)");
        refused(folder / "a", "file-missing");
    }
    SUBCASE("no archive") {
        refused(folder / "gone", "no-archive");
    }
    SUBCASE("a folder that is not there") {
        const PackResult result = pack(folder / "a", folder / "gone/a.zip");
        CHECK(codes(result.diagnostics) == "pack-failed");
        CHECK(result.size == 0);
    }
    SUBCASE("a folder in its place") {
        folder.folder("b.zip");
        const PackResult result = pack(folder / "a", folder / "b.zip");
        CHECK(codes(result.diagnostics) == "pack-failed");
    }
    SUBCASE("a zip that would play something else") {
        folder.file("a/other.xml", R"(<archive>
            <program name="x"><module name="archive"/></program></archive>)");
        folder.file("a/archive.xml", R"(<module version="330" source="m.glsl"/>)");
        folder.file("a/m.glsl", kShader);
        refused(folder / "a/other.xml", "pack-ambiguous");
    }
    for (const auto& entry : fs::directory_iterator(folder.path()))
        CHECK(entry.path().string().find(".tmp") == std::string::npos);
}

TEST_CASE("Places in a zip are told as those in a folder") {
    test::TemporaryFolder folder;
    folder.file("a/archive.xml",
                "<archive>\n  <module name=\"m\" version=\"330\" source=\"m.glsl\"/>\n"
                "</archive>");
    folder.file("a/m.glsl", kShader);
    REQUIRE(pack(folder / "a", folder / "a.zip").size > 0);
    Diagnostics diagnostics;
    const auto zip = ZipFile::open(folder / "a.zip", diagnostics);
    REQUIRE(zip);
    std::string bytes = *readFile(folder / "a.zip");
    // The file in the zip gets another byte, and no longer fits its checksum.
    const ZipFile::Entry* const shader = zip->find("m.glsl");
    REQUIRE(shader);
    bytes[shader->begin + 3] = static_cast<char>(bytes[shader->begin + 3] ^ 0x10);
    folder.file("a.zip", bytes);
    const auto found = checkArchive(standardRegistry(), folder / "a.zip", {});
    REQUIRE(codes(found) == "file-unreadable");
    CHECK(found[0].place.toString() == shownPath(folder / "a.zip/archive.xml") + ":2:42");
    CHECK(found[0].message.find("can't read 'm.glsl': ") == 0);
}

TEST_CASE("A zip of a folder stands for that folder") {
    EditedArchive archive;
    test::TemporaryFolder folder;
    std::vector<ZipContent> contents;
    for (const auto& entry : fs::directory_iterator(archive.path()))
        contents.push_back({"scene/" + entry.path().filename().string(), entry.path()});
    contents.push_back({"__MACOSX/scene/._archive.xml", archive.path() / "archive.xml"});
    std::string problem;
    REQUIRE(writeZip(folder / "A.ZIP", contents, {}, problem));
    // Its data is deflated, and unpacked into memory.
    CHECK(pictureOf(folder / "A.ZIP").bytes == pictureOf(archive.path()).bytes);
}

TEST_CASE("A zip that is replaced shows at once, as edits in a folder do") {
    EditedArchive archive;
    test::TemporaryFolder folder;
    const fs::path zip = folder / "scene.zip";
    const auto repack = [&] { REQUIRE(pack(archive.path(), zip).size > 0); };
    repack();
    Player player(standardRegistry(), small(zip));
    REQUIRE(player.load());
    REQUIRE(player.drawUntilComplete());
    const Image before = player.capture();
    EditFollower edits(player);
    const auto next = [&] {
        for (int i = 0; i < 20000; ++i) {
            auto report = edits.follow();
            if (report && report->changed) return *report;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        FAIL("no reload");
        return ReloadReport{};
    };
    const std::string good = *readFile(zip);

    // The same bytes, or another comment in a shader, change nothing.
    repack();
    CHECK_FALSE(player.reload().changed);
    archive.edit("paint.glsl", "void main", "/* paint */ void main");
    repack();
    CHECK_FALSE(player.reload().changed);
    const std::string commented = *readFile(zip);
    CHECK(commented != good);

    archive.edit("paint.glsl", "vec3(", "vec3(1.5 * ");
    repack();
    ReloadReport report = next();
    CHECK(report.good);
    CHECK(report.rebuilt == Names{"paint", "paint;"});
    REQUIRE(player.drawUntilComplete());
    const Image edited = player.capture();
    CHECK(edited.bytes != before.bytes);
    CHECK(edited.bytes == pictureOf(archive.path()).bytes);

    // Half of a zip is told, and the picture stays.
    REQUIRE(writeFile(zip, good.substr(0, good.size() / 2)));
    report = next();
    CHECK_FALSE(report.good);
    REQUIRE(player.problems().size() == 1);
    CHECK(player.problems()[0].code == "zip-damaged");
    REQUIRE(player.drawUntilComplete());
    CHECK(player.capture().bytes == edited.bytes);

    REQUIRE(writeFile(zip, good));
    report = next();
    CHECK(report.good);
    CHECK(player.problems().empty());
    REQUIRE(player.drawUntilComplete());
    CHECK(player.capture().bytes == before.bytes);

    // Data, too.
    archive.write("DEM.dat", archive.read("DEM.dat") + "x");
    archive.edit("paint.glsl", "vec3(1.5 * ", "vec3(");
    repack();
    report = next();
    CHECK(report.good);
    CHECK(report.rebuilt.size() > 1);
    CHECK(report.tilesInvalidated.contains("residuals"));
    REQUIRE(player.drawUntilComplete());
    CHECK(player.capture().bytes == before.bytes);
}

TEST_CASE_FIXTURE(Terrane, "pack, play, check and test take a zip as people type it") {
    writeColour("1.0, 0.5, 0.0", "a");
    Result result = run("pack %/a %/a.zip");
    CHECK(result.status == 0);
    CHECK(result.err == "");
    const std::string head = result.out.substr(0, result.out.find("Packed"));
    CHECK(head.find("  archive.xml  ") == 0);
    CHECK(head.find("fill.glsl") != std::string::npos);
    CHECK(result.out.find("Packed 3 files of ") != std::string::npos);
    CHECK(run("check %/a.zip").out == "0 errors, 0 warnings\n");
    CHECK(run("play %/a.zip --headless --size 8x8 --frames 1 --screenshot %/zip.png").status == 0);
    CHECK(run("play %/a --headless --size 8x8 --frames 1 --screenshot %/folder.png").status == 0);
    CHECK(readFile(*this / "zip.png") == readFile(*this / "folder.png"));

    CHECK(run("play %/a --headless --frames 1 --screenshot %/fixture/good.png").status == 0);
    write("fixture/script", "archive ../a.zip\nframes 1\nexpect image good.png\n");
    result = run("test %/fixture");
    CHECK(result.status == 0);
    CAPTURE(result.out);
    CHECK(result.out.find("1 passed") != std::string::npos);

    CHECK(run("check %/a.zip/archive.xml").status == 0);
    result = run("check %/a.zip/other.xml");
    CHECK(result.status == 1);
    CHECK(result.err.find("there is no '") != std::string::npos);
    write("hostile.zip", readFile(*this / "a.zip")->substr(1));
    result = run("play %/hostile.zip --headless");
    CHECK(result.status == 1);
    CHECK(result.err.find("hostile.zip' is refused: ") != std::string::npos);
    CHECK(result.err.find("[zip-damaged]") != std::string::npos);

    write("a/fill.glsl", "damaged");
    result = run("pack %/a %/b.zip");
    CHECK(result.status == 1);
    CHECK(result.out == "");
    CHECK(result.err.find("nothing was packed: ") != std::string::npos);
    CHECK_FALSE(fs::exists(*this / "b.zip"));
}
