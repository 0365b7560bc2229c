// SPDX-License-Identifier: BSD-3-Clause
#include "app/player.h"

#include "app/problem_overlay.h"
#include "core/text.h"
#include "core/zip_file.h"
#include "producer/tile_producer.h"
#include "render/context.h"
#include "render/render_target.h"
#include "resource/library.h"
#include "resource/reload.h"
#include "scene/scene_manager.h"

#include <algorithm>
#include <map>
#include <set>
#include <typeinfo>
#include <utility>

// The part of the player that follows edits.
namespace terrane {

namespace fs = std::filesystem;

namespace {

bool samePlay(const PlayerSettings& a, const PlayerSettings& b) {
    return a.root.name == b.root.name && *a.camera == *b.camera && *a.method == *b.method &&
           a.scheduler.name == b.scheduler.name;
}

// A file that is still missing may come to be in any of them.
void addFoldersBelow(const fs::path& top, std::set<fs::path>& folders) {
    constexpr int kMost = 200;
    constexpr int kDeepest = 3;
    std::error_code error;
    int count = 0;
    const fs::path folder = fs::absolute(top.empty() ? "." : top, error).lexically_normal();
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied,
                                           error),
        end;
    for (; !error && entry != end && count < kMost; entry.increment(error)) {
        if (!entry->is_directory(error)) continue;
        const bool hidden = entry->path().filename().string().starts_with('.');
        if (hidden || entry.depth() >= kDeepest) entry.disable_recursion_pending();
        if (hidden) continue;
        folders.insert(entry->path());
        ++count;
    }
}

} // namespace

ReloadReport Player::reload() {
    const Clock::time_point begin = Clock::now();
    if (context_) context_->makeCurrent();
    // What is told from here on is about files as they are now.
    diagnostics_.setRelocation({});
    ReloadReport report;
    if (good_) {
        diagnostics_.forget(firstProblem_, problemsEnd_);
        firstProblem_ = diagnostics_.size();
        report = replace();
    } else {
        report = restart();
    }
    // What went wrong while frames were drawn may be mended; what is not is in the log.
    if (report.good && report.changed) firstProblem_ -= diagnostics_.forgetErrors(firstProblem_);
    if (good_) followPlaces();
    problemsEnd_ = diagnostics_.size();
    showProblems();
    const std::chrono::duration<double, std::milli> time = Clock::now() - begin;
    report.milliseconds = time.count();
    metrics_.addReload(report);
    quietFrames_ = 0; // even where nothing was rebuilt, problems came or went
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

void Player::showProblems() {
    if (!options_.showProblems || !context_) return;
    const std::vector<Diagnostic> problems = this->problems();
    if (problems.empty()) {
        overlay_.reset();
        return;
    }
    if (!overlay_) overlay_ = std::make_unique<ProblemOverlay>(registry_, *context_, *bindings_);
    overlay_->show(problems);
}

void Player::drawProblems() {
    if (!context_) return;
    context_->makeCurrent();
    followSize();
    clear();
    if (overlay_) overlay_->draw(target_->framebuffer());
}

std::vector<fs::path> Player::sourceFolders() const {
    std::set<fs::path> folders;
    std::error_code error;
    FileTree files;
    const auto addParent = [&](const fs::path& file) {
        if (file.empty() || files.nameInZip(file)) return; // the zip itself is what may change
        folders.insert(fs::absolute(file, error).lexically_normal().parent_path());
        folders.insert(fs::weakly_canonical(file, error).parent_path()); // it may be a link
    };
    Diagnostics ignored;
    if (const auto archive = resolveArchive(options_.archive, ignored)) {
        if (archive->files.zip()) addParent(archive->files.zip()->path());
        files = archive->files;
        const SearchPath search = archiveSearchPath(*archive, options_.paths);
        for (const fs::path& folder : search.folders())
            addParent(folder / ".");
        if (!files.zip()) addFoldersBelow(archive->path.parent_path(), folders);
    } else {
        addParent(options_.archive / "."); // of a folder, the folder itself
        addParent(options_.archive);
    }
    for (const fs::path& file : attemptedFiles_)
        addParent(file);
    if (!resources_) return {folders.begin(), folders.end()};
    for (const auto& [name, entry] : resources_->entries()) {
        addParent(entry->descriptor);
        for (const UsedFile& file : entry->files)
            addParent(file.path);
    }
    return {folders.begin(), folders.end()};
}

std::string Player::set(const std::string& resource, const std::string& attribute,
                        const std::string& value) {
    if (!good_) return "the archive has errors";
    const auto& entries = resources_->entries();
    const auto found = entries.find(resource);
    if (found == entries.end()) {
        std::vector<std::string> names;
        for (const auto& [name, entry] : entries)
            names.push_back(name);
        const std::string near = nearestName(resource, names);
        return "there is no resource " + inQuotes(resource) +
               (near.empty() ? "" : "; did you mean '" + near + "'?");
    }
    const fs::path file = found->second->descriptor;
    const auto text = resources_->library().searchPath().files().read(file);
    if (!text) return inQuotes(resource) + " is not described in a file";
    const std::vector<AttributeSetting> before = attributeSettings_;
    const AttributePlace place{resource, attribute};
    std::erase_if(attributeSettings_, [&](const AttributeSetting& s) {
        return s.file == file && s.place.resource == resource && s.place.attribute == attribute;
    });
    attributeSettings_.push_back({file, place, value, attributeValue(*text, place)});
    if (reload().good) return {};
    const std::vector<Diagnostic> problems = this->problems();
    attributeSettings_ = before;
    reload(); // forgets the problems
    return problems.empty() ? "it can't be set" : toString(problems.front());
}

void Player::applySettings(Library& library) {
    std::map<fs::path, std::string> texts;
    nextSettings_ = attributeSettings_;
    std::erase_if(nextSettings_, [&](const AttributeSetting& setting) {
        auto [text, isNew] = texts.try_emplace(setting.file);
        if (isNew) text->second = library.searchPath().files().read(setting.file).value_or("");
        auto edited = withAttribute(text->second, setting.place, setting.value);
        if (!edited) return false; // saved halfway, perhaps
        if (attributeValue(text->second, setting.place) != setting.original) return true;
        text->second = std::move(*edited);
        return false;
    });
    for (auto& [file, text] : texts) {
        if (!text.empty()) library.setText(file, std::move(text));
    }
}

// There is nothing good to fall back to, so there is nothing to keep but the view.
ReloadReport Player::restart() {
    if (controller_) before_ = std::move(controller_); // of the last archive that had a view
    scene_.reset();
    terrains_.clear();
    samplers_.clear();
    settings_ = {};
    resources_.reset();
    library_.reset();
    newestTexts_.clear();
    diagnostics_.clear();
    firstProblem_ = 0;
    load();
    if (before_ && controller_ && typeid(*before_) == typeid(*controller_)) {
        controller_->view = before_->view;
        controller_->groundHeight = before_->groundHeight;
    }
    ReloadReport report{.changed = true, .good = good_};
    if (!resources_) return report;
    for (const auto& [name, entry] : resources_->entries())
        report.rebuilt.push_back(name);
    return report;
}

ReloadReport Player::replace() {
    attemptedFiles_.clear();
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
            reportMisspellings();
            account(reload, report);
        } else {
            report.good = false;
            scene_->changed();
            settings_ = std::move(before);
            reload.rollBack();
            bindScene();
            scene_->plan();
            for (const auto& [path, source] : fresh->sources())
                attemptedFiles_.push_back(path); // where the mistake may be
            return report;
        }
    }
    if (failed()) return {.changed = true, .good = false};
    reload.commit(roots());
    library_ = std::move(fresh);
    attributeSettings_ = nextSettings_;
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

// What was not built anew tells its problems where it stood when it was. The function replaces the
// one before as a whole, since workers may be reporting.
void Player::followPlaces() {
    for (const auto& [path, source] : library_->sources()) {
        if (source) newestTexts_[source->path()] = source;
    }
    diagnostics_.setRelocation([texts = newestTexts_](const Place& place) {
        const auto now = texts.find(place.file->path());
        return now == texts.end() ? place : relocated(place, now->second);
    });
}

// A terrain that has become a planet, or one of another size, is looked at in its own way.
void Player::followShape() {
    if (viewShape(*settings_.root) == viewShape_) return;
    const auto before = std::exchange(controller_, nullptr);
    setStartView();
    if (typeid(*before) == typeid(*controller_)) controller_->view = before->view;
}

} // namespace terrane
