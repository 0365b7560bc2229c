// SPDX-License-Identifier: BSD-3-Clause
#include "app/player.h"

#include "archive_folder.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <string>

using namespace terrane;

namespace {

using Colour = std::array<int, 3>;

PlayerOptions small(const std::filesystem::path& archive) {
    return {.archive = archive, .width = 32, .height = 24, .debug = true};
}

Colour centre(const Image& image) {
    const unsigned char* pixel = image.row(image.height / 2) + image.width / 2 * image.pixelSize();
    return {pixel[0], pixel[1], pixel[2]};
}

void checkSilent(Player& player) {
    for (const Diagnostic& diagnostic : player.diagnostics().all())
        FAIL_CHECK(toString(diagnostic));
}

std::string codes(Player& player) {
    std::string text;
    for (const Diagnostic& diagnostic : player.diagnostics().all())
        text += diagnostic.code + " ";
    return text;
}

} // namespace

TEST_CASE("a player draws what its archive describes") {
    ArchiveFolder folder;
    folder.writeColour("1.0, 0.0, 0.0");
    Player player(standardRegistry(), small(folder.path()));
    REQUIRE(player.load());
    CHECK(!player.complete());
    CHECK(player.drawUntilComplete(10));
    CHECK(player.frames() < 10);
    player.controller().view.x0 += 1;
    CHECK(!player.complete());
    CHECK(player.drawUntilComplete(10));
    const Image image = player.capture();
    CHECK(image.width == 32);
    CHECK(image.height == 24);
    CHECK(image.channels == 3);
    CHECK(centre(image) == Colour{255, 0, 0});
    checkSilent(player);
}

TEST_CASE("players live one after the other in one process") {
    for (const char* colour : {"1.0, 0.0, 0.0", "0.0, 1.0, 0.0"}) {
        ArchiveFolder folder;
        folder.writeColour(colour);
        Player player(standardRegistry(), small(folder.path()));
        REQUIRE(player.load());
        CHECK(player.frame());
        CHECK(centre(player.capture())[0] == (colour[0] == '1' ? 255 : 0));
        checkSilent(player);
    }
}

TEST_CASE("players live side by side in one process") {
    ArchiveFolder redFolder, greenFolder;
    redFolder.writeColour("1.0, 0.0, 0.0");
    greenFolder.writeColour("0.0, 1.0, 0.0");
    auto red = std::make_unique<Player>(standardRegistry(), small(redFolder.path()));
    Player green(standardRegistry(), small(greenFolder.path()));
    REQUIRE(red->load());
    REQUIRE(green.load());
    for (int i = 0; i < 3; ++i) {
        CHECK(red->frame());
        CHECK(green.frame());
        CHECK(centre(red->capture()) == Colour{255, 0, 0});
        CHECK(centre(green.capture()) == Colour{0, 255, 0});
    }
    checkSilent(*red);
    red.reset();
    CHECK(green.frame());
    CHECK(centre(green.capture()) == Colour{0, 255, 0});
    checkSilent(green);
}

TEST_CASE("an archive may say what is played and from where") {
    ArchiveFolder folder;
    folder.writeColour("0.0, 0.0, 1.0");
    folder.write("archive.xml", R"(<archive>
    <player root="world" camera="eye" method="paint" scheduler="workers" view="second">
        <view name="first" d="1"/>
        <view name="second" x0="3" y0="4" theta="0.5" phi="0.25" d="70"/>
    </player>
    <multithreadScheduler name="workers" nthreads="1"/>
    <module name="fill" version="330" source="fill.glsl"/>
    <sequence name="drawFrame">
        <setProgram><module name="fill"/></setProgram>
        <drawMesh name="whole"/>
    </sequence>
    <node name="world">
        <node flags="eye"><method id="paint" value="drawFrame"/></node>
    </node>
</archive>)");
    Player player(standardRegistry(), small(folder.path()));
    REQUIRE(player.load());
    CHECK(player.controller().view == View{.x0 = 3, .y0 = 4, .theta = 0.5, .phi = 0.25, .d = 70});
    CHECK(player.frame());
    CHECK(centre(player.capture()) == Colour{0, 0, 255});
    checkSilent(player);
}

TEST_CASE("a view at the top of an archive, or of the options, is where play starts") {
    ArchiveFolder folder;
    folder.writeColour("0.0, 0.0, 1.0");
    std::string scene = ArchiveFolder::kScene;
    scene.insert(scene.find("    <node"), "    <view x0=\"5\" d=\"7\"/>\n");
    folder.write("archive.xml", scene);
    PlayerOptions options = small(folder.path());
    Player asWritten(standardRegistry(), options);
    REQUIRE(asWritten.load());
    CHECK(asWritten.controller().view == View{.x0 = 5, .d = 7});

    options.view = View{.x0 = 9, .theta = 180, .d = 2};
    Player asTold(standardRegistry(), options);
    REQUIRE(asTold.load());
    CHECK(asTold.controller().view.x0 == 9);
    CHECK(asTold.controller().view.theta == doctest::Approx(3.14159265));
}

TEST_CASE("what can't be played is told") {
    struct Row {
        const char* name;
        const char* archive;
        const char* codes;
        const char* place; ///< of the last one
    };
    const Row rows[] = {
        {"nothing to draw", "<archive/>", "no-root ", "1:1"},
        {"another root", "<archive><player root=\"scen\"/><node name=\"scene\"/></archive>",
         "unknown-resource ", "1:24"},
        {"no camera", "<archive><node name=\"scene\"/></archive>", "no-camera ", "1:10"},
        {"another camera flag", "<archive><player camera=\"eye\"/><node name=\"scene\"/></archive>",
         "no-camera ", "1:26"},
        {"no camera method",
         "<archive><node name=\"scene\"><node flags=\"camera\"/></node></archive>",
         "no-camera-method ", "1:29"},
        {"another camera method",
         "<archive><player method=\"show\"/><node name=\"scene\" flags=\"camera\"/></archive>",
         "no-camera-method ", "1:26"},
        {"unknown view", "<archive><player view=\"top\"/><node name=\"scene\"/></archive>",
         "unknown-view no-camera ", "1:30"},
        {"a root that is no node", "<archive><sequence name=\"scene\"/></archive>",
         "mistyped-reference ", "1:10"},
        {"no XML", "<archive><node></archive>", "xml-syntax ", "1:10"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        ArchiveFolder folder;
        folder.write("archive.xml", row.archive);
        Player player(standardRegistry(), small(folder.path()));
        CHECK(!player.load());
        CHECK(codes(player) == row.codes);
        const LineColumn at = player.diagnostics().all().back().place.position();
        CHECK(std::to_string(at.line) + ":" + std::to_string(at.column) == row.place);
        CHECK(!player.drawUntilComplete());
    }
}

TEST_CASE("errors stop a player unless it is to keep going") {
    ArchiveFolder folder;
    folder.writeColour("0.0, 1.0, 0.0");
    std::string scene = ArchiveFolder::kScene;
    scene.insert(scene.find("        <drawMesh"), "        <drawMesh name=\"nothing\"/>\n");
    folder.write("archive.xml", scene);
    PlayerOptions options = small(folder.path());
    Player strict(standardRegistry(), options);
    CHECK(!strict.load());
    options.keepGoing = true;
    Player lenient(standardRegistry(), options);
    REQUIRE(lenient.load());
    CHECK(lenient.frame());
    CHECK(centre(lenient.capture()) == Colour{0, 255, 0});
    CHECK(lenient.diagnostics().errors() > 0);
}

TEST_CASE("checking reaches entries that nobody uses") {
    ArchiveFolder folder;
    folder.writeColour("0.0, 1.0, 0.0");
    std::string scene = ArchiveFolder::kScene;
    scene.insert(scene.find("    <node"), "    <terrainNode name=\"t\" szie=\"3\"/>\n");
    folder.write("archive.xml", scene);
    Player played(standardRegistry(), small(folder.path()));
    CHECK(played.load());
    Player checked(standardRegistry(), small(folder.path()));
    checked.check();
    CHECK(codes(checked).starts_with("unknown-attribute "));
}

TEST_CASE("a file of resources without a scene is fine to check") {
    ArchiveFolder folder;
    folder.write("archive.xml", "<archive><sequence name=\"nothing\"/></archive>");
    Player player(standardRegistry(), small(folder.path()));
    player.check();
    checkSilent(player);
}

TEST_CASE("metrics have the documented form") {
    ArchiveFolder folder;
    folder.writeColour("0.0, 1.0, 0.0");
    PlayerOptions options = small(folder.path());
    options.recordFrames = true;
    options.trace = true;
    Player player(standardRegistry(), options);
    REQUIRE(player.load());
    for (int i = 0; i < 3; ++i)
        CHECK(player.frame());
    const nlohmann::ordered_json m = player.metrics();
    CHECK(m["version"] == 1);
    CHECK(m["renderer"].get<std::string>() != "");
    CHECK(m["size"] == nlohmann::json{32, 24});
    for (const char* phase : {"context", "load", "compile", "first_frame"})
        CHECK(m["startup_ms"][phase].get<double>() > 0);
    CHECK(m["frames"].size() == 3);
    for (const char* time : {"cpu_ms", "gl_ms", "update_ms", "draw_ms", "tiles"})
        CHECK(m["frames"][2][time].get<double>() >= 0);
    CHECK(m["producers"].is_object());
    CHECK(m["caches"].is_object());
    CHECK(m["reloads"]["count"] == 0);
    CHECK(m["memory"]["peak_rss_bytes"].get<double>() > 1e6);
    CHECK(m["memory"]["gl_objects"].get<int>() > 3);
    CHECK(m["allocations_last_frame"] == 0);
    CHECK(m["diagnostics"]["errors"] == 0);

    player.mark();
    CHECK(player.metrics()["frames"].empty());

    const auto trace = nlohmann::json::parse(player.traceJson());
    int draws = 0;
    for (const auto& event : trace["traceEvents"]) {
        if (event["name"] == "draw") ++draws;
        if (event["ph"] == "X") CHECK(event["dur"].get<double>() >= 0);
    }
    CHECK(draws == 3);
}

TEST_CASE("time goes on by fixed steps") {
    ArchiveFolder folder;
    folder.writeColour("0.0, 1.0, 0.0");
    PlayerOptions options = small(folder.path());
    options.timeStep = 0.25;
    Player player(standardRegistry(), options);
    REQUIRE(player.load());
    CHECK(player.frame());
    CHECK(player.time() == 0);
    CHECK(player.frame());
    CHECK(player.frame());
    CHECK(player.time() == 0.5);
}
