// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "archive_folder.h"
#include "sanitized.h"

#include "app/player.h"
#include "resource/manager.h"
#include "terrain/terrain_node.h"

#include <string>
#include <utility>
#include <vector>

namespace terrane {

/// Of flights; shorter where everything takes longer.
inline constexpr int kFlightFrames = kSanitized ? 30 : 150;

/// Small terrains with a tileSamplerZ for each, and a player that draws them small, without a
/// script.
class Hills {
public:
    enum class Shape { flat, planet, cylinder };
    using Edits = std::vector<std::pair<std::string, std::string>>;

    /// Radius of the planet and of the cylinder; half the edge of the flat one. Metres.
    static constexpr double kPlanetRadius = 20000, kCylinderRadius = 1500, kFlatSize = 1000;
    static constexpr int kTileSize = 29;
    /// Of the noise of the elevations, by level, metres.
    static const std::vector<double> kAmplitudes;
    /// Of the flat one, degrees: near the ground, from above, up into the sky.
    static const std::vector<View> kViews;

    /// @param edits texts of the archive and what stands there instead, wherever it occurs; each
    ///        must be there
    explicit Hills(Shape shape = Shape::flat, const Edits& edits = {}, PlayerOptions options = {});

    Player& player() { return player_; }
    TerrainViewController& controller() { return player_.controller(); }
    /// @param face of the planet, 1 to 6
    TerrainNode& terrain(int face = 1);
    /// Degrees, as scripts say it.
    void look(const View& degrees) { controller().view = controller().fromDegrees(degrees); }
    /// What a frame took for the height of the ground, of one that is drawn without measuring it.
    void assumeGround(double height);

private:
    PlayerOptions write(Shape shape, const Edits& edits, PlayerOptions options);

    ArchiveFolder folder_;
    Player player_;
};

} // namespace terrane
