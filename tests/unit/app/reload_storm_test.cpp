// SPDX-License-Identifier: BSD-3-Clause
#include "edited_archive.h"
#include "sanitized.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

using namespace terrane;

namespace fs = std::filesystem;

namespace {

/// By hand: TERRANE_STORM_EDITS=2000 and more.
int editsOfStorm() {
    const char* const text = std::getenv("TERRANE_STORM_EDITS");
    return text ? std::atoi(text) : 200;
}

long openFiles() {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
}

double residentMegabytes() {
    std::ifstream file("/proc/self/statm");
    long total = 0, resident = 0;
    file >> total >> resident;
    return static_cast<double>(resident) * 4096 / 1e6;
}

/// Somebody who saves good and bad files without an end, the same in each run.
class Storm {
public:
    explicit Storm(EditedArchive& archive)
        : archive_(archive) {
        for (const char* file : kFiles)
            good_[file] = archive.read(file);
    }

    /// One save.
    void edit() {
        if (below(2) == 0)
            spoil();
        else
            improve();
    }

    /// Every file good, as it was meant last.
    void mend() {
        for (const auto& [file, text] : good_)
            archive_.write(file, text);
    }

private:
    static constexpr const char* kFiles[] = {
        "archive.xml", "paint.glsl", "common.glsl", "upsample.glsl", "normal.glsl",
        "branch.glsl", "sky.glsl",   "DEM.dat",     "tint.png",      "whole.mesh"};

    std::size_t below(std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
    }

    std::string number(double least, double most) {
        const double value = std::uniform_real_distribution<double>(least, most)(random_);
        return std::to_string(std::round(value * 100) / 100);
    }

    /// Puts a number in the place of the one that follows a text.
    static void setNumber(std::string& text, const std::string& before, const std::string& value) {
        const std::size_t at = text.find(before) + before.size();
        const std::size_t end = text.find_first_not_of("0123456789.-", at);
        text.replace(at, end - at, value);
    }

    void improve() {
        std::string& xml = good_["archive.xml"];
        switch (below(11)) {
        case 0:
            setNumber(xml, "noise=\"0,", number(0, 20));
            break;
        case 1:
            setNumber(xml, "name=\"warmth\" x=\"", number(0, 1));
            break;
        case 2:
            setNumber(xml, "splitFactor=\"", number(1.5, 3));
            break;
        case 3:
            setNumber(xml, "nTiles=\"", std::to_string(400 + below(100)));
            break;
        case 4:
            setNumber(xml, "nthreads=\"", std::to_string(below(4)));
            break;
        case 5:
            rename(xml);
            break;
        case 6:
            setNumber(good_["paint.glsl"], "mix(vec3(", number(0, 1));
            break;
        case 7:
            setNumber(good_["common.glsl"], "vec3(", number(-1, 1));
            break;
        case 8:
            setNumber(good_["sky.glsl"], "colour = vec4(", number(0, 1));
            break;
        case 9:
            good_["upsample.glsl"] = "// " + number(0, 1) + "\n" + good_["upsample.glsl"];
            if (good_["upsample.glsl"].size() > 20000) good_["upsample.glsl"].erase(0, 2000);
            if (const std::size_t line = good_["upsample.glsl"].find('\n');
                !good_["upsample.glsl"].starts_with("//"))
                good_["upsample.glsl"].erase(0, line + 1);
            break;
        default:
            break; // nothing but what was spoilt is mended
        }
        mend();
    }

    // Every place of a name.
    void rename(std::string& xml) {
        const std::string next = "relief" + std::to_string(below(1000));
        const std::size_t at = xml.find("<terrainNode name=\"") + 19;
        const std::string name = xml.substr(at, xml.find('"', at) - at);
        for (const std::string& quoted : {"name=\"" + name + "\"", "value=\"" + name + "\""}) {
            const std::size_t place = xml.find(quoted);
            xml.replace(place + quoted.find('"') + 1, name.size(), next);
        }
    }

    void spoil() {
        const std::string file = kFiles[below(std::size(kFiles))];
        const fs::path path = archive_.path() / file;
        std::string text = good_[file];
        const std::size_t at = below(text.size());
        switch (below(6)) {
        case 0:
            fs::remove(path);
            return;
        case 1:
            if (fs::exists(path)) fs::rename(path, archive_.path() / "elsewhere");
            return;
        case 2:
            text.resize(at); // saved halfway
            break;
        case 3:
            text.erase(at, 1 + below(40));
            break;
        case 4:
            text.insert(at, "#<\"&{\0\xff", 1 + below(7));
            break;
        default:
            text[at] = static_cast<char>(below(256));
            break;
        }
        // In place, as some editors do.
        std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
    }

    EditedArchive& archive_;
    std::map<std::string, std::string> good_;
    std::mt19937 random_{20261122};
};

} // namespace

TEST_CASE("a storm of edits, half of them broken, leaves nothing behind") {
    EditedArchive archive;
    Player& player = archive.open();
    Storm storm(archive);
    const int edits = editsOfStorm();
    const auto objects = [&] { return player.metrics()["memory"]["gl_objects"].get<int>(); };
    int mostObjects = objects();
    const int firstObjects = mostObjects;
    const long files = openFiles();
    double megabytes = 0;
    int good = 0, bad = 0;
    for (int i = 0; i < edits; ++i) {
        CAPTURE(i);
        storm.edit();
        player.controller().view.phi += 0.03;
        const ReloadReport report = player.reload();
        (report.good ? good : bad) += 1;
        REQUIRE(player.drawable());
        CHECK(player.frame());
        if (report.good) CHECK(player.problems().empty());
        if (!report.good) CHECK(!player.problems().empty());
        mostObjects = std::max(mostObjects, objects());
        if (i == edits / 4) megabytes = residentMegabytes();
    }
    CHECK(good > edits / 5);
    CHECK(bad > edits / 5);
    MESSAGE(edits, " edits, ", bad, " of them refused; at most ", mostObjects - firstObjects,
            " more OpenGL objects, ", residentMegabytes() - megabytes,
            " MB since a quarter of them");

    storm.mend();
    const ReloadReport mended = player.reload();
    for (const Diagnostic& diagnostic : player.problems())
        FAIL_CHECK(toString(diagnostic));
    CHECK(mended.good);
    const Image picture = archive.picture();
    CHECK(picture.bytes == archive.freshPicture().bytes);
    // A program that lacked a vertex stage for a while had one made that all programs share.
    CHECK(objects() <= firstObjects + 1);
    CHECK(openFiles() == files);
    CHECK(player.diagnostics().errors() == 0);
    // Allocators keep some; a version of the archive that stays for each edit would be far more.
    if (!kSanitized) CHECK(residentMegabytes() - megabytes < 64);
}
