// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/tile_sampler_z.h"

#include "hills.h"
#include "plugin_terrain/elevation_oracle.h"
#include "producer/tile_producer.h"
#include "render/context.h"
#include "scene/scene_manager.h"
#include "terrain/spherical_deformation.h"
#include "tools/terrane/allocation_counter.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <vector>

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

using namespace terrane;
using terrane::test::ElevationOracle;

namespace {

ElevationOracle makeOracle() {
    return ElevationOracle({.tileSize = Hills::kTileSize,
                            .gridSize = 24,
                            .face = 1, // by the name of the producer
                            .clamp = true,
                            .amplitudes = Hills::kAmplitudes});
}

/// The height of the mesh elevations between texels.
double heightOf(ElevationOracle& oracle, int level, const glm::dvec2& local) {
    const double count = std::exp2(level);
    const glm::dvec2 scaled = (local / (2 * Hills::kFlatSize) + 0.5) * count;
    const glm::dvec2 quad = glm::min(glm::floor(scaled), glm::dvec2(count - 1));
    const ElevationOracle::Tile& tile =
        oracle.tile(level, static_cast<int>(quad.x), static_cast<int>(quad.y));
    const glm::dvec2 texel = (scaled - quad) * double(Hills::kTileSize - 5) + 2.0;
    const int i = static_cast<int>(texel.x), k = static_cast<int>(texel.y);
    const double fx = texel.x - i, fy = texel.y - k;
    const auto z = [&](int dx, int dy) { return tile.clamped(i + dx, k + dy).zm; };
    return glm::mix(glm::mix(z(0, 0), z(1, 0), fx), glm::mix(z(0, 1), z(1, 1), fx), fy);
}

/// Lowest and highest of what is drawn for a quad.
std::pair<double, double> rangeOf(ElevationOracle& oracle, const TerrainQuad& quad) {
    const ElevationOracle::Tile& tile = oracle.tile(quad.level, quad.tx, quad.ty);
    std::pair<double, double> range{1e9, -1e9};
    for (int k = 2; k < tile.width() - 2; ++k)
        for (int i = 2; i < tile.width() - 2; ++i)
            for (const double z : {tile.at(i, k).zc, tile.at(i, k).zm})
                range = {std::min(range.first, z), std::max(range.second, z)};
    return range;
}

template <class Visit>
void forEachQuad(const TerrainNode& terrain, Visit visit) {
    for (int i = 0; i < terrain.quads().capacity(); ++i)
        if (terrain.quads()[i].isAlive()) visit(terrain.quads()[i]);
}

int measuredQuads(const TerrainNode& terrain) {
    int count = 0;
    forEachQuad(terrain, [&](const TerrainQuad& quad) { count += quad.measured ? 1 : 0; });
    return count;
}

int visibleLeaves(const TerrainNode& terrain) {
    int count = 0;
    terrain.forEachLeaf([&](const TerrainQuad& quad) { count += quad.isVisible() ? 1 : 0; });
    return count;
}

/// Along the ground, through whatever stands in the way, and back high above it.
View flightAt(double t) {
    const double angle = 400 * t;
    return {.x0 = 700 * std::cos(t * 9),
            .y0 = 700 * std::sin(t * 7),
            .theta = 72 + 8 * std::sin(t * 20),
            .phi = angle,
            .d = 90 + 400 * std::pow(std::sin(t * 5), 8)};
}

struct Frame {
    double ground = 0;
    glm::dmat4 camera{1};
    Image picture;
};

/// Some frames of the flight; what each took for the ground, and shows.
std::vector<Frame> fly(Hills& hills, int frames) {
    REQUIRE(hills.player().load());
    std::vector<Frame> result;
    for (int i = 0; i < frames; ++i) {
        hills.look(flightAt(double(i) / kFlightFrames));
        const double ground = hills.controller().groundHeight;
        REQUIRE(hills.player().frame());
        result.push_back(
            {ground, hills.player().scene()->cameraToWorld(), hills.player().capture()});
    }
    for (const Diagnostic& diagnostic : hills.player().diagnostics().all())
        FAIL_CHECK(toString(diagnostic));
    return result;
}

/// Counts the reductions that the frames of a player run.
void countReadings(Player& player, std::atomic<int>& count) {
    player.scene()->scheduler()->setObserver([&count](const TaskRun& run) {
        if (run.task.name() == "ReadElevations") ++count;
    });
}

} // namespace

TEST_CASE("the ground below the camera is that of an independent computation") {
    Hills hills;
    REQUIRE(hills.player().load());
    ElevationOracle oracle = makeOracle();
    for (const View& view : Hills::kViews) {
        CAPTURE(view.x0);
        hills.look(view);
        REQUIRE(hills.player().drawUntilComplete());
        const glm::dvec3 camera = hills.controller().position();
        const auto place = hills.player().placeAt(camera.x, camera.y);
        REQUIRE(place);
        const auto found = hills.player().elevationAt(*place);
        REQUIRE(found);
        // Whether or not the camera looks down on it, the ground is as fine as the height asks.
        CHECK(found->level >= (view.d < 100 ? 6 : view.d < 500 ? 3 : 1));
        const double expected = heightOf(oracle, found->level, glm::dvec2(camera));
        CHECK(found->elevation == doctest::Approx(expected).epsilon(1e-4));
        // The last sample may have been taken up to 1/32 texel away; slopes are below 10.
        const double texel = 2 * Hills::kFlatSize / std::exp2(found->level) / 24;
        CHECK(std::abs(hills.terrain().groundHeight() - expected) < texel / 32 * 10 + 0.01);
        CHECK(hills.controller().groundHeight == hills.terrain().groundHeight());
        CHECK(camera.z >= hills.terrain().groundHeight() + 1 - 1e-9);
        CHECK(hills.terrain().state().groundHeight == hills.terrain().groundHeight());
    }
}

TEST_CASE("quads get the bounds of what is drawn of them") {
    Hills hills;
    REQUIRE(hills.player().load());
    ElevationOracle oracle = makeOracle();
    for (const View& view : Hills::kViews) {
        CAPTURE(view.x0);
        hills.look(view);
        REQUIRE(hills.player().drawUntilComplete());
        int measured = 0, leaves = 0;
        forEachQuad(hills.terrain(), [&](const TerrainQuad& quad) {
            leaves += quad.isLeaf() && quad.isVisible();
            if (quad.isLeaf() && quad.isVisible()) CHECK(quad.measured);
            if (!quad.measured) return;
            ++measured;
            const auto [zmin, zmax] = rangeOf(oracle, quad);
            CHECK(std::abs(quad.zmin - zmin) < 0.01);
            CHECK(std::abs(quad.zmax - zmax) < 0.01);
        });
        CHECK(measured >= leaves);
    }
}

TEST_CASE("what is not measured keeps its ground within what it inherits") {
    Hills hills;
    fly(hills, kFlightFrames / 3);
    ElevationOracle oracle = makeOracle();
    int checked = 0;
    for (const View& view : Hills::kViews) {
        hills.look(view);
        for (int i = 0; i < 3; ++i) {
            hills.player().frame();
            forEachQuad(hills.terrain(), [&](const TerrainQuad& quad) {
                if (quad.measured) return;
                const auto [zmin, zmax] = rangeOf(oracle, quad);
                ++checked;
                CHECK(zmin >= quad.zmin - 0.01);
                CHECK(zmax <= quad.zmax + 0.01);
            });
        }
    }
    CHECK(checked > 100);
}

TEST_CASE("answers come in the fourth frame after a tile was made, sixteen at a time") {
    Hills hills;
    Player& player = hills.player();
    REQUIRE(player.load());
    hills.look(Hills::kViews[1]);
    std::atomic<int> readings = 0;
    countReadings(player, readings);
    std::vector<int> measured;
    std::vector<bool> ground;
    for (int i = 0; i < 8; ++i) {
        REQUIRE(player.frame());
        measured.push_back(measuredQuads(hills.terrain()));
        ground.push_back(hills.terrain().groundSample().has_value());
    }
    // Frame 0 makes tiles, frame 1 finds them done and reads, frame 4 has the answers.
    CHECK(std::vector<int>(measured.begin(), measured.begin() + 4) == std::vector<int>(4, 0));
    // But for the ground below the camera nobody waits: it is read at once after a jump.
    CHECK(ground[0]);
    CHECK(measured[4] == ElevationReadback::kMost - 1); // the ground below the camera was one
    for (std::size_t i = 5; i < measured.size(); ++i)
        CHECK(measured[i] <= measured[i - 1] + ElevationReadback::kMost);
    CHECK(readings.load() >= 4); // never two a frame
    CHECK(readings.load() <= 7);
    CHECK_FALSE(player.complete());
    REQUIRE(player.drawUntilComplete());
    CHECK(player.frames() > measured[7] / ElevationReadback::kMost);
}

TEST_CASE("a still picture reads nothing back and allocates nothing") {
    Hills hills(Hills::Shape::flat, {}, {.recordFrames = true, .allocations = countedAllocations});
    Player& player = hills.player();
    REQUIRE(player.load());
    hills.look(Hills::kViews[1]);
    REQUIRE(player.drawUntilComplete());
    std::atomic<int> readings = 0;
    countReadings(player, readings);
    const int measured = measuredQuads(hills.terrain());
    for (int i = 0; i < 5; ++i) {
        CHECK(player.frame());
        CHECK(player.counters().allocationsLastFrame == 0);
    }
    CHECK(readings.load() == 0);
    // Even one whose camera moves, above tiles that are there, allocates nothing.
    for (int i = 0; i < 10; ++i) {
        View view = Hills::kViews[1];
        view.x0 += 0.02 * i;
        hills.look(view);
        CHECK(player.frame());
        CHECK(player.counters().allocationsLastFrame == 0);
    }
    CHECK(readings.load() > 0);
    CHECK(measuredQuads(hills.terrain()) >= measured / 2);
}

TEST_CASE("tiles that are made again are read again") {
    Hills hills;
    Player& player = hills.player();
    REQUIRE(player.load());
    hills.look(Hills::kViews[0]);
    REQUIRE(player.drawUntilComplete());
    const int measured = measuredQuads(hills.terrain());
    const double ground = hills.terrain().groundHeight();
    const int frames = player.frames();
    std::atomic<int> readings = 0;
    countReadings(player, readings);
    player.resources()->get<TileProducer>("elevations1")->invalidateTiles();
    REQUIRE(player.frame());
    CHECK(measuredQuads(hills.terrain()) == 0); // even of quads without tiles: it may be wrong now
    REQUIRE(player.drawUntilComplete());
    CHECK(readings.load() >= measured / ElevationReadback::kMost);
    CHECK(player.frames() > frames + 4);
    CHECK(measuredQuads(hills.terrain()) >= measured - 2);
    CHECK(hills.terrain().groundHeight() == ground);
}

TEST_CASE("a sampler that a reload makes anew forgets what the one before it measured") {
    Hills hills;
    Player& player = hills.player();
    REQUIRE(player.load());
    for (const int view : {2, 0}) { // from above, and from the ground, which hides some of it
        hills.look(Hills::kViews[view]);
        REQUIRE(player.drawUntilComplete());
    }
    const TerrainNode* const terrain = &hills.terrain();
    REQUIRE(measuredQuads(*terrain) > 0);
    REQUIRE(player.set("elevations1", "noise", "100,80,60,30,15,8,4") == "");
    REQUIRE(player.frame());
    REQUIRE(&hills.terrain() == terrain);
    CHECK(measuredQuads(*terrain) == 0); // nor of quads that have no tile
    REQUIRE(player.drawUntilComplete());
    CHECK(measuredQuads(*terrain) > 0);
}

TEST_CASE("nothing visible is left out because of what was measured") {
    // The same flight, with measured bounds and without.
    Hills measuring;
    const std::vector<Frame> actual = fly(measuring, kFlightFrames);
    Hills plain(Hills::Shape::flat, {{"tileSamplerZ", "tileSampler"}});
    REQUIRE(plain.player().load());
    int fewer = 0, compared = 0;
    for (int i = 0; i < kFlightFrames; ++i) {
        CAPTURE(i);
        plain.look(flightAt(double(i) / kFlightFrames));
        plain.assumeGround(actual[i].ground);
        REQUIRE(plain.player().frame());
        // Unless ground that may be higher has lifted the camera.
        if (plain.player().scene()->cameraToWorld() != actual[i].camera) continue;
        ++compared;
        CHECK(plain.player().capture().bytes == actual[i].picture.bytes);
    }
    CHECK(compared > kFlightFrames / 5);
    // Still views too, where all bounds are known.
    for (const View& view : Hills::kViews) {
        CAPTURE(view.x0);
        measuring.look(view);
        REQUIRE(measuring.player().drawUntilComplete());
        plain.look(view);
        for (int i = 0; i < 2; ++i) {
            plain.assumeGround(measuring.terrain().groundHeight());
            REQUIRE(plain.player().frame());
        }
        CHECK(plain.player().capture().bytes == measuring.player().capture().bytes);
        const int left = visibleLeaves(measuring.terrain());
        CHECK(left <= visibleLeaves(plain.terrain()));
        fewer += left < visibleLeaves(plain.terrain()) ? 1 : 0;
    }
    CHECK(fewer > 2);
}

TEST_CASE("ground that nothing seen so far was as rough as is not left out of a picture") {
    // Fine levels are far rougher than the coarse ones, of which the margins come.
    const std::string noise = "noise='100,-80,60,30,15,8,4'", rough = "noise='60,-1,1,1,1,1,70'";
    Hills measuring(Hills::Shape::flat, {{noise, rough}});
    REQUIRE(measuring.player().load());
    Hills plain(Hills::Shape::flat, {{noise, rough}, {"tileSamplerZ", "tileSampler"}});
    REQUIRE(plain.player().load());
    for (int i = 0; i < 9; ++i) { // from so high that they are all there is
        measuring.look({.x0 = -600.0 + 600 * (i % 3), .y0 = -600.0 + 600 * (i / 3), .d = 300});
        REQUIRE(measuring.player().drawUntilComplete());
    }
    int doubts = 0;
    for (int i = 0; i < 8; ++i) {
        CAPTURE(i);
        const View view{.x0 = -600.0 + 150 * i, .y0 = 40, .theta = 80, .phi = 45.0 * i, .d = 60};
        measuring.look(view);
        for (int frame = 0; frame < 200 && !measuring.player().complete(); ++frame) {
            REQUIRE(measuring.player().frame());
            forEachQuad(measuring.terrain(), [&](const TerrainQuad& q) { doubts += q.doubtful; });
        }
        REQUIRE(measuring.player().complete());
        forEachQuad(measuring.terrain(), [&](const TerrainQuad& q) { CHECK_FALSE(q.doubtful); });
        plain.look(view);
        for (int frame = 0; frame < 2; ++frame) {
            plain.assumeGround(measuring.terrain().groundHeight());
            REQUIRE(plain.player().frame());
        }
        CHECK(plain.player().scene()->cameraToWorld() ==
              measuring.player().scene()->cameraToWorld());
        CHECK(plain.player().capture().bytes == measuring.player().capture().bytes);
    }
    CHECK(doubts > 0);
}

TEST_CASE("ground and picture are the same in each run, with any number of workers") {
    const int frames = kFlightFrames / 3;
    Hills first;
    const std::vector<Frame> expected = fly(first, frames);
    CHECK(std::any_of(expected.begin(), expected.end(),
                      [](const Frame& frame) { return frame.ground != 0; }));
    for (const char* workers : {"1", "0", "2", "4"}) {
        CAPTURE(workers);
        Hills hills(Hills::Shape::flat,
                    {{"nthreads=\"1\"", "nthreads=\"" + std::string(workers) + "\""}});
        const std::vector<Frame> actual = fly(hills, frames);
        for (std::size_t i = 0; i < actual.size(); ++i) {
            CAPTURE(i);
            CHECK(actual[i].ground == expected[i].ground);
            CHECK(actual[i].picture.bytes == expected[i].picture.bytes);
        }
    }
}

TEST_CASE("two players side by side don't know of each other's ground") {
    Hills alone;
    const std::vector<Frame> expected = fly(alone, kFlightFrames / 3);
    Hills one;
    Hills other(Hills::Shape::flat, {{"noise='100,", "noise='300,"}});
    REQUIRE(one.player().load());
    REQUIRE(other.player().load());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CAPTURE(i);
        one.look(flightAt(double(i) / kFlightFrames));
        other.look(flightAt(double(i) / kFlightFrames));
        CHECK(one.controller().groundHeight == expected[i].ground);
        REQUIRE(one.player().frame());
        REQUIRE(other.player().frame());
        CHECK(one.player().capture().bytes == expected[i].picture.bytes);
    }
    CHECK(one.terrain().groundHeight() != other.terrain().groundHeight());
}

TEST_CASE("on a planet the ground is that of the face below the camera, and all faces know") {
    Hills hills(Hills::Shape::planet);
    Player& player = hills.player();
    REQUIRE(player.load());
    // The middles of the faces (terrain reference 2.2), and places near edges and a corner.
    const std::map<int, glm::dvec2> middles{{1, {0, 90}}, {2, {-90, 0}}, {3, {0, 0}},
                                            {4, {90, 0}}, {5, {180, 0}}, {6, {0, -90}}};
    int high = 0;
    for (const auto& [face, middle] : middles) {
        for (const glm::dvec2 off : {glm::dvec2(7, -8), glm::dvec2(-44, 3), glm::dvec2(40, 30)}) {
            CAPTURE(face);
            glm::dvec2 at = middle + off;
            at.y = std::clamp(at.y, -88.0, 88.0);
            CAPTURE(at.x);
            CAPTURE(at.y);
            hills.look({.x0 = at.x, .y0 = at.y, .theta = 75, .phi = 40, .d = 300});
            REQUIRE(player.drawUntilComplete());
            const glm::dvec3 camera = hills.controller().position();
            const double longitude = glm::degrees(std::atan2(camera.y, camera.x));
            const double latitude = glm::degrees(std::asin(camera.z / glm::length(camera)));
            const auto place = player.placeAt(longitude, latitude);
            REQUIRE(place);
            if (off.x == 7) CHECK(place->terrain == &hills.terrain(face));
            const auto found = player.elevationAt(*place);
            REQUIRE(found);
            CHECK(found->level >= 5);
            const double ground = place->terrain->groundHeight();
            CHECK(std::abs(ground - found->elevation) < 0.5); // 1/32 texel of 14 m
            for (int other = 1; other <= 6; ++other)
                CHECK(hills.terrain(other).groundHeight() == ground);
            CHECK(hills.controller().groundHeight == ground);
            CHECK(glm::length(camera) >= Hills::kPlanetRadius + found->elevation + 0.4);
            high += ground > 1 ? 1 : 0;
        }
    }
    CHECK(high > 4);
    for (const Diagnostic& diagnostic : player.diagnostics().all())
        FAIL_CHECK(toString(diagnostic));
}

TEST_CASE("in a cylinder the ground is below the feet") {
    Hills hills(Hills::Shape::cylinder);
    Player& player = hills.player();
    REQUIRE(player.load());
    int high = 0;
    for (const double angle : {0.0, 12.0, -25.0, 31.0}) {
        CAPTURE(angle);
        hills.look({.x0 = 10 * angle, .y0 = angle, .theta = 60, .phi = 30, .d = 50});
        REQUIRE(player.drawUntilComplete());
        const glm::dvec3 camera = hills.controller().position();
        const glm::dvec3 local = hills.terrain().deformation().deformedToLocal(camera);
        const auto place = player.placeAt(local.x, local.y);
        REQUIRE(place);
        const auto found = player.elevationAt(*place);
        REQUIRE(found);
        CHECK(hills.terrain().groundHeight() == doctest::Approx(found->elevation).epsilon(0.02));
        CHECK(local.z > found->elevation);
        high += found->elevation > 1 ? 1 : 0;
    }
    CHECK(high > 1);
}

TEST_CASE("a view that asks for too many quads is told once, with the numbers") {
    Hills hills(Hills::Shape::flat,
                {{"splitFactor='2' maxLevel='6'", "splitFactor='1e9' maxLevel='30'"},
                 {"tileSamplerZ", "tileSampler"}});
    Player& player = hills.player();
    REQUIRE(player.load());
    hills.look({.x0 = 0, .y0 = 0, .theta = 180, .phi = 0, .d = 5}); // nothing to draw
    player.resources()->get<TerrainNode>("terrain1")->setSplitInvisibleQuads(true);
    for (int i = 0; i < 2; ++i)
        REQUIRE(player.frame());
    int told = 0;
    for (const Diagnostic& diagnostic : player.diagnostics().all()) {
        if (diagnostic.code != "too-many-quads") continue;
        ++told;
        CHECK(diagnostic.message.find("65536") != std::string::npos);
        CHECK(diagnostic.place);
    }
    CHECK(told == 1);
}
