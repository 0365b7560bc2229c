// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_manager.h"

#include "render/framebuffer.h"
#include "render/mesh.h"
#include "render/program.h"
#include "scene/bind_context.h"
#include "scene/frame_builder.h"

#include <array>

namespace terrane {

namespace {

Visibility visibilityOf(const FrustumPlanes& planes, const Box& box) {
    std::array<glm::dvec3, 8> corners;
    for (int i = 0; i < 8; ++i)
        corners[i] = box.corner(i);
    return visibility(planes, corners);
}

} // namespace

SceneManager::SceneManager(ResourceManager& resources, const GlContext& context,
                           Framebuffer& screen)
    : resources_(resources)
    , context_(context)
    , offscreen_(std::make_unique<Framebuffer>(context))
    , nowhere_(std::make_unique<Framebuffer>(context)) {
    nowhere_->setSizeWithoutAttachments(1, 1);
    drawState_.screen = drawState_.framebuffer = &screen;
}

SceneManager::~SceneManager() {
    changed();
}

Program* SceneManager::currentProgram(const Mesh& mesh, const Place& place) const {
    Program* const program = drawState_.program;
    Diagnostics& diagnostics = resources_.diagnostics();
    if (!program) {
        diagnostics.error("no-program", place, "there is no program to draw with",
                          "a setProgram before it");
        return nullptr;
    }
    if (program->canDraw(mesh.mode())) return program;
    diagnostics.error("wrong-primitives", place,
                      "program '" + program->name() + "' can't draw what this mesh is made of",
                      "a mesh of the primitives that its geometry or tessellation stage takes");
    return nullptr;
}

void SceneManager::setRoot(Ref<SceneNode> root) {
    root_ = std::move(root);
    changed();
}

void SceneManager::setCamera(Attr<std::string> flag, Attr<std::string> method) {
    cameraFlag_ = std::move(flag);
    cameraMethod_ = std::move(method);
    changed();
}

SceneNode* SceneManager::camera() {
    if (!indexed_) nodes(*cameraFlag_);
    return camera_;
}

void SceneManager::changed() {
    indexed_ = planned_ = false;
    askedFlags_.clear();
    calledMethods_.clear();
    plan_.reset();
    graph_.clear();
    for (ResourceEntry* const entry : uses_.dependencies)
        std::erase(entry->dependents, &uses_);
    uses_.dependencies.clear();
    uses_.madeFrom.clear();
}

void SceneManager::index(SceneNode& node) {
    for (const std::string& flag : node.flags)
        nodesByFlag_[flag].push_back(&node);
    for (const auto& child : node.children)
        index(*child);
}

const std::vector<SceneNode*>& SceneManager::nodes(const std::string& flag) {
    if (!indexed_) {
        nodesByFlag_.clear();
        if (root_) index(*root_);
        indexed_ = true;
        const auto cameras = nodesByFlag_.find(*cameraFlag_);
        camera_ = cameras == nodesByFlag_.end() ? nullptr : cameras->second.front();
    }
    return nodesByFlag_[flag];
}

const std::vector<SceneNode*>& SceneManager::ask(const std::string& flag, const Place& place) {
    Place& known = askedFlags_[flag];
    if (!known) known = place;
    return nodes(flag);
}

std::vector<std::string> SceneManager::flags() {
    nodes(*cameraFlag_); // makes the index
    std::vector<std::string> result;
    for (const auto& [flag, nodes] : nodesByFlag_) {
        if (!nodes.empty()) result.push_back(flag);
    }
    return result;
}

void SceneManager::update(double time, double elapsed) {
    time_ = time;
    elapsed_ = elapsed;
    SceneNode* const root = root_.get();
    if (!root) return;
    // The root's own transformation does not count: its frame is the world.
    root->localToWorld = glm::dmat4(1);
    for (const auto& child : root->children)
        updateFrames(*child, root->localToWorld);
    updateBounds(*root);
    if (const SceneNode* eye = camera()) cameraToWorld_ = eye->localToWorld;
    worldToCamera_ = glm::inverse(cameraToWorld_);
    screenToCamera_ = glm::inverse(cameraToScreen);
    worldToScreen_ = cameraToScreen * worldToCamera_;
    worldPlanes_ = frustumPlanes(worldToScreen_);
    updateVisibility(*root, Visibility::partial);
}

void SceneManager::updateFrames(SceneNode& node, const glm::dmat4& parentToWorld) {
    node.localToWorld = parentToWorld * node.localToParent;
    for (const auto& child : node.children)
        updateFrames(*child, node.localToWorld);
}

Box SceneManager::updateBounds(SceneNode& node) {
    node.worldBounds = node.localBounds.transformed(node.localToWorld);
    for (const auto& child : node.children)
        node.worldBounds = node.worldBounds.enlarged(updateBounds(*child));
    return node.worldBounds;
}

void SceneManager::updateVisibility(SceneNode& node, Visibility inherited) {
    node.localToCamera = worldToCamera_ * node.localToWorld;
    node.localToScreen = cameraToScreen * node.localToCamera;
    node.visibility =
        inherited == Visibility::partial ? visibilityOf(worldPlanes_, node.worldBounds) : inherited;
    for (const auto& child : node.children)
        updateVisibility(*child, node.visibility);
}

bool SceneManager::plan() {
    if (planned_) return plan_ != nullptr;
    planned_ = true; // a failure is told once, not every frame
    ask(*cameraFlag_, {});
    SceneNode* const eye = camera();
    Diagnostics& diagnostics = resources_.diagnostics();
    if (!eye) {
        const Place place = cameraFlag_.given || !root_ ? cameraFlag_.place : root_->place;
        diagnostics.error("no-camera", place, "no node has the flag '" + *cameraFlag_ + "'",
                          "a node with this flag, from which the scene is drawn");
        return false;
    }
    const auto method = eye->methods.find(*cameraMethod_);
    if (method == eye->methods.end()) {
        diagnostics.error("no-camera-method",
                          cameraMethod_.given ? cameraMethod_.place : eye->place,
                          "the camera node has no method '" + *cameraMethod_ + "'",
                          "<method id=\"" + *cameraMethod_ + "\" value=\"...\"/> in it");
        return false;
    }
    if (!method->second.task) return false; // told at the node
    BindContext context(*this, *eye);
    const BindContext::Call call(context, *eye, *cameraMethod_);
    plan_ = method->second.task->bind(context);
    context.finish();
    return plan_ != nullptr;
}

bool SceneManager::draw() {
    if (!root_ || !scheduler_ || !plan()) return false;
    drawState_.program = nullptr;
    drawState_.framebuffer = drawState_.screen;
    graph_.clear();
    FrameBuilder frame(graph_);
    plan_->emit(frame);
    scheduler_->run(graph_);
    infoTexts_.clear();
    ++frameNumber_;
    return true;
}

} // namespace terrane
