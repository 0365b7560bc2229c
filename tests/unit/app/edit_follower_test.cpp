// SPDX-License-Identifier: BSD-3-Clause
#include "app/edit_follower.h"

#include "edited_archive.h"

#include <doctest/doctest.h>

#include <chrono>
#include <fstream>
#include <thread>

using namespace terrane;

namespace fs = std::filesystem;

namespace {

using Seconds = std::chrono::duration<double>;

/// What the next change that matters comes to; nothing when none does in time.
std::optional<ReloadReport> nextReload(EditFollower& edits, Seconds patience = Seconds(20)) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < end) {
        auto report = edits.follow();
        if (report && report->changed) return report;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return std::nullopt;
}

/// Until there is no problem any more, which takes a reload that changes nothing.
bool isMended(const Player& player, EditFollower& edits) {
    for (int i = 0; i < 20000 && !player.problems().empty(); ++i) {
        edits.follow();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return player.problems().empty();
}

void writeInPlace(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

} // namespace

TEST_CASE("whatever is saved is on the screen a moment later") {
    EditedArchive archive;
    const std::string tint = archive.read("tint.png"), paint = archive.read("paint.glsl"),
                      common = archive.read("common.glsl");
    Player& player = archive.open();
    EditFollower edits(player);
    archive.write("tint.png", "bad");
    REQUIRE(nextReload(edits));
    archive.write("tint.png", tint);
    REQUIRE(isMended(player, edits));

    const auto changed = [](std::string text) {
        const std::size_t at = text.find("vec3(");
        return text.insert(at + 5, "1.0 * ");
    };
    SUBCASE("written in place") {
        writeInPlace(archive.path() / "paint.glsl", changed(paint));
        const auto report = nextReload(edits);
        REQUIRE(report);
        CHECK(report->good);
        CHECK(report->rebuilt == std::vector<std::string>{"paint", "paint;"});
    }
    SUBCASE("written beside, and renamed") {
        archive.write("paint.glsl", changed(paint));
        const auto report = nextReload(edits);
        REQUIRE(report);
        CHECK(report->good);
    }
    SUBCASE("as vim does: moved away, and written anew") {
        fs::rename(archive.path() / "paint.glsl", archive.path() / "paint.glsl~");
        writeInPlace(archive.path() / "paint.glsl", changed(paint));
        fs::remove(archive.path() / "paint.glsl~");
        auto report = nextReload(edits);
        while (report && !report->good)
            report = nextReload(edits);
        CHECK(report);
        CHECK(player.problems().empty());
    }
    SUBCASE("an include") {
        archive.write("common.glsl", changed(common));
        const auto report = nextReload(edits);
        REQUIRE(report);
        CHECK(report->good);
    }
    SUBCASE("deleted, and restored") {
        archive.remove("common.glsl");
        const auto bad = nextReload(edits);
        REQUIRE(bad);
        CHECK_FALSE(bad->good);
        CHECK(!player.problems().empty());
        archive.write("common.glsl", common);
        CHECK(isMended(player, edits));
    }
    SUBCASE("a file that was missing") {
        archive.edit("archive.xml", "source=\"sky.glsl\"", "source=\"shaders/late.glsl\"");
        const auto bad = nextReload(edits);
        REQUIRE(bad);
        CHECK_FALSE(bad->good);
        archive.write("shaders/late.glsl", archive.read("sky.glsl"));
        const auto report = nextReload(edits);
        REQUIRE(report);
        CHECK(report->good);
        archive.edit("shaders/late.glsl", "0.4, 0.6", "0.6, 0.4");
        const auto again = nextReload(edits);
        REQUIRE(again);
        CHECK(again->rebuilt == std::vector<std::string>{"sky", "sky;"});
    }
    SUBCASE("a file of its own that takes the place of a built-in one") {
        archive.write(
            "deformation.glsl", "// mine\n" + archive.read("common.glsl") + [] {
                const auto text = readFile(homeFolder() / "resources/shaders/deformation.glsl");
                REQUIRE(text);
                return *text;
            }());
        archive.edit("paint.glsl", "#include \"common.glsl\"", "");
        const auto report = nextReload(edits);
        REQUIRE(report);
        CHECK(report->good);
    }
    CHECK(archive.picture().bytes == archive.freshPicture().bytes);
}

TEST_CASE("an archive that is broken from the start is drawn when it is mended") {
    for (const char* const file : {"archive.xml", "paint.glsl"}) {
        CAPTURE(file);
        EditedArchive archive({.keepGoing = true});
        const std::string good = archive.read(file);
        archive.write(file, file == std::string("archive.xml") ? "<archive" : "void main() {");
        Player player(standardRegistry(), {.archive = archive.path(),
                                           .width = 160,
                                           .height = 120,
                                           .keepGoing = true,
                                           .debug = true});
        player.load();
        CHECK(!player.problems().empty());
        archive.write(file, "still bad");
        CHECK_FALSE(player.reload().good);
        CHECK(!player.problems().empty());
        archive.write(file, good);
        CHECK(player.reload().good);
        CHECK(player.problems().empty());
        REQUIRE(player.drawUntilComplete());
        archive.open();
        CHECK(player.capture().bytes == archive.picture().bytes);
        // From here on it is an archive like any other.
        archive.edit("paint.glsl", "0.35, 0.5, 0.25", "0.6, 0.5, 0.25");
        CHECK(player.reload().rebuilt == std::vector<std::string>{"paint", "paint;"});
    }
}

TEST_CASE("problems are written over the picture where that is wanted") {
    EditedArchive archive({.showProblems = true});
    Player& player = archive.open();
    const Image before = archive.picture();
    const std::string paint = archive.read("paint.glsl");
    archive.edit("paint.glsl", "vec3 normal", "vec4 normal");
    CHECK_FALSE(player.reload().good);
    const Image bad = archive.picture();
    int reddish = 0, changedBelow = 0;
    for (int y = 0; y < bad.height; ++y) {
        for (int x = 0; x < bad.width; ++x) {
            const unsigned char* const p = bad.row(y) + x * bad.pixelSize();
            const unsigned char* const q = before.row(y) + x * before.pixelSize();
            reddish += p[0] > 180 && p[1] < 130 && p[2] < 130;
            changedBelow += y < bad.height / 4 && !std::equal(p, p + 3, q);
        }
    }
    CHECK(reddish > 50);      // letters
    CHECK(changedBelow == 0); // and the picture below them
    archive.write("paint.glsl", paint);
    CHECK(player.reload().good);
    CHECK(archive.picture().bytes == before.bytes);
}
