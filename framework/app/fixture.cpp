// SPDX-License-Identifier: BSD-3-Clause
#include "app/fixture.h"

#include "app/player.h"
#include "app/script_runner.h"
#include "core/files.h"

#include <algorithm>
#include <optional>

namespace terrane {

namespace fs = std::filesystem;

namespace {

using Status = FixtureResult::Status;

template <class Command>
const Command* as(const ScriptLine& line) {
    return line.command ? std::get_if<Command>(&*line.command) : nullptr;
}

bool onlyDiagnostics(const std::vector<ScriptLine>& lines) {
    return std::all_of(lines.begin(), lines.end(), [](const ScriptLine& line) {
        return as<ArchiveCommand>(line) || as<NeedsCommand>(line) ||
               as<ExpectDiagnosticCommand>(line) || as<ExpectNoErrorsCommand>(line);
    });
}

bool expectsDiagnostics(const std::vector<ScriptLine>& lines) {
    return std::any_of(lines.begin(), lines.end(), [](const ScriptLine& line) {
        return as<ExpectDiagnosticCommand>(line) != nullptr;
    });
}

/// One fixture while it runs.
class Run {
public:
    Run(const Registry& registry, const fs::path& folder, const FixtureOptions& options)
        : registry_(registry)
        , folder_(folder)
        , options_(options) {}

    FixtureResult result() {
        if (readScript() && hasNeeds() && hasCommands() && chooseArchive()) play();
        return result_;
    }

private:
    void fail(const std::string& text) {
        result_.status = Status::failed;
        result_.report += text + (text.ends_with('\n') ? "" : "\n");
    }
    void failLine(const ScriptLine& line, const std::string& problem) {
        fail(shownPath(folder_ / "script") + ":" + std::to_string(line.number) + ": " + line.text +
             "\n    " + problem);
    }

    bool readScript() {
        const auto text = readFile(folder_ / "script");
        if (!text) return fail("can't read " + shownPath(folder_ / "script")), false;
        lines_ = parseScript(*text);
        for (const ScriptLine& line : lines_) {
            if (!line.command) failLine(line, line.problem);
            if (as<ArchiveCommand>(line) && &line != &lines_.front())
                failLine(line, "'archive' must be the first line");
        }
        return result_.status == Status::passed;
    }

    std::optional<fs::path> findData(const std::string& path) const {
        std::error_code error;
        if (fs::exists(folder_ / path, error)) return folder_ / path;
        for (const fs::path& folder : options_.data) {
            if (fs::exists(folder / path, error)) return folder / path;
        }
        return std::nullopt;
    }

    bool hasNeeds() {
        for (const ScriptLine& line : lines_) {
            const auto* needs = as<NeedsCommand>(line);
            if (!needs || findData(needs->path)) continue;
            result_ = {Status::skipped, "needs " + needs->path + "\n"};
            return false;
        }
        return true;
    }

    bool hasCommands() {
        const bool found = std::any_of(lines_.begin(), lines_.end(), [](const ScriptLine& line) {
            return !as<ArchiveCommand>(line) && !as<NeedsCommand>(line);
        });
        if (!found) fail(shownPath(folder_ / "script") + ": no command that proves anything");
        return found;
    }

    bool chooseArchive() {
        archive_ = folder_;
        if (lines_.empty()) return true;
        const auto* named = as<ArchiveCommand>(lines_.front());
        if (!named) return true;
        const auto found = findData(named->path);
        if (!found) return failLine(lines_.front(), "there is no such archive"), false;
        archive_ = *found;
        return true;
    }

    void play() {
        PlayerOptions options{.archive = archive_, .paths = options_.data, .debug = true};
        options.keepGoing = expectsDiagnostics(lines_);
        options.recordFrames = true;
        Player player(registry_, options);
        if (onlyDiagnostics(lines_)) {
            player.check();
        } else if (!player.load() && !options.keepGoing) {
            return failErrors(player, {});
        }
        ScriptRunner runner(player, {.script = folder_,
                                     .output = options_.output,
                                     .failure = options_.output,
                                     .updatePictures = options_.updatePictures});
        for (const ScriptLine& line : lines_) {
            if (as<ArchiveCommand>(line) || as<NeedsCommand>(line)) continue;
            const std::string problem = runner.run(line);
            if (!problem.empty()) failLine(line, problem);
        }
        for (const std::string& update : runner.updates())
            result_.report += update + "\n";
        failErrors(player, runner.expectedDiagnostics());
    }

    void failErrors(Player& player, const std::vector<ExpectDiagnosticCommand>& expected) {
        for (const Diagnostic& diagnostic : player.diagnostics().all()) {
            if (diagnostic.severity != Severity::error) continue;
            const std::string place = placeInScript(diagnostic.place, folder_);
            const bool known = std::any_of(expected.begin(), expected.end(), [&](const auto& e) {
                return e.code == diagnostic.code && e.place == place;
            });
            if (!known) fail("an error that no line expects:\n" + toString(diagnostic));
        }
    }

    const Registry& registry_;
    const fs::path folder_;
    const FixtureOptions& options_;
    std::vector<ScriptLine> lines_;
    fs::path archive_;
    FixtureResult result_;
};

bool isFixture(const fs::path& folder) {
    std::error_code error;
    return fs::is_regular_file(folder / "script", error);
}

} // namespace

std::vector<fs::path> findFixtures(const fs::path& path) {
    std::vector<fs::path> found;
    if (isFixture(path)) found.push_back(path);
    std::error_code error;
    for (fs::recursive_directory_iterator entry(path, error), end; entry != end;
         entry.increment(error)) {
        if (error) break;
        if (entry->is_directory(error) && isFixture(entry->path())) found.push_back(entry->path());
    }
    std::sort(found.begin(), found.end());
    return found;
}

FixtureResult runFixture(const Registry& registry, const fs::path& folder,
                         const FixtureOptions& options) {
    return Run(registry, folder, options).result();
}

} // namespace terrane
