// SPDX-License-Identifier: BSD-3-Clause
#include "mountains.h"

#include "producer/gpu_tile_storage.h"
#include "producer/tile_producer.h"
#include "resource/manager.h"
#include "scene/scene_manager.h"
#include "terrain/terrain_node.h"

#include <cmath>
#include <cstdlib>
#include <cstring>

namespace terrane {

namespace {

std::filesystem::path original() {
    const char* const source = std::getenv("TERRANE_SOURCE");
    return std::filesystem::path(source ? source : ".") / "archives/mountains";
}

std::string edited(const std::string& file, const MountainEdits::Edits& edits) {
    auto text = readFile(original() / file);
    REQUIRE(text);
    for (const auto& [before, after] : edits) {
        CAPTURE(before);
        const std::size_t at = text->find(before);
        REQUIRE(at != std::string::npos);
        text->replace(at, before.size(), after);
    }
    return *text;
}

} // namespace

Mountains::Mountains(const MountainEdits& edits, PlayerOptions options)
    : player_(standardRegistry(), write(edits, std::move(options))) {}

PlayerOptions Mountains::write(const MountainEdits& edits, PlayerOptions options) {
    MountainEdits::Edits all{{"<callMethod name=\"sky.draw\"/>", ""},
                             {"<sequence name=\"drawFrame\">",
                              "<sequence name=\"drawFrame\"><setState clearColor=\"true\">"
                              "<clear r=\"1\" g=\"0\" b=\"1\" a=\"1\"/></setState>"}};
    all.insert(all.end(), edits.archive.begin(), edits.archive.end());
    folder_.write("archive.xml", edited("archive.xml", all));
    folder_.write("ground.glsl", edited("ground.glsl", edits.ground));
    options.archive = folder_.path();
    options.paths = {original()};
    options.width = 320;
    options.height = 240;
    options.debug = true;
    return options;
}

double Mountains::groundBelowCamera() {
    auto& resources = *player_.resources();
    const auto terrain = resources.get<TerrainNode>("groundTerrain");
    const auto producer = resources.get<TileProducer>("elevation");
    REQUIRE(terrain);
    REQUIRE(producer);
    const glm::dvec3 camera = player_.controller().position();
    const double size = 2 * terrain->parameters().size;
    const glm::dvec2 place = glm::dvec2(camera) / size + 0.5; // in the root quad
    const Tile* finest = nullptr;
    for (int level = 0; level <= terrain->parameters().maxLevel; ++level) {
        const glm::dvec2 tile = glm::floor(place * std::exp2(level));
        const Tile* found = producer->findTile(
            {level, static_cast<int>(tile.x), static_cast<int>(tile.y)}, true, true);
        if (found) finest = found;
    }
    if (!finest) return 0;
    const auto& slot = finest->slot().as<GpuTileStorage::Slot>();
    const int border = producer->border();
    const int cells = producer->cache().storage().tileSize() - 2 * border - 1;
    const glm::dvec2 inTile = glm::fract(place * std::exp2(finest->id().level));
    const glm::ivec2 texel = border + glm::ivec2(glm::round(inTile * double(cells)));
    const auto bytes = slot.texture()->download(
        {.x = texel.x, .y = texel.y, .z = slot.layer(), .width = 1, .height = 1},
        {TransferFormat::red, TransferType::f32});
    float height = 0;
    std::memcpy(&height, bytes.data(), sizeof height);
    return height;
}

void Mountains::followGround() {
    const double ground = groundBelowCamera();
    player_.controller().groundHeight = ground;
    player_.resources()->get<TerrainNode>("groundTerrain")->setGroundHeight(ground);
}

} // namespace terrane
