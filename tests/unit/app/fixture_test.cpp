// SPDX-License-Identifier: BSD-3-Clause
#include "app/fixture.h"

#include "archive_folder.h"
#include "core/image.h"

#include <doctest/doctest.h>

#include <string>

using namespace terrane;

namespace {

using Status = FixtureResult::Status;

/// A fixture that fills the picture with green, and a golden picture of some colour.
class Fixture : public ArchiveFolder {
public:
    Fixture() { writeColour("0.0, 1.0, 0.0", "green"); }

    void golden(int red, int green, int blue) {
        Image image = makeImage(1024, 768, 3);
        for (std::size_t i = 0; i < image.bytes.size(); i += 3) {
            image.bytes[i] = static_cast<unsigned char>(red);
            image.bytes[i + 1] = static_cast<unsigned char>(green);
            image.bytes[i + 2] = static_cast<unsigned char>(blue);
        }
        REQUIRE(writePng(*this / "green/golden.png", image));
    }

    FixtureResult run(const std::string& script, bool update = false) {
        write("green/script", script);
        FixtureOptions options{
            .data = {path() / "data"}, .output = path() / "output", .updatePictures = update};
        return runFixture(standardRegistry(), path() / "green", options);
    }

    void breakArchive() {
        std::string scene = kScene;
        scene.replace(scene.find("source="), 7, "sorce=");
        write("green/archive.xml", scene);
    }
};

bool contains(const FixtureResult& result, const std::string& text) {
    INFO("report: ", result.report);
    const bool found = result.report.find(text) != std::string::npos;
    CHECK(found);
    return found;
}

} // namespace

TEST_CASE_FIXTURE(Fixture, "a fixture passes when all its lines hold") {
    golden(0, 255, 0);
    const FixtureResult result = run("wait tiles\n"
                                     "expect image golden.png\n"
                                     "expect metric /diagnostics/errors == 0\n"
                                     "screenshot shot.png\n"
                                     "expect no-errors\n");
    CHECK(result.report == "");
    CHECK(result.status == Status::passed);
    CHECK(std::filesystem::exists(*this / "output/shot.png"));
}

TEST_CASE_FIXTURE(Fixture, "a fixture fails with each line that does not hold") {
    golden(255, 0, 0);
    const FixtureResult result = run("frames 2\n"
                                     "expect image golden.png\n"
                                     "expect tiles nobody == 3\n"
                                     "expect metric /frames/0/tiles > 3\n"
                                     "set nobody.size 3\n");
    CHECK(result.status == Status::failed);
    contains(result, "script:2: expect image golden.png\n");
    contains(result, "100 % of the pixels differ");
    contains(result, "script:3: expect tiles nobody == 3\n    there is no producer 'nobody'\n");
    contains(result, "'/frames/0/tiles' is 0\n");
    contains(result, "there is no resource 'nobody'\n");
    CHECK(std::filesystem::exists(*this / "output/golden.png"));
    CHECK(std::filesystem::exists(*this / "output/golden.difference.png"));
}

TEST_CASE_FIXTURE(Fixture, "pictures can be written anew") {
    CHECK(run("frames 1\nexpect image golden.png\n").status == Status::failed);
    const FixtureResult made = run("frames 1\nexpect image golden.png\n", true);
    CHECK(made.status == Status::passed);
    contains(made, "updated ");
    CHECK(run("frames 1\nexpect image golden.png\n", true).report.empty()); // it agrees
    golden(0, 0, 255);
    contains(run("frames 1\nexpect image golden.png\n", true), "100 % of the pixels differ");
    CHECK(std::filesystem::exists(*this / "output/golden.difference.png"));
    CHECK(run("frames 1\nexpect image golden.png\n").status == Status::passed);
}

TEST_CASE_FIXTURE(Fixture, "a fixture without its data is skipped") {
    const FixtureResult result = run("needs dem.dat\nframes 1\nexpect tiles nobody == 1\n");
    CHECK(result.status == Status::skipped);
    CHECK(result.report == "needs dem.dat\n");
    write("data/dem.dat", "");
    CHECK(run("needs dem.dat\nframes 1\n").status == Status::passed);
}

TEST_CASE_FIXTURE(Fixture, "a fixture may name another archive") {
    write("data/other.xml", "<archive><sequence name=\"a\"/></archive>");
    CHECK(run("archive other.xml\nexpect no-errors\n").status == Status::passed);
    contains(run("archive missing.xml\nexpect no-errors\n"), "there is no such archive");
    contains(run("frames 1\narchive other.xml\n"), "'archive' must be the first line");
}

TEST_CASE_FIXTURE(Fixture, "a script without a command proves nothing") {
    for (const char* script : {"", "# nothing yet\n", "needs archive.xml\n"}) {
        CAPTURE(script);
        CHECK(run(script).status == Status::failed);
        contains(run(script), "script: no command that proves anything\n");
    }
}

TEST_CASE_FIXTURE(Fixture, "a script that can't be understood is not run") {
    const FixtureResult result = run("fraems 1\nframes 1\nexpect tiles\n");
    CHECK(result.status == Status::failed);
    contains(result, "script:1: fraems 1\n    unknown command 'fraems'; did you mean 'frames'?\n");
    contains(result, "script:3: expect tiles\n");
}

TEST_CASE_FIXTURE(Fixture, "expected diagnostics must hold, at their places") {
    breakArchive();
    const std::string good = "expect diagnostic unknown-attribute archive.xml:2:39\n";
    CHECK(run(good).status == Status::passed);
    contains(run("expect diagnostic unknown-attribute archive.xml:2:40\n"),
             "'unknown-attribute' is reported at archive.xml:2:39\n");
    contains(run(good + "expect diagnostic cycle archive.xml:1:1\n"),
             "only reported: 'unknown-attribute archive.xml:2:39'\n");
    contains(run(good + "expect no-errors\n"), "<module> has no attribute 'sorce'");
    // It is drawn as far as it can be.
    contains(run(good + "frames 1\nexpect image golden.png\n"), "there is no picture");
}

TEST_CASE_FIXTURE(Fixture, "an error that no line expects fails a fixture") {
    breakArchive();
    contains(run("frames 1\n"), "an error that no line expects:");
    contains(run("expect diagnostic file-missing archive.xml:1:1\n"),
             "an error that no line expects:");
}

TEST_CASE("fixtures are found at any depth, in order") {
    ArchiveFolder folder;
    folder.write("b/script", "");
    folder.write("a/deep/script", "");
    folder.write("c/notes", "");
    const auto found = findFixtures(folder.path());
    REQUIRE(found.size() == 2);
    CHECK(found[0] == folder / "a/deep");
    CHECK(found[1] == folder / "b");
    CHECK(findFixtures(folder / "b").size() == 1);
    CHECK(findFixtures(folder / "c").empty());
    CHECK(findFixtures(folder / "nowhere").empty());
}
