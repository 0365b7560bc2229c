// SPDX-License-Identifier: BSD-3-Clause
#include "planet.h"

#include "core/files.h"

#include <cstdlib>

namespace terrane {

namespace {

std::filesystem::path original() {
    const char* const source = std::getenv("TERRANE_SOURCE");
    return std::filesystem::path(source ? source : ".") / "archives/planet";
}

std::string edited(const std::string& file, const PlanetEdits::Edits& edits) {
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
    PlanetEdits::Edits all{{"<callMethod name=\"sky.draw\"/>", ""},
                           {"<sequence name=\"drawFrame\">",
                            "<sequence name=\"drawFrame\"><setState clearColor=\"true\">"
                            "<clear r=\"1\" g=\"0\" b=\"1\" a=\"1\"/></setState>"}};
    all.insert(all.end(), edits.archive.begin(), edits.archive.end());
    folder_.write("archive.xml", edited("archive.xml", all));
    folder_.write("ground.glsl", edited("ground.glsl", edits.ground));
    folder_.write("relief.glsl", edited("relief.glsl", edits.relief));
    options.archive = folder_.path();
    options.paths = {original()};
    return options;
}

void Planet::draw(const View& degrees) {
    TerrainViewController& controller = player_.controller();
    controller.view = controller.fromDegrees(degrees);
    REQUIRE(player_.frame());
}

} // namespace terrane
