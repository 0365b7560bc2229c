// SPDX-License-Identifier: BSD-3-Clause
#include "app/player.h"

#include "app/ground_pick.h"
#include "app/problem_overlay.h"
#include "app/start_view.h"
#include "render/context.h"
#include "render/program_bindings.h"
#include "render/render_target.h"
#include "render/unmatched_uniforms.h"
#include "resource/library.h"
#include "resource/manager.h"
#include "resource/unused_resources.h"
#include "scene/scene_manager.h"
#include "scene/uncalled_methods.h"
#include "scene/unmatched_flags.h"
#include "scene/unmatched_values.h"
#include "task/multithread_scheduler.h"
#include "terrain/terrain_node.h"
#include "terrain/tile_sampler.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include <glm/geometric.hpp>

namespace terrane {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

} // namespace

Player::Player(const Registry& registry, PlayerOptions options)
    : registry_(registry)
    , options_(std::move(options)) {
    if (options_.recordFrames) metrics_.reserve();
}

Player::~Player() {
    if (context_) context_->makeCurrent(); // GL objects die with it
}

bool Player::load() {
    const bool drawable = open() && setScene(true);
    good_ = drawable && diagnostics_.errors() == 0;
    problemsEnd_ = diagnostics_.size();
    if (good_) firstProblem_ = problemsEnd_; // what it warned of holds on
    showProblems();
    return drawable && (good_ || options_.keepGoing);
}

void Player::check(bool unused) {
    if (!open()) return;
    resources_->loadAll();
    setScene(false);
    if (unused) reportUnusedResources(*resources_, roots());
    checkUncalledMethods(*scene_);
    reportUnmatchedUniforms(*resources_); // of programs that the scene does not use, too
    reportUnmatchedValues(*scene_);
}

bool Player::open() {
    const Clock::time_point begin = Clock::now();
    library_ = readArchive();
    if (!library_ && !options_.keepGoing) return false;
    const Clock::time_point read = Clock::now();
    if (!context_ && !openContext()) return false;
    metrics_.startup.context = milliseconds(read, Clock::now());
    if (!library_) return false;
    metrics_.startup.load = milliseconds(begin, read);

    resources_ = std::make_unique<ResourceManager>(registry_, *library_, diagnostics_);
    resources_->services().provide(*context_);
    resources_->services().provide(*bindings_);
    readbackTiming_.sameFrameInEachRun = options_.timeStep > 0;
    resources_->services().provide(readbackTiming_);
    scene_ = std::make_unique<SceneManager>(*resources_, *context_, target_->framebuffer());
    settings_ = readPlayerSettings(*library_, registry_);
    return true;
}

std::unique_ptr<Library> Player::readArchive() {
    const auto archive = resolveArchive(options_.archive, diagnostics_);
    if (!archive) return nullptr;
    auto library =
        std::make_unique<Library>(archiveSearchPath(*archive, options_.paths), diagnostics_);
    applySettings(*library);
    return library->addArchive(archive->path) ? std::move(library) : nullptr;
}

bool Player::openContext() {
    const GlContext::Options wanted{.debug = options_.debug,
                                    .maxAnisotropy = options_.maxAnisotropy};
    context_ = options_.makeContext
                   ? options_.makeContext(diagnostics_, wanted)
                   : createHeadlessContext(diagnostics_, wanted, options_.headless);
    if (!context_) return false;
    context_->makeCurrent();
    bindings_ = std::make_unique<ProgramBindings>(*context_);
    target_ = std::make_unique<RenderTarget>(*context_, options_.width, options_.height);
    // Archives count on this (ork reference 4.3).
    target_->framebuffer().state.depth = {true, CompareFunction::less};
    target_->framebuffer().clear(Planes::all); // a window may show it before the first frame
    return true;
}

bool Player::setScene(bool rootRequired) {
    const Clock::time_point begin = Clock::now();
    if (!findRoot(settings_, rootRequired)) return false;
    const bool scheduled = bindScene();
    const Clock::time_point loaded = Clock::now();
    metrics_.startup.load += milliseconds(begin, loaded);
    if (!settings_.root) return false;
    const bool planned = scene_->plan();
    if (planned) reportMisspellings();
    metrics_.startup.compile = milliseconds(loaded, Clock::now());
    setStartView();
    return planned && scheduled;
}

void Player::reportMisspellings() {
    reportUnmatchedUniforms(*resources_);
    reportUnmatchedFlags(*scene_);
}

// A file of resources for others has nothing to play and is fine for `check`.
bool Player::findRoot(PlayerSettings& settings, bool required) {
    if (settings.rootGiven) return true;
    Library& library = resources_->library();
    if (const auto found = library.find(settings.root.name)) {
        settings.root.place = found->element.place();
        return true;
    }
    if (!required) return false;
    diagnostics_.error("no-root", library.archivePlace(), "the archive has nothing to draw",
                       "a node '" + settings.root.name + "', or <player root=\"...\"/>");
    return false;
}

// Without a scheduler the rest is still bound, so that one run tells all that is wrong.
bool Player::bindScene() {
    resources_->resolve(settings_.root, typeid(SceneNode), nullptr);
    const bool scheduled = setScheduler();
    if (!settings_.root) return false;
    scene_->setRoot(settings_.root);
    terrains_ = terrainsOf(*settings_.root);
    samplers_ = samplersOf(*settings_.root);
    scene_->setCamera(settings_.camera, settings_.method);
    return scheduled;
}

bool Player::setScheduler() {
    Scheduler* scheduler = nullptr;
    if (!settings_.schedulerGiven && !resources_->library().find(settings_.scheduler.name)) {
        if (!ownScheduler_) ownScheduler_ = std::make_shared<MultithreadScheduler>();
        scheduler = ownScheduler_.get();
    } else {
        resources_->resolve(settings_.scheduler, typeid(Scheduler), nullptr);
        scheduler = settings_.scheduler.get();
    }
    if (!scheduler) return false;
    observe(*scheduler);
    scene_->setScheduler(*scheduler);
    return true;
}

void Player::observe(Scheduler& scheduler) {
    scheduler.setErrorHandler([this](const Task& task, const std::string& message) {
        diagnostics_.error("task-failed", {}, std::string(task.name()) + ": " + message);
    });
    if (options_.trace) scheduler.setObserver([this](const TaskRun& run) { trace_.addTask(run); });
}

void Player::setStartView() {
    scene_->update(0, 0); // for the bounds
    controller_ = makeViewController(*settings_.root);
    viewShape_ = viewShape(*settings_.root);
    if (settings_.view) controller_->view = *settings_.view;
    if (options_.view) controller_->view = controller_->fromDegrees(*options_.view);
}

bool Player::drawable() const {
    return controller_ && scene_ && scene_->scheduler();
}

bool Player::frame() {
    if (!drawable()) return false;
    const std::uint64_t allocations = options_.allocations ? options_.allocations() : 0;
    context_->makeCurrent();
    const Clock::time_point begin = Clock::now();
    const bool moved = controller_->view != lastView_;
    followSize();
    advanceTime();
    placeCamera();
    clear();
    const Clock::time_point cleared = Clock::now();
    scene_->update(time_ * 1e6, elapsed_ * 1e6);
    const Clock::time_point updated = Clock::now();
    bool drawn = scene_->draw();
    SchedulerStatistics tasks = scene_->scheduler()->statistics();
    if (cameraJumped()) {
        // Nearer to the ground there are finer tiles, which may be higher: a few times.
        for (int i = 0; i < 4 && drawn && readGround(); ++i) {
            drawn = drawAgain();
            const SchedulerStatistics again = scene_->scheduler()->statistics();
            tasks.kept += again.kept;
            tasks.waiting = again.waiting;
        }
    }
    if (overlay_) overlay_->draw(target_->framebuffer());
    const Clock::time_point end = Clock::now();
    rememberCamera();
    followGround();
    if (options_.allocations) metrics_.allocationsLastFrame = options_.allocations() - allocations;

    if (options_.trace) {
        trace_.addSpan("update", cleared, updated);
        trace_.addSpan("draw", updated, end);
    }
    if (options_.recordFrames) {
        context_->finish();
        metrics_.addFrame({.cpu = milliseconds(begin, end),
                           .gl = milliseconds(end, Clock::now()),
                           .update = milliseconds(cleared, updated),
                           .draw = milliseconds(updated, end),
                           .tiles = static_cast<int>(tasks.kept)});
    }
    if (frames_ == 0) metrics_.startup.firstFrame = milliseconds(begin, Clock::now());
    ++frames_;
    countQuietFrame(!moved && tasks.waiting == 0 && tasks.kept == 0 && isSettled());
    return drawn;
}

bool Player::complete() const {
    return controller_ && quietFrames_ >= kQuietFrames && controller_->view == lastView_;
}

bool Player::drawUntilComplete(int mostFrames) {
    for (int i = 0; i < mostFrames && !complete(); ++i) {
        if (!frame()) return false;
    }
    return complete();
}

void Player::followSize() {
    if (newSize_) target_->resize(newSize_->x, newSize_->y);
    newSize_.reset();
}

void Player::advanceTime() {
    const Clock::time_point now = Clock::now();
    if (frames_ == 0) start_ = now;
    double next = frames_ * options_.timeStep;
    if (options_.timeStep <= 0) next = milliseconds(start_, now) / 1000;
    elapsed_ = next - time_;
    time_ = next;
}

void Player::placeCamera() {
    // A camera that turns or jumps may be where the ground is not known yet.
    controller_->highestGround = -std::numeric_limits<double>::infinity();
    if (scene_->frameNumber() > 0)
        controller_->highestGround = highestGround(terrains_, controller_->position());
    if (SceneNode* const camera = scene_->camera())
        camera->localToParent = controller_->cameraToWorld();
    scene_->cameraToScreen = controller_->cameraToScreen(target_->width(), target_->height());
}

bool Player::drawAgain() {
    placeCamera();
    clear();
    scene_->update(time_ * 1e6, elapsed_ * 1e6);
    return scene_->draw();
}

void Player::clear() {
    // Whatever a method left switched off, a frame starts on an empty picture.
    Framebuffer& screen = target_->framebuffer();
    const PipelineState::Masks write = std::exchange(screen.state.write, {});
    const bool scissor = std::exchange(screen.state.scissor.enabled, false);
    screen.clear(Planes::all);
    screen.state.write = write;
    screen.state.scissor.enabled = scissor;
}

TerrainPlace Player::placeBelowCamera() const {
    const TerrainNode* const terrain = terrainBelowCamera(terrains_);
    if (!terrain) return {};
    return {terrain, glm::dvec2(terrain->state().localCamera)};
}

glm::dvec3 Player::pointBelowCamera() const {
    const TerrainPlace place = placeBelowCamera();
    return place.terrain ? inWorld(place, 0) : glm::dvec3(0);
}

void Player::rememberCamera() {
    const glm::dvec3 below = pointBelowCamera();
    belowBefore_ = frames_ == 0 ? below : below_;
    below_ = below;
}

// So that what was read back of the ground is of another place than where the camera would have
// gone on to, and ground that rises steeply may be as high.
bool Player::cameraJumped() const {
    if (frames_ == 0) return true;
    const double astray = glm::length(pointBelowCamera() - 2.0 * below_ + belowBefore_);
    constexpr double kSteep = 2, kFramesLate = PixelReadback::kLatency + 1;
    return controller_->height() - controller_->groundHeight < kSteep * kFramesLate * astray;
}

// Of a camera that has jumped, from the tiles of this frame, at once: what is read back in passing
// would come some frames later. Returns whether the camera has to be elsewhere.
bool Player::readGround() {
    TerrainNode* const terrain = terrainBelowCamera(terrains_);
    if (!terrain || !terrain->isBelowCamera(terrain->root())) return false;
    const bool followed =
        std::any_of(samplers_.begin(), samplers_.end(), [&](const TileSampler* sampler) {
            return sampler->terrain() == terrain && sampler->followsCamera();
        });
    if (!followed) return false;
    const glm::dvec2 local(terrain->state().localCamera);
    const auto ground = groundElevation({terrain, local}, samplers_);
    if (!ground) return false;
    terrain->setGroundSample({ground->elevation, local, scene_->frameNumber() - 1});
    followGround();
    const glm::dvec3 drawn(scene_->cameraToWorld()[3]);
    placeCamera();
    const double above = std::max(controller_->height() - controller_->groundHeight, 0.0);
    return glm::distance(controller_->position(), drawn) > 0.01 * above;
}

void Player::followGround() {
    const TerrainNode* const terrain = groundBelowCamera(terrains_);
    if (!terrain) return;
    controller_->groundHeight = groundHeightInWorld(*terrain);
    shareGroundHeight(*terrain, terrains_);
}

bool Player::isSettled() const {
    const std::uint64_t last = scene_->frameNumber() - 1;
    return std::all_of(samplers_.begin(), samplers_.end(),
                       [&](const TileSampler* sampler) { return sampler->isSettled(last); });
}

void Player::countQuietFrame(bool nothingMade) {
    const bool settled = controller_->groundHeight == lastGround_;
    quietFrames_ = nothingMade && settled ? quietFrames_ + 1 : 0;
    lastView_ = controller_->view;
    lastGround_ = controller_->groundHeight;
}

Image Player::capture() {
    context_->makeCurrent();
    return target_->captureOpaque();
}

void Player::resize(int width, int height) {
    newSize_ = glm::ivec2(width, height);
    if (width != target_->width() || height != target_->height()) quietFrames_ = 0;
}

std::optional<glm::dvec3> Player::groundAt(double x, double y) {
    if (frames_ == 0) return std::nullopt;
    context_->makeCurrent();
    const glm::dmat4 worldFromScreen = scene_->cameraToWorld() * scene_->screenToCamera();
    const auto point = pointAt(*target_, worldFromScreen, x, y);
    return point && isNearTerrain(*point, terrains_) ? point : std::nullopt;
}

std::optional<TerrainPlace> Player::placeAt(double x, double y) const {
    return terrainPlace(terrains_, x, y);
}

std::optional<TileElevation> Player::elevationAt(const TerrainPlace& place) {
    context_->makeCurrent();
    return groundElevation(place, samplers_);
}

bool Player::isSoftware() const {
    return context_ && context_->isSoftware();
}

void Player::mark() {
    metrics_.mark(*resources_);
}

nlohmann::ordered_json Player::metrics() {
    return metrics_.json(*resources_, {.renderer = context_->renderer(),
                                       .width = target_->width(),
                                       .height = target_->height(),
                                       .glObjects = context_->objectCount()});
}

std::string Player::traceJson() const {
    return options_.trace ? trace_.json() : std::string();
}

} // namespace terrane
