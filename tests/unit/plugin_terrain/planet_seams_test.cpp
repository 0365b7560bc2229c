// SPDX-License-Identifier: BSD-3-Clause
#include "core/files.h"
#include "plugin_terrain/planet_cube.h"
#include "plugin_terrain/terrain_fixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

using namespace terrane;
using terrane::test::TerrainFixture;
using terrane::test::toPlanet;

namespace {

constexpr float kRadius = 6360000;
constexpr int kWidth = 101;    // of elevation tiles
constexpr int kN = kWidth - 5; // texels along the edge of a quad
constexpr int kCell = 4;       // texels along the edge of a mesh cell
constexpr const char* kNoise = "3000,1800,-900,700,500,-250,120,60,30,15";

/// Six faces that share their caches.
/// @param upsample the program of face f; "F" stands for its number
std::string planet(const std::string& upsample) {
    const auto cache = [](const char* name, int tileSize, const char* format) {
        return std::string("<tileCache name=\"") + name +
               "\" scheduler=\"scheduler\"><gpuTileStorage tileSize=\"" + std::to_string(tileSize) +
               "\" nTiles=\"1000\" " + format +
               " type=\"FLOAT\" min=\"LINEAR\" mag=\"LINEAR\"/></tileCache>\n";
    };
    std::string text = cache("elevations", kWidth, "internalformat=\"RGB32F\" format=\"RGB\"") +
                       cache("normals", kWidth - 4, "internalformat=\"RG32F\" format=\"RG\"");
    for (int face = 1; face <= 6; ++face) {
        const std::string f = std::to_string(face);
        std::string program = upsample;
        if (const auto at = program.find('F'); at != std::string::npos) program.replace(at, 1, f);
        text += "<elevationProducer name=\"elevation" + f + "\" cache=\"elevations\" noise=\"" +
                kNoise + "\" upsampleProg=\"" + program + "\"/>\n<normalProducer name=\"normal" +
                f + "\" cache=\"normals\" elevations=\"elevation" + f + "\" deform=\"sphere\"/>\n";
    }
    return text;
}

std::string slopeNoise() {
    return planet("slope;") + "<module name=\"slope\" version=\"330\" source=\"upsample.glsl\" "
                              "options=\"SLOPE_NOISE,NO_CLAMP\"/>\n";
}

std::filesystem::path archiveFolder() {
    const char* const source = std::getenv("TERRANE_SOURCE");
    return std::filesystem::path(source ? source : ".") / "archives/planet";
}

/// The modules of archives/planet that make its relief.
std::string archiveRelief() {
    const auto archive = readFile(archiveFolder() / "archive.xml");
    REQUIRE(archive);
    std::string modules;
    for (std::size_t at = 0;
         (at = archive->find("<module name=\"relief", at)) != std::string::npos;) {
        constexpr std::string_view kEnd = "</module>";
        const std::size_t end = archive->find(kEnd, at) + kEnd.size();
        modules += archive->substr(at, end - at) + "\n";
        at = end;
    }
    return planet("reliefF;") + modules;
}

struct Relief {
    const char* name;
    std::string entries;
    double tolerance; ///< of elevations, metres: sums in a different order
};

/// A tile that touches the edge of its face, and which rows or columns are on it.
std::vector<TileId> tilesAtEdges(int level) {
    const int last = (1 << level) - 1;
    std::set<std::array<int, 2>> places;
    // All where there are few; else those at the ends of an edge and some between.
    for (const int i : level <= 3 ? std::set{0, 1, 2, 3, 4, 5, 6, 7}
                                  : std::set{0, 1, last / 3, last / 2, last - 1, last}) {
        if (i > last) continue;
        places.insert({{0, i}, {last, i}, {i, 0}, {i, last}});
        // Reversed edges have these in turn.
        if (level > 3)
            places.insert({{0, last - i}, {last, last - i}, {last - i, 0}, {last - i, last}});
    }
    std::vector<TileId> tiles;
    for (const auto& [tx, ty] : places)
        tiles.push_back({level, tx, ty});
    return tiles;
}

using Key = std::array<int, 3>;

/// Calls visit(texel i, k of the quad, place on the cube) for the texels on the edges of a face.
template <class Visit>
void forEachEdgeTexel(int face, const TileId& id, Visit&& visit) {
    const int N = kN << id.level;
    for (int k = 0; k <= kN; ++k) {
        for (int i = 0; i <= kN; ++i) {
            const int x = 2 * (id.tx * kN + i) - N, y = 2 * (id.ty * kN + k) - N;
            if (std::abs(x) != N && std::abs(y) != N) continue;
            const glm::ivec3 p = toPlanet(face, glm::ivec3(x, y, N));
            visit(i, k, Key{p.x, p.y, p.z});
        }
    }
}

/// What faces say of the places of the cube's edges that they share.
template <class T>
struct Shared {
    std::map<Key, std::map<int, std::vector<T>>> places; ///< by face

    /// The largest difference between two faces, over all places that several faces told of.
    /// @param edges set to how many of the cube's edges have such places, `corners` of its corners
    template <class Distance>
    double worst(Distance&& distance, int& edges, int& corners) const {
        double result = 0;
        std::set<std::array<int, 3>> edgesSeen;
        corners = 0;
        for (const auto& [key, faces] : places) {
            if (faces.size() < 2) continue;
            const T& first = faces.begin()->second.front();
            for (const auto& [face, values] : faces)
                for (const T& value : values)
                    result = std::max(result, distance(first, value));
            const int N = std::max({std::abs(key[0]), std::abs(key[1]), std::abs(key[2])});
            std::array<int, 3> edge{};
            for (int c = 0; c < 3; ++c)
                if (std::abs(key[c]) == N) edge[c] = key[c] / N;
            const int ones = std::abs(edge[0]) + std::abs(edge[1]) + std::abs(edge[2]);
            if (ones == 2) edgesSeen.insert(edge);
            if (ones == 3 && faces.size() == 3) ++corners;
        }
        edges = static_cast<int>(edgesSeen.size());
        return result;
    }
};

glm::dvec3 planetNormal(int face, const TileId& id, const glm::vec4& texel) {
    const TileCoordinates quad = tileCoordinates(id, 2 * kRadius);
    const glm::dvec3 up =
        glm::normalize(glm::dvec3(quad.ox + quad.size / 2, quad.oy + quad.size / 2, kRadius));
    const glm::dvec3 east = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), up));
    const glm::dvec2 n(texel.x, texel.y);
    return toPlanet(face,
                    n.x * east + n.y * glm::cross(up, east) + std::sqrt(1 - glm::dot(n, n)) * up);
}

} // namespace

TEST_CASE("Heights and normals agree along the twelve edges and at the eight corners of a planet") {
    const Relief reliefs[] = {{"plain noise", planet("upsampleShader;"), 0},
                              {"noise by slope", slopeNoise(), 1e-3},
                              {"archives/planet", archiveRelief(), 1e-3}};
    for (const Relief& relief : reliefs) {
        CAPTURE(std::string(relief.name));
        TerrainFixture f;
        f.write("relief.glsl", *readFile(archiveFolder() / "relief.glsl"));
        f.open(relief.entries);
        double highest = 0;
        for (const int level : {0, 1, 2, 5, 9}) {
            CAPTURE(level);
            Shared<glm::dvec3> heights, normals;
            for (int face = 1; face <= 6; ++face) {
                TileProducer* const producer = f.producer("normal" + std::to_string(face));
                TileProducer* const elevations = f.producer("elevation" + std::to_string(face));
                REQUIRE(producer);
                producer->setRootQuadSize(2 * kRadius);
                for (const TileId& id : tilesAtEdges(level)) {
                    const auto normalTexels = f.texels(f.make(*producer, id));
                    const auto texels = f.texels(*elevations->findTile(id, true, true));
                    forEachEdgeTexel(face, id, [&](int i, int k, const Key& key) {
                        const auto at = static_cast<std::size_t>((k + 2) * kWidth + i + 2);
                        glm::dvec3 height(texels[at]);
                        if (i % kCell != 0 || k % kCell != 0) height.y = 0; // at vertices only
                        heights.places[key][face].push_back(height);
                        highest = std::max(highest, std::abs(double(texels[at].x)));
                        const auto normal = static_cast<std::size_t>(k * (kWidth - 4) + i);
                        normals.places[key][face].push_back(
                            planetNormal(face, id, normalTexels[normal]));
                    });
                }
            }
            int edges = 0, corners = 0;
            const auto distance = [](const glm::dvec3& a, const glm::dvec3& b) {
                const glm::dvec3 d = glm::abs(a - b);
                return std::max({d.x, d.y, d.z});
            };
            CHECK(heights.worst(distance, edges, corners) <= relief.tolerance);
            CHECK(edges == 12);
            CHECK(corners == 8);
            // Single precision of heights of kilometres, a texel apart.
            CHECK(normals.worst(distance, edges, corners) <= 1e-4);
        }
        CHECK(highest > 1000);
    }
}
