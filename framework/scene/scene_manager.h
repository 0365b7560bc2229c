// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "resource/manager.h"
#include "scene/info_texts.h"
#include "scene/message_log.h"
#include "scene/scene_node.h"
#include "scene/scene_task.h"
#include "task/scheduler.h"
#include "task/task_graph.h"

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace terrane {

class Framebuffer;
class GlContext;
class Program;

/// What the tasks of a frame hand to one another while they run, on the GL thread.
struct DrawState {
    Program* program = nullptr;         ///< set by setProgram
    Framebuffer* framebuffer = nullptr; ///< set by setTarget; the screen at the start of a frame
    Framebuffer* screen = nullptr;      ///< `FrameBuffer default` of archives: always one of ours
};

/// Owns the scene: its root node, its camera, and the plan of the frame, which is the camera's
/// method bound to the nodes. Used on the GL thread.
///
///     scene.setRoot(resources.get<SceneNode>("scene"));
///     scene.setScheduler(resources.get<Scheduler>("defaultScheduler"));
///     each frame: move scene.camera(), set scene.cameraToScreen;
///                 scene.update(time, elapsed); scene.draw();
class SceneManager {
public:
    /// All of them must outlive the scene manager.
    SceneManager(ResourceManager& resources, const GlContext& context, Framebuffer& screen);
    ~SceneManager();

    ResourceManager& resources() const { return resources_; }
    const GlContext& context() const { return context_; }
    DrawState& drawState() { return drawState_; }
    /// The program that a drawing task at this place of the archive is to draw a mesh with; null,
    /// with a diagnostic, when none was set ("no-program") or it takes other primitives
    /// ("wrong-primitives").
    Program* currentProgram(const Mesh& mesh, const Place& place) const;
    /// The framebuffer that every setTarget attaches its textures to.
    Framebuffer& offscreen() { return *offscreen_; }
    /// Drawing goes here, and so is not seen, where a setTarget failed.
    Framebuffer& nowhere() { return *nowhere_; }

    /// What code wants showInfo to write in this frame.
    InfoTexts& infoTexts() { return infoTexts_; }
    /// What showLog writes.
    MessageLog& messageLog() { return messageLog_; }

    void setRoot(Ref<SceneNode> root);
    SceneNode* root() const { return root_.get(); }
    void setScheduler(Scheduler& scheduler) { scheduler_ = &scheduler; }
    Scheduler* scheduler() const { return scheduler_; }
    /// The flag of the camera node and the id of its method that draws a frame.
    void setCamera(Attr<std::string> flag, Attr<std::string> method);
    /// Null when no node has the flag.
    SceneNode* camera();

    glm::dmat4 cameraToScreen{1};
    /// Eye to clip space, world to clip space, as of the last update.
    const glm::dmat4& worldToScreen() const { return worldToScreen_; }
    const glm::dmat4& cameraToWorld() const { return cameraToWorld_; }
    const glm::dmat4& screenToCamera() const { return screenToCamera_; }

    /// Nodes with a flag (their name is one), in document order, depth first.
    const std::vector<SceneNode*>& nodes(const std::string& flag);

    /// The same for a method, which is remembered until the scene changes.
    /// @param place where the flag is written; may be none
    const std::vector<SceneNode*>& ask(const std::string& flag, const Place& place);
    /// What methods asked for, and the camera's.
    const std::map<std::string, Place>& askedFlags() const { return askedFlags_; }

    /// The methods that were bound, by node and id, until the scene changes.
    using Method = std::pair<const SceneNode*, std::string>;
    const std::set<Method>& calledMethods() const { return calledMethods_; }

    /// All flags that nodes have, for messages.
    std::vector<std::string> flags();

    /// Computes all frames, bounds and visibilities. Times in microseconds, as shaders see them.
    void update(double time, double elapsed);
    double time() const { return time_; }
    double elapsed() const { return elapsed_; }
    std::uint64_t frameNumber() const { return frameNumber_; }

    /// Runs the camera's method: builds the graph of the frame and has the scheduler run it. False
    /// when there is nothing to run; why has been reported.
    bool draw();

    /// Binds the camera's method now, if it is not bound; what can't be found is reported. False
    /// when nothing could be bound.
    bool plan();
    /// To be called when nodes, flags, methods or resources change: the next frame is planned anew.
    void changed();
    /// What the plan found by name, as dependencies. Forgotten when the scene changes.
    const ResourceEntry& uses() const { return uses_; }

private:
    friend class BindContext;

    void updateFrames(SceneNode& node, const glm::dmat4& parentToWorld);
    Box updateBounds(SceneNode& node);
    void updateVisibility(SceneNode& node, Visibility inherited);
    void index(SceneNode& node);

    ResourceManager& resources_;
    const GlContext& context_;
    Scheduler* scheduler_ = nullptr;
    Ref<SceneNode> root_;
    Attr<std::string> cameraFlag_ = "camera";
    Attr<std::string> cameraMethod_ = "draw";
    DrawState drawState_;
    std::unique_ptr<Framebuffer> offscreen_;
    std::unique_ptr<Framebuffer> nowhere_;
    InfoTexts infoTexts_;
    MessageLog messageLog_;

    std::map<std::string, std::vector<SceneNode*>> nodesByFlag_;
    std::map<std::string, Place> askedFlags_;
    std::set<Method> calledMethods_;
    bool indexed_ = false;
    SceneNode* camera_ = nullptr;
    bool planned_ = false;
    std::unique_ptr<BoundTask> plan_;
    ResourceEntry uses_;
    TaskGraph graph_;

    FrustumPlanes worldPlanes_{};
    glm::dmat4 worldToScreen_{1};
    glm::dmat4 worldToCamera_{1};
    glm::dmat4 cameraToWorld_{1};
    glm::dmat4 screenToCamera_{1};
    double time_ = 0;
    double elapsed_ = 0;
    std::uint64_t frameNumber_ = 0;
};

} // namespace terrane
