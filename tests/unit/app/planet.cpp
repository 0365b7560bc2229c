// SPDX-License-Identifier: BSD-3-Clause
#include "planet.h"

namespace terrane {

Planet::Planet(const PlanetEdits& edits, PlayerOptions options)
    : player_(standardRegistry(), write(edits, std::move(options))) {}

PlayerOptions Planet::small() {
    PlayerOptions options;
    options.width = 320;
    options.height = 240;
    options.debug = true;
    return options;
}

PlayerOptions Planet::write(const PlanetEdits& edits, PlayerOptions options) {
    TextEdits all{{"<callMethod name=\"sky.draw\"/>", ""},
                  {"<sequence name=\"drawFrame\">",
                   "<sequence name=\"drawFrame\"><setState clearColor=\"true\">"
                   "<clear r=\"1\" g=\"0\" b=\"1\" a=\"1\"/></setState>"}};
    all.insert(all.end(), edits.archive.begin(), edits.archive.end());
    const std::filesystem::path original = exampleArchive("planet");
    folder_.write("archive.xml", edited(original / "archive.xml", all));
    folder_.write("ground.glsl", edited(original / "ground.glsl", edits.ground));
    folder_.write("relief.glsl", edited(original / "relief.glsl", edits.relief));
    options.archive = folder_.path();
    options.paths = {original};
    return options;
}

void Planet::draw(const View& degrees) {
    TerrainViewController& controller = player_.controller();
    controller.view = controller.fromDegrees(degrees);
    REQUIRE(player_.frame());
}

} // namespace terrane
