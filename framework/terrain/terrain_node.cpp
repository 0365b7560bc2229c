// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/terrain_node.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace terrane {

namespace {

bool contains(const TerrainQuad& quad, const glm::dvec2& p) {
    return p.x >= quad.ox && p.x <= quad.ox + quad.l && p.y >= quad.oy && p.y <= quad.oy + quad.l;
}

} // namespace

TerrainNode::TerrainNode(Parameters parameters)
    : parameters_(std::move(parameters)) {
    Parameters& p = parameters_;
    assert(std::isfinite(p.size) && p.size > 0 && "TerrainNode: the size must be positive");
    assert(p.zmin <= p.zmax && "TerrainNode: zmin must not be above zmax");
    if (!p.deformation) p.deformation = std::make_shared<Deformation>();
    p.maxLevel = std::clamp(p.maxLevel, 0, kDeepestLevel);
    zmin_ = p.zmin;
    zmax_ = p.zmax;
    quads_.createRoot(-p.size, -p.size, 2 * p.size, p.zmin, p.zmax);
}

void TerrainNode::inherit(const TerrainNode& previous) {
    const Parameters& before = previous.parameters_;
    if (before.size != parameters_.size || previous.deformation().shape() != deformation().shape())
        return;
    groundHeight_ = previous.groundHeight_;
    groundSample_ = previous.groundSample_;
}

void TerrainNode::setGroundHeight(double height) {
    if (std::isfinite(height)) groundHeight_ = height;
}

void TerrainNode::setGroundSample(const GroundSample& sample) {
    if (!std::isfinite(sample.height)) return;
    groundSample_ = sample;
    groundHeight_ = sample.height;
}

bool TerrainNode::update(const TerrainView& view) {
    const std::optional<TerrainState> state =
        terrainState(view, deformation(), parameters_.splitFactor, groundHeight_, zmin_);
    TerrainQuad& root = quads_[0];
    limitReached_ = false;
    if (!state) {
        quads_.collapse(root);
        root.visibility = Visibility::none;
        root.occluded = false;
        return false;
    }
    state_ = *state;
    resetHorizon();
    updateQuad(root, Visibility::partial);
    return true;
}

void TerrainNode::resetHorizon() {
    const bool useful = parameters_.horizonCulling && state_.cameraIsLocal &&
                        state_.localCamera.z <= zmax_ &&
                        deformation().hasStraightSight(state_.localCamera);
    if (useful)
        horizon_.reset(state_.localCamera,
                       glm::dvec2(state_.localCamera) - glm::dvec2(state_.localBehind));
    else
        horizon_.disable();
}

// The space in which the ground of a quad is, however finely it is drawn.
QuadBox TerrainNode::wholeBox(const TerrainQuad& quad) const {
    return {quad.ox, quad.oy, quad.l, zmin_, zmax_};
}

void TerrainNode::inheritElevations(TerrainQuad& quad) const {
    // So many pairs are one or two pictures; before, nobody knows how rough the ground is.
    constexpr int kEnough = 100;
    quad.zmin = zmin_;
    quad.zmax = zmax_;
    if (quad.parent < 0 || comparisons_ < kEnough) return;
    const TerrainQuad& parent = quads_[quad.parent];
    const double margin = 2 * roughness_ * quad.l;
    quad.zmin = std::max(zmin_, parent.zmin - margin);
    quad.zmax = std::min(zmax_, parent.zmax + margin);
}

void TerrainNode::compareWithParent(const TerrainQuad& quad) {
    if (quad.parent < 0 || !quads_[quad.parent].measured) return;
    const TerrainQuad& parent = quads_[quad.parent];
    const double beyond = std::max(parent.zmin - quad.zmin, quad.zmax - parent.zmax);
    roughness_ = std::max(roughness_, beyond / quad.l);
    comparisons_ += comparisons_ < std::numeric_limits<int>::max() ? 1 : 0;
}

void TerrainNode::updateQuad(TerrainQuad& quad, Visibility ofParent) {
    if (!quad.measured) inheritElevations(quad);
    quad.doubtful = false;
    quad.visibility = ofParent == Visibility::partial
                          ? deformation().visibility(state_.viewer, wholeBox(quad))
                          : ofParent;
    if (quad.isVisible() && quad.occluded) {
        quad.occluded = horizon_.isOccluded(wholeBox(quad));
        if (quad.occluded) quad.visibility = Visibility::none;
    }
    if (isToSplit(quad)) {
        if (quad.isLeaf()) quads_.split(quad);
        updateChildren(quad);
    } else {
        quads_.collapse(quad);
        updateLeaf(quad);
    }
}

bool TerrainNode::isToSplit(const TerrainQuad& quad) {
    const bool seen = quad.isVisible() || splitInvisibleQuads_ ||
                      (splitBelowCamera_ && (isBelowCamera(quad) || isSoonBelowCamera(quad)));
    const bool wanted = seen && quad.level < parameters_.maxLevel &&
                        distanceToCamera(quad) < quad.l * state_.splitDistance;
    if (!wanted || !quad.isLeaf()) return wanted;
    const bool room = quads_.size() + QuadPool::kSiblings <= parameters_.maxQuads;
    limitReached_ = limitReached_ || !room;
    return room;
}

void TerrainNode::updateChildren(TerrainQuad& quad) {
    bool allOccluded = true;
    for (int i : frontToBack(quad)) {
        TerrainQuad& child = quads_[quad.firstChild + i];
        updateQuad(child, quad.visibility);
        allOccluded = allOccluded && child.occluded;
    }
    quad.occluded = allOccluded;
}

void TerrainNode::updateLeaf(TerrainQuad& quad) {
    if (!quad.isVisible()) return;
    // It is drawn as it is, so its own elevations count, where they are known to be fewer.
    const bool fewer = quad.zmin > zmin_ || quad.zmax < zmax_;
    if (fewer && quad.visibility == Visibility::partial)
        quad.visibility = deformation().visibility(state_.viewer, quad.box());
    if (quad.isVisible()) {
        QuadBox box = quad.box();
        if (!quad.measured) box.zmin = zmin_; // what is only likely must not hide others
        quad.occluded = horizon_.addOccluder(box);
        if (quad.occluded) quad.visibility = Visibility::none;
    }
    quad.doubtful = !quad.isVisible() && !quad.measured && fewer;
}

bool TerrainNode::isBelowCamera(const TerrainQuad& quad) const {
    return state_.cameraIsLocal && contains(quad, glm::dvec2(state_.localCamera));
}

bool TerrainNode::isSoonBelowCamera(const TerrainQuad& quad) const {
    return cameraSoon_ && contains(quad, *cameraSoon_);
}

const TerrainQuad& TerrainNode::leafAt(const glm::dvec2& local) const {
    const TerrainQuad* quad = &root();
    while (!quad->isLeaf())
        quad = &child(*quad, quad->childAt(local));
    return *quad;
}

double TerrainNode::distanceToCamera(const TerrainQuad& quad) const {
    if (!state_.cameraIsLocal) return std::numeric_limits<double>::infinity();
    const glm::dvec3& c = state_.localCamera;
    const double above = std::abs(c.z - std::max(0.0, state_.groundHeight)) / state_.distFactor;
    const double alongX = std::min(std::abs(c.x - quad.ox), std::abs(c.x - quad.ox - quad.l));
    const double alongY = std::min(std::abs(c.y - quad.oy), std::abs(c.y - quad.oy - quad.l));
    return std::max({above, alongX, alongY});
}

const std::array<int, 4>& TerrainNode::frontToBack(const TerrainQuad& quad) const {
    // By the quadrant of the quad in which the camera is: lower left, lower right, upper left,
    // upper right.
    static constexpr std::array<std::array<int, 4>, 4> kOrders{
        {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 0, 3, 1}, {3, 1, 2, 0}}};
    return kOrders[quad.childAt(glm::dvec2(state_.localCamera))];
}

const TerrainQuad* TerrainNode::find(int level, int tx, int ty) const {
    if (level < 0 || level > kDeepestLevel) return nullptr;
    const int count = 1 << level;
    if (tx < 0 || ty < 0 || tx >= count || ty >= count) return nullptr;
    const TerrainQuad* quad = &root();
    for (int shift = level - 1; shift >= 0; --shift) {
        if (quad->isLeaf()) return nullptr;
        quad = &child(*quad, (tx >> shift & 1) + 2 * (ty >> shift & 1));
    }
    return quad;
}

void TerrainNode::setElevations(int index, double zmin, double zmax) {
    assert(quads_[index].isAlive() && "TerrainNode::setElevations: no such quad");
    const bool valid = std::isfinite(zmin) && std::isfinite(zmax) && zmin <= zmax;
    if (!valid) return;
    TerrainQuad& quad = quads_[index];
    const bool known = quad.measured && quad.zmin == zmin && quad.zmax == zmax;
    quad.zmin = zmin;
    quad.zmax = zmax;
    quad.measured = true;
    zmin_ = std::min(zmin_, zmin);
    zmax_ = std::max(zmax_, zmax);
    if (!known) compareWithParent(quad);
}

} // namespace terrane
