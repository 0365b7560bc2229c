// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "archive_edits.h"
#include "archive_folder.h"
#include "crack_finder.h"

#include "app/player.h"

namespace terrane {

/// What a test changes in the files of archives/planet.
struct PlanetEdits {
    TextEdits archive;
    TextEdits ground;
    TextEdits relief;
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
