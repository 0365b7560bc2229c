// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "archive_edits.h"
#include "archive_folder.h"
#include "crack_finder.h"

#include "app/player.h"

#include <utility>

namespace terrane {

/// archives/mountains, changed by a test: a text of its archive.xml, or of ground.glsl, and what
/// stands there instead. A text that is not there fails the test.
struct MountainEdits {
    TextEdits archive;
    TextEdits ground;
};

/// The mountains without their sky, in front of one colour, and a player that draws them small.
class Mountains {
public:
    static constexpr Colour kBackground{255, 0, 255};

    /// @param options the archive and the size are set here
    explicit Mountains(const MountainEdits& edits = {}, PlayerOptions options = {});

    Player& player() { return player_; }

    /// Height of the relief below the camera, by the finest elevation tile that is there; metres.
    double groundBelowCamera();
    /// Has the next frame take it for the height of the ground, however the camera got there.
    void followGround();

    Gaps gaps() { return findGaps(player_.capture(), kBackground); }

private:
    PlayerOptions write(const MountainEdits& edits, PlayerOptions options);

    ArchiveFolder folder_;
    Player player_;
};

} // namespace terrane
