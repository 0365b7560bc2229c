// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "archive_folder.h"
#include "crack_finder.h"

#include "app/player.h"

#include <string>
#include <utility>
#include <vector>

namespace terrane {

/// archives/planet, changed by a test: a text of one of its files, and what stands there instead. A
/// text that is not there fails the test.
struct PlanetEdits {
    using Edits = std::vector<std::pair<std::string, std::string>>;
    Edits archive;
    Edits ground;
    Edits relief;
};

/// The planet without its sky, in front of one colour, and a player that draws it small.
class Planet {
public:
    static constexpr double kRadius = 6360000;
    static constexpr Colour kBackground{255, 0, 255};

    /// @param options the archive is set here, and the size if none is given
    explicit Planet(const PlanetEdits& edits = {}, PlayerOptions options = small());

    Player& player() { return player_; }
    /// Draws a frame from a view in degrees.
    void draw(const View& degrees);
    Gaps gaps() { return findGaps(player_.capture(), kBackground); }

    static PlayerOptions small();

private:
    PlayerOptions write(const PlanetEdits& edits, PlayerOptions options);

    ArchiveFolder folder_;
    Player player_;
};

} // namespace terrane
