// SPDX-License-Identifier: BSD-3-Clause
// What edits of archives/mountains cost: from the save to the picture, and of that the reload
// itself.
#include "app/edit_follower.h"
#include "app/player.h"
#include "app/register_types.h"
#include "core/files.h"
#include "plugins/standard_plugins.h"
#include "resource/registry.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <unistd.h>

namespace terrane::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// A copy of the mountains that is played while it is edited.
class EditedMountains {
public:
    EditedMountains()
        : folder_(fs::temp_directory_path() / ("terrane-bench." + std::to_string(::getpid()))) {
        fs::remove_all(folder_);
        fs::copy(homeFolder() / "archives/mountains", folder_, fs::copy_options::recursive);
        registerStandardTypes(registry_);
        registerStandardPlugins(registry_);
        player_ = std::make_unique<Player>(registry_, PlayerOptions{.archive = folder_});
        good_ = player_->load() && player_->drawUntilComplete();
        for (const char* file : {"archive.xml", "ground.glsl"})
            texts_[file == std::string("archive.xml")] = readFile(folder_ / file).value_or("");
    }
    ~EditedMountains() {
        player_.reset();
        fs::remove_all(folder_);
    }
    EditedMountains(const EditedMountains&) = delete;
    EditedMountains& operator=(const EditedMountains&) = delete;

    bool good() const { return good_; }
    Player& player() { return *player_; }

    void saveShader(const std::string& line) {
        std::string text = texts_[0];
        text.insert(text.find("void main() {") + 13, "\n" + line);
        writeFile(folder_ / "ground.glsl", text);
    }
    void saveFlag(const std::string& flag) {
        std::string text = texts_[1];
        text.insert(text.find("flags=\"camera") + 13, "," + flag);
        writeFile(folder_ / "archive.xml", text);
    }
    void saveComment(const std::string& comment) {
        std::string text = texts_[1];
        text.insert(text.find("<archive>") + 9, "<!-- " + comment + " -->");
        writeFile(folder_ / "archive.xml", text);
    }

private:
    const fs::path folder_;
    Registry registry_;
    std::unique_ptr<Player> player_;
    std::string texts_[2]; ///< shader, archive
    bool good_ = false;
};

/// The save is not measured, the reload is.
template <class Save>
void reload(benchmark::State& state, Save save) {
    EditedMountains mountains;
    if (!mountains.good()) return state.SkipWithError("there are no mountains");
    int edit = 0;
    for (auto _ : state) {
        state.PauseTiming();
        save(mountains, edit++);
        state.ResumeTiming();
        if (!mountains.player().reload().good) state.SkipWithError("the edit is bad");
    }
}

void reloadNothing(benchmark::State& state) {
    reload(state, [](EditedMountains&, int) {});
}
BENCHMARK(reloadNothing)->Unit(benchmark::kMicrosecond);

void reloadComment(benchmark::State& state) {
    reload(state, [](EditedMountains& m, int i) { m.saveComment(std::to_string(i)); });
}
BENCHMARK(reloadComment)->Unit(benchmark::kMicrosecond);

/// Builds the scene's root and binds every method anew; compiles nothing.
void reloadFlag(benchmark::State& state) {
    reload(state, [](EditedMountains& m, int i) { m.saveFlag("flag" + std::to_string(i)); });
}
BENCHMARK(reloadFlag)->Unit(benchmark::kMicrosecond);

/// Compiles and links, mostly.
void reloadShader(benchmark::State& state) {
    reload(state, [](EditedMountains& m, int i) {
        m.saveShader("float edit" + std::to_string(i) + " = " + std::to_string(i) + ".0;");
    });
}
BENCHMARK(reloadShader)->Unit(benchmark::kMicrosecond);

double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * double(values.size() - 1))];
}

/// From the moment at which a shader is saved until the first frame with it is drawn, watcher
/// included, at the rate at which frames are drawn.
void saveToPicture(benchmark::State& state) {
    EditedMountains mountains;
    if (!mountains.good()) return state.SkipWithError("there are no mountains");
    Player& player = mountains.player();
    EditFollower edits(player);
    std::vector<double> all, watching, reloading;
    int edit = 0;
    for (auto _ : state) {
        for (int i = 0; i < 3; ++i) { // whatever the watcher still has to tell
            edits.follow();
            player.frame();
        }
        mountains.saveShader("float save" + std::to_string(edit++) + " = 1.0;");
        const Clock::time_point saved = Clock::now();
        double reloaded = 0;
        for (bool seen = false; !seen && Clock::now() - saved < std::chrono::seconds(10);) {
            const auto report = edits.follow();
            seen = report && report->changed;
            if (seen) reloaded = report->milliseconds;
            if (seen)
                watching.push_back(
                    std::chrono::duration<double, std::milli>(Clock::now() - saved).count() -
                    reloaded);
            player.frame();
            if (seen) player.capture(); // it is there
        }
        const double time = std::chrono::duration<double, std::milli>(Clock::now() - saved).count();
        all.push_back(time);
        reloading.push_back(reloaded);
        state.SetIterationTime(time / 1000);
    }
    state.counters["median_ms"] = quantile(all, 0.5);
    state.counters["p90_ms"] = quantile(all, 0.9);
    state.counters["worst_ms"] = quantile(all, 1);
    state.counters["noticed_ms"] = quantile(watching, 0.5);
    state.counters["reload_ms"] = quantile(reloading, 0.5);
}
BENCHMARK(saveToPicture)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(60);

} // namespace
} // namespace terrane::bench
