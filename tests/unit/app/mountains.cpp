// SPDX-License-Identifier: BSD-3-Clause
#include "mountains.h"

#include "resource/manager.h"
#include "terrain/terrain_node.h"

namespace terrane {

Mountains::Mountains(const MountainEdits& edits, PlayerOptions options)
    : player_(standardRegistry(), write(edits, std::move(options))) {}

PlayerOptions Mountains::write(const MountainEdits& edits, PlayerOptions options) {
    const std::filesystem::path original = exampleArchive("mountains");
    TextEdits all{{"<callMethod name=\"sky.draw\"/>", ""},
                  {"<sequence name=\"drawFrame\">",
                   "<sequence name=\"drawFrame\"><setState clearColor=\"true\">"
                   "<clear r=\"1\" g=\"0\" b=\"1\" a=\"1\"/></setState>"}};
    all.insert(all.end(), edits.archive.begin(), edits.archive.end());
    folder_.write("archive.xml", edited(original / "archive.xml", all));
    folder_.write("ground.glsl", edited(original / "ground.glsl", edits.ground));
    options.archive = folder_.path();
    options.paths = {original};
    options.width = 320;
    options.height = 240;
    options.debug = true;
    return options;
}

double Mountains::groundBelowCamera() {
    const glm::dvec3 camera = player_.controller().position();
    const auto place = player_.placeAt(camera.x, camera.y);
    REQUIRE(place);
    const auto found = player_.elevationAt(*place);
    REQUIRE(found);
    return found->elevation;
}

void Mountains::followGround() {
    if (player_.frames() == 0) return;
    const double ground = groundBelowCamera();
    player_.controller().groundHeight = ground;
    player_.resources()->get<TerrainNode>("groundTerrain")->setGroundHeight(ground);
}

} // namespace terrane
