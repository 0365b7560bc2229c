// SPDX-License-Identifier: BSD-3-Clause
#include "plugin_terrain/elevation_oracle.h"
#include "plugin_terrain/terrain_fixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

using namespace terrane;
using terrane::test::ElevationOracle;
using terrane::test::TerrainFixture;

namespace {

struct Format {
    const char* name;
    const char* channels;
    const char* type;
    bool isUnsigned;
    bool fourChannels;
    double tolerance; ///< half a step of the format, and rounding
};

const Format kFormats[] = {
    {"RG8", "RG", "UNSIGNED_BYTE", true, false, 1.05 / 255},
    {"RGBA8", "RGBA", "UNSIGNED_BYTE", true, true, 1.05 / 255},
    {"RG16F", "RG", "HALF", false, false, 1.01 / 2048},
    {"RGBA32F", "RGBA", "FLOAT", false, true, 2e-5},
};

std::string archive(const Format& format, double roundness = 0) {
    return std::string("<tileCache name=\"elevationCache\" scheduler=\"scheduler\">"
                       "<gpuTileStorage tileSize=\"53\" nTiles=\"80\" internalformat=\"RGB32F\" "
                       "format=\"RGB\" type=\"FLOAT\" min=\"LINEAR\" mag=\"LINEAR\"/></tileCache>\n"
                       "<tileCache name=\"normalCache\" scheduler=\"scheduler\">"
                       "<gpuTileStorage tileSize=\"49\" nTiles=\"80\" internalformat=\"") +
           format.name + "\" format=\"" + format.channels + "\" type=\"" + format.type +
           "\" min=\"LINEAR\" mag=\"LINEAR\"/></tileCache>\n"
           "<elevationProducer name=\"elevations\" cache=\"elevationCache\" face=\"1\" "
           "noise=\"3000,-1500,700,350,-170,80,40\"/>\n"
           "<normalProducer name=\"normals\" cache=\"normalCache\" elevations=\"elevations\"" +
           (roundness > 0 ? " deform=\"sphere\"" : "") + "/>\n";
}

glm::dvec2 decoded(const Format& format, double x, double y) {
    return format.isUnsigned ? glm::dvec2(2 * x - 1, 2 * y - 1) : glm::dvec2(x, y);
}

constexpr int kWidth = 49; // of normal tiles; elevation tiles have 2 more on each side
constexpr int kCell = 2;   // texels of a mesh cell

const std::vector<TileId> kTiles{{0, 0, 0}, {1, 1, 0},   {2, 2, 1},
                                 {3, 5, 3}, {5, 21, 13}, {2, 0, 3}};

double elevation(const std::vector<glm::vec4>& texels, int i, int k) {
    return texels[static_cast<std::size_t>(k + 2) * (kWidth + 4) + i + 2].z;
}

// Normals of a quad of a sphere, from positions in double precision; in the frame of its centre.
class SphereOracle {
public:
    SphereOracle(const TileId& tile, double radius)
        : radius_(radius)
        , quad_(tileCoordinates(tile, 2 * radius)) {
        const glm::dvec3 up = glm::normalize(
            glm::dvec3(quad_.ox + quad_.size / 2, quad_.oy + quad_.size / 2, radius));
        const glm::dvec3 east = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), up));
        frame_ = {east, glm::cross(up, east), up};
    }
    glm::dvec2 normal(const std::vector<glm::vec4>& texels, int i, int k) const {
        const glm::dvec3 n =
            glm::normalize(glm::cross(at(texels, i + 1, k) - at(texels, i - 1, k),
                                      at(texels, i, k + 1) - at(texels, i, k - 1)));
        return {glm::dot(n, frame_[0]), glm::dot(n, frame_[1])};
    }

private:
    glm::dvec3 at(const std::vector<glm::vec4>& texels, int i, int k) const {
        const double step = quad_.size / (kWidth - 1);
        // Beyond the edge of the face the grid goes on around the edge of the cube.
        glm::dvec3 p(quad_.ox + i * step, quad_.oy + k * step, radius_);
        for (double* const x : {&p.x, &p.y}) {
            const double beyond = std::abs(*x) - radius_;
            if (beyond <= 1e-6 * step) continue;
            *x = std::copysign(radius_, *x);
            p.z -= beyond;
        }
        return glm::normalize(p) * (radius_ + elevation(texels, i, k));
    }

    double radius_;
    TileCoordinates quad_;
    std::array<glm::dvec3, 3> frame_;
};

} // namespace

TEST_CASE("Normals of a flat terrain are those of its elevations") {
    for (const Format& format : kFormats) {
        CAPTURE(std::string(format.name));
        TerrainFixture f;
        f.open(archive(format));
        TileProducer* const normals = f.producer("normals");
        TileProducer* const elevations = f.producer("elevations");
        REQUIRE(normals);
        normals->setRootQuadSize(80000);
        CHECK(elevations->rootQuadSize() == 80000);
        for (const TileId& id : kTiles) {
            CAPTURE(id.level);
            const auto texels = f.texels(f.make(*normals, id));
            const auto heights = f.texels(*elevations->findTile(id, true, true));
            ElevationOracle::Tile tile(kWidth + 4);
            for (int k = 0; k < kWidth + 4; ++k)
                for (int i = 0; i < kWidth + 4; ++i)
                    tile.at(i, k).zm = elevation(heights, i - 2, k - 2);
            const double size = tileCoordinates(id, 80000).size;
            double worst = 0;
            for (int k = 0; k < kWidth; ++k) {
                for (int i = 0; i < kWidth; ++i) {
                    const glm::vec4& t = texels[static_cast<std::size_t>(k) * kWidth + i];
                    const auto expected = ElevationOracle::normal(tile, i, k, size);
                    const glm::dvec2 n = decoded(format, t.x, t.y);
                    worst =
                        std::max({worst, std::abs(n.x - expected[0]), std::abs(n.y - expected[1])});
                }
            }
            CHECK(worst <= format.tolerance);
        }
    }
}

TEST_CASE("With four channels a normal tile has what its parent shows there, too") {
    for (const Format& format : {kFormats[1], kFormats[3]}) {
        CAPTURE(std::string(format.name));
        TerrainFixture f;
        f.open(archive(format));
        TileProducer* const normals = f.producer("normals");
        REQUIRE(normals);
        normals->setRootQuadSize(80000);
        for (const TileId& id : {TileId{1, 1, 0}, TileId{3, 5, 2}, TileId{4, 9, 15}}) {
            const auto texels = f.texels(f.make(*normals, id));
            const auto parent = f.texels(f.make(*normals, id.parent()));
            const int dx = id.tx % 2 * (kWidth / 2), dy = id.ty % 2 * (kWidth / 2);
            double worst = 0;
            for (int k = 0; k < kWidth; ++k) {
                for (int i = 0; i < kWidth; ++i) {
                    const auto vertex = [&](int x, int y) {
                        const std::size_t row = static_cast<std::size_t>(dy + y);
                        const glm::vec4& t = parent[row * kWidth + dx + x];
                        return decoded(format, t.x, t.y);
                    };
                    const int x0 = i / 2, x1 = (i + 1) / 2;
                    const int y0 = k / 2, y1 = (k + 1) / 2;
                    const glm::dvec2 expected = 0.5 * (vertex(x1, y0) + vertex(x0, y1));
                    const glm::vec4& t = texels[static_cast<std::size_t>(k) * kWidth + i];
                    const glm::dvec2 n = decoded(format, t.z, t.w);
                    worst =
                        std::max({worst, std::abs(n.x - expected.x), std::abs(n.y - expected.y)});
                }
            }
            CHECK(worst <= format.tolerance);
        }
    }
}

TEST_CASE(
    "Normals of a planet are those of the deformed ground, in the frame of the tile's centre") {
    for (const double radius : {60000.0, 6360000.0}) {
        CAPTURE(radius);
        TerrainFixture f;
        f.open(archive(kFormats[3], radius));
        TileProducer* const normals = f.producer("normals");
        TileProducer* const elevations = f.producer("elevations");
        REQUIRE(normals);
        normals->setRootQuadSize(static_cast<float>(2 * radius));
        for (const TileId& id : {TileId{0, 0, 0}, TileId{1, 1, 0}, TileId{2, 0, 3}, TileId{3, 5, 3},
                                 TileId{5, 30, 13}, TileId{7, 100, 3}, TileId{14, 9000, 3001}}) {
            CAPTURE(id.level);
            const auto texels = f.texels(f.make(*normals, id));
            const auto heights = f.texels(*elevations->findTile(id, true, true));
            const SphereOracle oracle(id, radius);
            double worst = 0;
            for (int k = 0; k < kWidth; ++k) {
                for (int i = 0; i < kWidth; ++i) {
                    const glm::vec4& t = texels[static_cast<std::size_t>(k) * kWidth + i];
                    const glm::dvec2 expected = oracle.normal(heights, i, k);
                    worst =
                        std::max({worst, std::abs(t.x - expected.x), std::abs(t.y - expected.y)});
                }
            }
            CHECK(worst <= 1e-5); // floats: the tallest differences are of some kilometres
        }
    }
}
