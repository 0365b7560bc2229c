// SPDX-License-Identifier: BSD-3-Clause
#include "app/player.h"

#include "app/start_view.h"
#include "producer/tile_producer.h"
#include "render/context.h"
#include "resource/library.h"
#include "resource/reload.h"
#include "scene/scene_manager.h"

#include <algorithm>
#include <typeinfo>
#include <utility>

// The part of the player that follows edits.
namespace terrane {

namespace {

bool samePlay(const PlayerSettings& a, const PlayerSettings& b) {
    return a.root.name == b.root.name && *a.camera == *b.camera && *a.method == *b.method &&
           a.scheduler.name == b.scheduler.name;
}

} // namespace

ReloadReport Player::reload() {
    const Clock::time_point begin = Clock::now();
    if (context_) context_->makeCurrent();
    ReloadReport report;
    if (good_) {
        diagnostics_.forget(firstProblem_, problemsEnd_);
        firstProblem_ = diagnostics_.size();
        report = replace();
    } else {
        report = restart();
    }
    problemsEnd_ = diagnostics_.size();
    const std::chrono::duration<double, std::milli> time = Clock::now() - begin;
    report.milliseconds = time.count();
    metrics_.addReload(report);
    if (report.changed && report.good) quietFrames_ = 0;
    return report;
}

std::vector<Diagnostic> Player::problems() const {
    std::vector<Diagnostic> result = diagnostics_.all();
    result.resize(std::min(result.size(), problemsEnd_));
    result.erase(result.begin(), result.begin() + static_cast<std::ptrdiff_t>(
                                                      std::min(result.size(), firstProblem_)));
    std::erase_if(result, [](const Diagnostic& d) { return d.severity != Severity::error; });
    return result;
}

// There is nothing good to fall back to, so there is nothing to keep but the view.
ReloadReport Player::restart() {
    const std::unique_ptr<TerrainViewController> before = std::move(controller_);
    scene_.reset();
    terrains_.clear();
    samplers_.clear();
    settings_ = {};
    resources_.reset();
    library_.reset();
    diagnostics_.clear();
    firstProblem_ = 0;
    load();
    if (before && controller_ && typeid(*before) == typeid(*controller_)) {
        controller_->view = before->view;
        controller_->groundHeight = before->groundHeight;
    }
    ReloadReport report{.changed = true, .good = good_};
    if (!resources_) return report;
    for (const auto& [name, entry] : resources_->entries())
        report.rebuilt.push_back(name);
    return report;
}

ReloadReport Player::replace() {
    const std::size_t errors = diagnostics_.errors();
    const auto failed = [&] { return diagnostics_.errors() > errors; };
    std::unique_ptr<Library> fresh = readArchive();
    if (!fresh) return {.changed = true, .good = false};
    PlayerSettings settings = readPlayerSettings(*fresh, registry_);
    Reload reload(*resources_, *fresh);
    ReloadReport report{.changed = !reload.affected().empty() || !samePlay(settings, settings_)};
    if (report.changed) {
        PlayerSettings before = settings_;
        const bool bound = rebind(reload, std::move(settings));
        if (bound && !failed()) {
            account(reload, report);
        } else {
            report.good = false;
            scene_->changed();
            settings_ = std::move(before);
            reload.rollBack();
            bindScene();
            scene_->plan();
            return report;
        }
    }
    if (failed()) return {.changed = true, .good = false};
    reload.commit(roots());
    library_ = std::move(fresh);
    followShape();
    return report;
}

bool Player::rebind(Reload& reload, PlayerSettings settings) {
    scene_->changed(); // what it found is about to be replaced
    reload.rebuild();
    settings_ = std::move(settings);
    return findRoot(settings_, true) && bindScene() && scene_->plan();
}

std::vector<ResourceEntry*> Player::roots() const {
    std::vector<ResourceEntry*> roots = scene_->uses().dependencies;
    roots.push_back(settings_.root.entry());
    roots.push_back(settings_.scheduler.entry());
    return roots;
}

void Player::account(const Reload& reload, ReloadReport& report) {
    for (const auto& [entry, version] : reload.replaced()) {
        report.rebuilt.push_back(entry->name);
        if (auto* producer = dynamic_cast<TileProducer*>(version.instance.get())) {
            report.tilesInvalidated[entry->name] = producer->cache().tilesOf(*producer);
            metrics_.carryOver(entry->name, *producer);
        }
        if (auto* cache = dynamic_cast<TileCache*>(version.instance.get()))
            metrics_.carryOver(entry->name, *cache);
    }
    std::sort(report.rebuilt.begin(), report.rebuilt.end());
}

// A terrain may have become a planet, or one of another size.
void Player::followShape() {
    scene_->update(time_ * 1e6, 0); // for the bounds
    auto controller = makeViewController(*settings_.root);
    const bool same = typeid(*controller) == typeid(*controller_);
    if (same) {
        controller->view = controller_->view;
        controller->groundHeight = controller_->groundHeight;
    }
    controller_ = std::move(controller);
}

} // namespace terrane
