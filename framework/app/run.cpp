// SPDX-License-Identifier: BSD-3-Clause
#include "app/run.h"

#include "app/edit_follower.h"
#include "app/player.h"
#include "app/player_window.h"
#include "app/script_runner.h"
#include "core/files.h"
#include "core/image.h"
#include "core/text.h"

#include <chrono>
#include <cmath>
#include <istream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <set>
#include <utility>

namespace terrane {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

/// Standard error: whole messages, one after the other, as workers have something to tell, too.
class Messages {
public:
    explicit Messages(std::ostream& stream)
        : stream_(stream) {}

    void tell(const std::string& text) {
        const std::lock_guard lock(mutex_);
        stream_ << text << std::flush;
    }

private:
    std::ostream& stream_;
    std::mutex mutex_;
};

LogLevel levelOf(Severity severity) {
    return severity == Severity::error     ? LogLevel::error
           : severity == Severity::warning ? LogLevel::warning
                                           : LogLevel::info;
}

/// What is wrong is told once, however often files are saved until it is mended.
class Problems {
public:
    Problems(Messages& err, LogLevel level)
        : err_(err)
        , level_(level) {}

    void tell(const Diagnostic& diagnostic) {
        const std::string text = toString(diagnostic);
        const std::lock_guard lock(mutex_);
        now_.insert(text);
        if (before_.contains(text)) return;
        anythingNew_ = true;
        if (levelOf(diagnostic.severity) >= level_) err_.tell(text);
    }

    /// After a load or reload: what was told since the one before is known from now on. Whether any
    /// of it was new.
    bool next() {
        const std::lock_guard lock(mutex_);
        before_ = std::exchange(now_, {});
        return std::exchange(anythingNew_, false);
    }

private:
    Messages& err_;
    const LogLevel level_;
    std::mutex mutex_; ///< guards what follows
    std::set<std::string> before_, now_;
    bool anythingNew_ = false;
};

/// Tells how far a long run is, every other second after the first.
class Progress {
public:
    Progress(Messages& err, bool told)
        : err_(err)
        , told_(told) {}

    void tell(int frame, int frames) {
        const Clock::time_point now = Clock::now();
        if (!told_ || now < next_) return;
        next_ = now + std::chrono::seconds(2);
        const std::string of = frames >= 0 ? " of " + std::to_string(frames) : std::string();
        err_.tell("frame " + std::to_string(frame) + of + "\n");
    }

private:
    Messages& err_;
    const bool told_;
    Clock::time_point next_ = Clock::now() + std::chrono::seconds(1);
};

/// Pictures look plainer without a GPU; nobody should have to guess why.
void tellSoftware(Player& player, const RunOptions& options, Messages& err) {
    const bool capped = player.isSoftware() && options.player.maxAnisotropy == 0;
    if (capped && options.logLevel <= LogLevel::info)
        err.tell("drawn in software, without anisotropic filtering "
                 "(--max-anisotropy N overrides)\n");
}

/// What an archive is called: "mountains" of archives/mountains/, with or without archive.xml;
/// "helloworld" of helloworld.xml.
std::string nameOf(const fs::path& archive) {
    fs::path full = fs::absolute(archive).lexically_normal();
    if (!full.has_filename() || full.filename() == "archive.xml") full = full.parent_path();
    return full.stem().string();
}

bool isInteractive(const RunOptions& options) {
    return options.script == "-";
}

bool drawFrames(Player& player, const RunOptions& options, Messages& err) {
    const int frames = options.frames;
    Progress progress(err, options.logLevel <= LogLevel::info);
    for (int i = 0; i < (frames < 0 ? kMostFrames : frames); ++i) {
        if (frames < 0 && player.complete()) break;
        if (!player.frame()) return false;
        progress.tell(i + 1, frames);
    }
    if (frames < 0 && !player.complete()) {
        err.tell("the picture is not complete after " + std::to_string(kMostFrames) + " frames\n");
        return false;
    }
    return true;
}

/// False when the window is to be closed.
bool showFrame(Player& player, PlayerWindow* window) {
    if (!window) return true;
    if (window->closing()) return false;
    window->show(player);
    return window->follow(player);
}

std::string counted(std::size_t count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

void tellReload(const ReloadReport& report, bool anythingNew, const RunOptions& options,
                Messages& err) {
    if (!report.changed || options.logLevel > LogLevel::info) return;
    if (!report.good && !anythingNew) return;
    if (!report.good) return err.tell("not reloaded; waiting for the repair\n");
    int tiles = 0;
    for (const auto& [producer, count] : report.tilesInvalidated)
        tiles += count;
    std::vector<std::string> names = report.rebuilt;
    constexpr std::size_t kTold = 6;
    if (names.size() > kTold) names.resize(kTold);
    err.tell("reloaded " + counted(report.rebuilt.size(), "resource") + ", " +
             counted(std::size_t(tiles), "tile") + " to make anew, in " +
             std::to_string(std::lround(report.milliseconds)) + " ms" +
             (names.empty() ? "" : ": " + joined(names)) +
             (names.size() < report.rebuilt.size() ? "...\n" : "\n"));
}

/// Until the window is closed, or so many frames have been shown. Follows every edit; what is wrong
/// is shown, and waits for its repair. False when nothing could be drawn at last.
bool showFrames(Player& player, PlayerWindow& window, const RunOptions& options, Problems& problems,
                Messages& err) {
    EditFollower edits(player);
    problems.next();
    for (int i = 0; (options.frames < 0 || i < options.frames) && window.prepare(player); ++i) {
        const auto report = window.takeReload() ? edits.reload() : edits.follow();
        if (report) tellReload(*report, problems.next(), options, err);
        if (!player.frame()) {
            if (!player.drawable()) player.drawProblems();
            window.wait(player, 0.05); // nothing moves but the files
        }
        window.show(player);
    }
    return player.drawable();
}

/// Runs all lines, also after one that failed, so that one run tells everything.
/// A window shows each frame, and ends the script when it is closed.
bool runScript(Player& player, PlayerWindow* window, const RunOptions& options, Messages& err) {
    const auto text = readFile(options.script);
    if (!text) {
        err.tell("can't read the script " + shownPath(options.script) + "\n");
        return false;
    }
    const std::vector<ScriptLine> lines = parseScript(*text);
    bool good = true;
    const auto tell = [&](const ScriptLine& line, const std::string& problem) {
        if (problem.empty()) return;
        good = false;
        err.tell(shownPath(options.script) + ":" + std::to_string(line.number) +
                 ": error: " + problem + "\n    " + line.text + "\n");
    };
    for (const ScriptLine& line : lines)
        tell(line, line.problem);
    if (!good) return false; // a script that can't be understood is not run in part
    Progress progress(err, options.logLevel <= LogLevel::info);
    ScriptRunner runner(player, {.script = options.script.parent_path()},
                        [&](int frame, int frames) {
                            progress.tell(frame, frames);
                            return showFrame(player, window);
                        });
    for (const ScriptLine& line : lines) {
        const std::string problem = runner.run(line);
        if (window && window->closing()) break; // which stopped the line, and is no failure
        tell(line, problem);
    }
    return good;
}

/// Whoever wrote the lines judges the answers: a failed one is no failure of the run.
void runInteractively(Player& player, PlayerWindow* window, const RunStreams& streams) {
    ScriptRunner runner(player, {}, [&](int, int) { return showFrame(player, window); });
    const auto closing = [&] { return window && window->closing(); };
    std::string text;
    for (int number = 1; !closing() && std::getline(streams.in, text); ++number) {
        const auto line = parseScriptLine(text, number);
        std::string problem = line ? runner.run(*line) : std::string();
        for (char& c : problem) {
            if (c == '\n') c = ' '; // one line, one answer
        }
        streams.out << (problem.empty() ? "ok" : "error: " + problem) << std::endl;
    }
}

bool write(const fs::path& path, const std::string& text, Messages& err) {
    makeFolderOf(path);
    if (path.empty() || writeFile(path, text)) return true;
    err.tell("can't write " + shownPath(path) + "\n");
    return false;
}

bool writeResults(Player& player, const RunOptions& options, Messages& err) {
    bool good = true;
    makeFolderOf(options.screenshot);
    if (!options.screenshot.empty() && player.frames() > 0 &&
        !writePng(options.screenshot, player.capture())) {
        err.tell("can't write " + shownPath(options.screenshot) + "\n");
        good = false;
    }
    if (!options.metrics.empty())
        good &= write(options.metrics, player.metrics().dump(2) + "\n", err);
    good &= write(options.trace, player.traceJson(), err);
    return good;
}

} // namespace

int run(const Registry& registry, const RunOptions& options, const RunStreams& streams) {
    Messages err(streams.err); // as the next, used by the player's workers to its end
    Problems problems(err, options.logLevel);
    PlayerOptions playerOptions = options.player;
    playerOptions.recordFrames = !options.metrics.empty() || !options.script.empty();
    playerOptions.trace = !options.trace.empty();
    // A window shows what can be drawn, whatever else is wrong; scripts are for what is right.
    const bool watched = options.window && options.script.empty();
    playerOptions.keepGoing |= watched;
    playerOptions.showProblems |= watched;
    std::optional<PlayerWindow> window;
    if (options.window) window.emplace(nameOf(playerOptions.archive)).install(playerOptions);
    Player player(registry, playerOptions);
    player.diagnostics().onReport([&](const Diagnostic& d) { problems.tell(d); });
    bool good = player.load();
    tellSoftware(player, options, err);
    if (good && isInteractive(options))
        runInteractively(player, window ? &*window : nullptr, streams);
    else if (good && !options.script.empty())
        good = runScript(player, window ? &*window : nullptr, options, err);
    else if (watched && window->isOpen() && (good || options.frames < 0))
        good = showFrames(player, *window, options, problems, err);
    else if (good)
        good = drawFrames(player, options, err);
    // What a run that failed early can tell of itself is still worth having.
    if (player.resources()) good &= writeResults(player, options, err);
    if (good && player.frames() == 0 && !options.screenshot.empty()) {
        err.tell("no frame has been drawn that a screenshot could show\n");
        good = false;
    }
    if (!options.player.keepGoing) good &= player.diagnostics().errors() == 0;
    return good ? 0 : 1;
}

} // namespace terrane
