// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/ground_height.h"
#include "app/metrics.h"
#include "app/options.h"
#include "app/player_element.h"
#include "app/reload_report.h"
#include "app/start_view.h"
#include "app/trace.h"
#include "core/diagnostic.h"
#include "core/image.h"
#include "render/pixel_readback.h"
#include "resource/attribute_edit.h"
#include "ui/view_controller.h"

#include <chrono>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace terrane {

class GlContext;
class Library;
class Registry;
class Reload;
class RenderTarget;
class ResourceManager;
class SceneManager;
class Scheduler;
class TerrainNode;
class TileSampler;
class ProblemOverlay;
struct ProgramBindings;

/// Plays one archive: loads it, moves its camera, draws its frames into a picture of its own. Owns
/// everything that takes, so that several players live in one process; each is used on one thread
/// at a time, and makes its OpenGL context current whenever it needs it.
///
///     Registry registry;
///     registerStandardTypes(registry);
///     registerStandardPlugins(registry);
///     Player player(registry, {.archive = "archives/mountains"});
///     if (player.load()) {
///         while (!player.complete()) player.frame();
///         writePng("mountains.png", player.capture());
///     }
///
/// Nothing throws; what is wrong with the archive is told by diagnostics().
class Player {
public:
    /// @param registry must outlive the player
    Player(const Registry& registry, PlayerOptions options);
    ~Player();
    Player(const Player&) = delete;
    Player& operator=(const Player&) = delete;

    /// Loads what the root node reaches and binds the methods of the frame. False when nothing can
    /// be drawn, and after errors unless the options say to keep going. To be called once.
    bool load();
    /// Instead of load(): loads every entry, used or not, and binds the methods of the frame if
    /// there is a root node. To be called once.
    /// @param unused whether to tell of entries that nothing which is played uses
    void check(bool unused = false);

    /// Reads the archive and its files again, between two frames: what changed is built anew, with
    /// what was made from it, or, after errors, everything stays as it was. The camera stays, and
    /// so do values that were set. An archive that had errors from the start is loaded anew. Errors
    /// and warnings of the reload before are forgotten, after a good one all errors.
    ReloadReport reload();
    /// Gives an attribute of an entry of the archive another value, by the same way as an edit of
    /// its file, but leaves the file alone. It counts until the file says something else there.
    /// Empty when all went well; else why not, and nothing has changed.
    std::string set(const std::string& resource, const std::string& attribute,
                    const std::string& value);
    /// The errors of the last load or reload; none when it was good.
    std::vector<Diagnostic> problems() const;
    /// Where an edit may happen: the folders that names are looked up in, and those of all files
    /// that were read.
    std::vector<std::filesystem::path> sourceFolders() const;

    /// There is something to draw: what follows may be called.
    bool drawable() const;
    /// Draws the next frame; again, if a camera that has jumped turns out to be too near to the
    /// ground, or far from it. False when there is nothing to draw.
    bool frame();
    /// Instead, where there is nothing to draw: an empty picture with the problems on it, if the
    /// options ask for them.
    void drawProblems();
    /// Draws frames until the picture is complete. False when it is not after so many, or when
    /// there is nothing to draw.
    bool drawUntilComplete(int mostFrames = kMostFrames);
    /// The picture is complete: the last frames made no tile and left none waiting, nothing is
    /// still to be read back from them, and neither view nor ground has moved.
    bool complete() const;
    int frames() const { return frames_; }
    /// Of the last frame, seconds since the first one.
    double time() const { return time_; }

    /// The last frame; RGB. Waits for OpenGL.
    Image capture();
    /// The size of the picture from the next frame on; at least 1 x 1. Only when drawable(). Until
    /// then the last frame stays as it is.
    void resize(int width, int height);
    /// What the frames are drawn into. Only when drawable().
    const RenderTarget& picture() const { return *target_; }

    /// The point of the world that the last frame shows at a place, in pixels from the top left
    /// corner; none where it shows nothing near a terrain. Waits for OpenGL.
    std::optional<glm::dvec3> groundAt(double x, double y);

    /// The place of a terrain that two numbers stand for; see terrainPlace(). As of the last frame.
    std::optional<TerrainPlace> placeAt(double x, double y) const;
    /// The elevation there by the finest tile that there is. Waits for OpenGL.
    std::optional<TileElevation> elevationAt(const TerrainPlace& place);

    /// Where the camera is. Free to change between frames.
    TerrainViewController& controller() { return *controller_; }

    /// Whether the picture is drawn without a GPU.
    bool isSoftware() const;

    Diagnostics& diagnostics() { return diagnostics_; }
    /// Only after load() or check(); null when the archive or the context could not be had.
    ResourceManager* resources() { return resources_.get(); }
    SceneManager* scene() { return scene_.get(); }
    const PlayerOptions& options() const { return options_; }

    /// Counters start again.
    void mark();
    const Metrics& counters() const { return metrics_; }
    /// See Metrics.
    nlohmann::ordered_json metrics();
    /// Empty unless the options ask for it.
    std::string traceJson() const;

private:
    /// An attribute that does not have the value that its file gives it.
    struct AttributeSetting {
        std::filesystem::path file;
        AttributePlace place;
        std::string value;
        std::optional<std::string> original; ///< what the file said then
    };

    /// What happened in a frame may have consequences in the next: so long must nothing happen.
    static constexpr int kQuietFrames = 3;
    using Clock = std::chrono::steady_clock;

    bool open();
    std::unique_ptr<Library> readArchive();
    void applySettings(Library& library);
    bool openContext();
    bool setScene(bool rootRequired);
    bool findRoot(PlayerSettings& settings, bool required);
    bool bindScene();
    void reportMisspellings();
    ReloadReport restart();
    ReloadReport replace();
    bool rebind(Reload& reload, PlayerSettings settings);
    void account(const Reload& reload, ReloadReport& report);
    std::vector<ResourceEntry*> roots() const;
    void showProblems();
    void followShape();
    void followPlaces();
    bool setScheduler();
    void observe(Scheduler& scheduler);
    void setStartView();
    void followSize();
    void advanceTime();
    void placeCamera();
    void clear();
    bool drawAgain();
    void followGround();
    TerrainPlace placeBelowCamera() const;
    glm::dvec3 pointBelowCamera() const;
    bool cameraJumped() const;
    bool readGround();
    void rememberCamera();
    bool isSettled() const;
    void countQuietFrame(bool nothingMade);

    const Registry& registry_;
    const PlayerOptions options_;
    // In the order of construction; what is below uses what is above.
    Diagnostics diagnostics_;
    Metrics metrics_;
    Trace trace_;
    std::unique_ptr<Library> library_;
    std::unique_ptr<GlContext> context_;
    std::unique_ptr<ProgramBindings> bindings_;
    std::unique_ptr<ProblemOverlay> overlay_; ///< once there is a problem to show
    ReadbackTiming readbackTiming_;
    std::unique_ptr<RenderTarget> target_;
    std::shared_ptr<Scheduler> ownScheduler_; ///< of archives without one
    std::unique_ptr<ResourceManager> resources_;
    std::unique_ptr<SceneManager> scene_;
    PlayerSettings settings_;
    std::vector<TerrainNode*> terrains_; ///< of the scene
    std::vector<TileSampler*> samplers_;
    std::unique_ptr<TerrainViewController> controller_;
    ViewShape viewShape_; ///< that the controller is for
    std::vector<AttributeSetting> attributeSettings_;
    std::vector<AttributeSetting> nextSettings_;        ///< if what is being loaded is good
    std::vector<std::filesystem::path> attemptedFiles_; ///< by a reload that failed
    std::unique_ptr<TerrainViewController> before_;     ///< a restart: that of the archive before
    /// The newest text of each file, by the path that diagnostics show.
    std::map<std::string, std::shared_ptr<const SourceFile>> newestTexts_;
    bool good_ = false;                              ///< the archive is loaded without errors
    std::size_t firstProblem_ = 0, problemsEnd_ = 0; ///< of the last load or reload

    Clock::time_point start_{};
    std::optional<glm::ivec2> newSize_; ///< of the next frame
    double time_ = 0, elapsed_ = 0;     ///< seconds
    int frames_ = 0;
    int quietFrames_ = 0;
    View lastView_;
    double lastGround_ = 0;
    glm::dvec3 below_{0}, belowBefore_{0}; ///< the camera of the last frame, and of that before
};

} // namespace terrane
