// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/source.h"
#include "resource/resource.h"
#include "terrain/horizon_buffer.h"
#include "terrain/quad_pool.h"
#include "terrain/terrain_state.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

namespace terrane {

/// A terrain: a square with a quadtree that is finer near the camera. It holds no data of the
/// ground but the elevation bounds of quads; samplers and producers add these.
///
/// Once a frame update() subdivides the tree anew, without hysteresis: a quad is split when the
/// camera is nearer than splitDistance times its size, in local space. Leaves that touch differ by
/// at most one level as long as invisible quads are split, too. Not thread-safe: the thread that
/// updates also reads (terrain reference 1.4, 3.1).
class TerrainNode final : public Resource {
public:
    /// Beyond this, tile coordinates would not fit their integers.
    static constexpr int kDeepestLevel = 30;

    struct Parameters {
        double size = 1; ///< half the edge of the root quad, metres; the radius of a sphere
        double zmin = 0, zmax = 0;                      ///< bounds of all elevations, metres
        std::shared_ptr<const Deformation> deformation; ///< null: flat
        double splitFactor = 2;                         ///< see splitDistance()
        int maxLevel = 0;                               ///< of the deepest quads
        bool horizonCulling = true; ///< don't show quads hidden behind nearer ground
        /// A camera of a tiny field of view could ask for any number of quads; beyond this many
        /// none is split any more, and limitReached() tells.
        int maxQuads = 1 << 16; // ten times those of splitFactor 10
        Place splitFactorPlace; ///< for messages
    };

    explicit TerrainNode(Parameters parameters);
    /// Takes over what is known of the ground from an earlier version of this terrain, if it has
    /// the same shape.
    void inherit(const TerrainNode& previous);

    const Parameters& parameters() const { return parameters_; }
    const Deformation& deformation() const { return *parameters_.deformation; }

    /// Subdivides the tree for a view, and tells what is visible. False for a view that holds what
    /// is no number or can't be inverted: then the terrain is one invisible quad, and state() is
    /// that of the last good view.
    bool update(const TerrainView& view);
    const TerrainState& state() const { return state_; }
    bool limitReached() const { return limitReached_; }

    /// Split also what is outside of the view, for data that is needed there.
    bool splitInvisibleQuads() const { return splitInvisibleQuads_; }
    void setSplitInvisibleQuads(bool split) { splitInvisibleQuads_ = split; }
    /// Split also the quads that the camera is above, or will soon be, whether it looks down on
    /// them or not, for the height of the ground below it.
    void setSplitBelowCamera(bool split) { splitBelowCamera_ = split; }
    void setCameraSoon(const std::optional<glm::dvec2>& local) { cameraSoon_ = local; }
    /// Whether the camera is above a quad, seen from the local plane.
    bool isBelowCamera(const TerrainQuad& quad) const;
    bool isSoonBelowCamera(const TerrainQuad& quad) const;

    /// Elevation of the ground below the camera, metres, from the last measurement; 0 before. Each
    /// terrain has its own. What is no number is ignored.
    double groundHeight() const { return groundHeight_; }
    void setGroundHeight(double height);
    /// Where the ground height was measured last on this terrain, and when.
    struct GroundSample {
        double height = 0;   ///< metres
        glm::dvec2 place{0}; ///< local
        std::uint64_t frame = 0;
    };
    const std::optional<GroundSample>& groundSample() const { return groundSample_; }
    /// The height becomes the ground height.
    void setGroundSample(const GroundSample& sample);

    const TerrainQuad& root() const { return quads_[0]; }
    const QuadPool& quads() const { return quads_; }
    const TerrainQuad& child(const TerrainQuad& quad, int i) const {
        return quads_[quad.firstChild + i];
    }
    /// Null when the tree has no such quad.
    const TerrainQuad* find(int level, int tx, int ty) const;
    /// The leaf at a local point, or the one nearest to it as coordinates count.
    const TerrainQuad& leafAt(const glm::dvec2& local) const;
    /// What was measured of the ground that is drawn for a quad as long as it is a leaf. Finer
    /// levels may be higher or lower: whether it is split does not depend on it, but on the
    /// elevations of the whole terrain, which grow with whatever is measured beyond; and its
    /// children inherit it with a margin, twice what was measured anywhere as the difference of a
    /// quad from its parent. That is likely, not certain: what is not drawn because of it is
    /// doubtful until it is measured. Ignored when it is no range of numbers.
    void setElevations(int index, double zmin, double zmax);
    /// What was measured of a quad is out of date.
    void forgetElevations(int index) { quads_[index].measured = false; }

    /// From the camera to a quad, in local metres: the larger of the height above the ground and
    /// the distances along x and y to the nearest side, even from inside of the quad. Infinite when
    /// the camera has no local position.
    double distanceToCamera(const TerrainQuad& quad) const;

    /// The order in which four siblings are seen from the camera, nearest first.
    const std::array<int, 4>& frontToBack(const TerrainQuad& quad) const;

    /// Calls visit(const TerrainQuad&) for each leaf, front to back.
    template <class Visit>
    void forEachLeaf(Visit&& visit) const {
        eachLeaf(root(), visit);
    }

private:
    void updateQuad(TerrainQuad& quad, Visibility ofParent);
    void updateChildren(TerrainQuad& quad);
    void updateLeaf(TerrainQuad& quad);
    QuadBox wholeBox(const TerrainQuad& quad) const;
    void inheritElevations(TerrainQuad& quad) const;
    void compareWithParent(const TerrainQuad& quad);
    bool isToSplit(const TerrainQuad& quad);
    void resetHorizon();

    template <class Visit>
    void eachLeaf(const TerrainQuad& quad, Visit& visit) const {
        if (quad.isLeaf()) {
            visit(quad);
            return;
        }
        for (int i : frontToBack(quad))
            eachLeaf(child(quad, i), visit);
    }

    Parameters parameters_;
    QuadPool quads_;
    TerrainState state_;
    HorizonBuffer horizon_;
    double groundHeight_ = 0;
    std::optional<GroundSample> groundSample_;
    double zmin_ = 0, zmax_ = 0; ///< of all ground: what the author says, and what was measured
    double roughness_ = 0; ///< how far a quad went beyond its parent, at most, in edges of the quad
    int comparisons_ = 0;  ///< of a quad with its parent
    bool splitInvisibleQuads_ = false;
    bool splitBelowCamera_ = false;
    std::optional<glm::dvec2> cameraSoon_;
    bool limitReached_ = false;
};

} // namespace terrane
