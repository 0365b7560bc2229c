// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/player_input.h"
#include "app/script.h"
#include "core/source.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace terrane {

class Player;

/// Where the file names of a script lead.
struct ScriptFolders {
    std::filesystem::path script;  ///< what `expect image` and `expect diagnostic` name
    std::filesystem::path output;  ///< where `screenshot` writes
    std::filesystem::path failure; ///< where actual and difference pictures go; empty: nowhere
    bool updatePictures = false;   ///< `expect image` writes a picture that does not agree
};

/// Told after each frame of a command that draws several: how many are drawn, of how many at most.
/// False stops the command.
using FrameObserver = std::function<bool(int frame, int frames)>;

/// Runs the commands of a script on a loaded player.
class ScriptRunner {
public:
    ScriptRunner(Player& player, ScriptFolders folders, FrameObserver observer = {})
        : player_(player)
        , folders_(std::move(folders))
        , observer_(std::move(observer)) {}

    /// Empty when the line did what it says; else why not.
    std::string run(const ScriptLine& line);

    /// Diagnostics that the script expected and that were reported.
    const std::vector<ExpectDiagnosticCommand>& expectedDiagnostics() const { return expected_; }

    /// What became of pictures that were updated, a line each.
    const std::vector<std::string>& updates() const { return updates_; }

private:
    std::string run(const CameraCommand& command);
    std::string run(const FramesCommand& command);
    std::string run(const WaitCommand& command);
    std::string run(const ScreenshotCommand& command);
    std::string run(const MarkCommand& command);
    std::string run(const ReloadCommand& command);
    std::string run(const ArchiveCommand& command);
    std::string run(const NeedsCommand& command);
    std::string run(const SetCommand& command);
    std::string run(const InputCommand& command);
    std::string run(const ModifierCommand& command);
    std::string run(const ExpectTilesCommand& command);
    std::string run(const ExpectHeightCommand& command);
    std::string run(const ExpectImageCommand& command);
    std::string run(const ExpectDiagnosticCommand& command);
    std::string run(const ExpectMetricCommand& command);
    std::string run(const ExpectNoErrorsCommand& command);
    std::string drawFrame(int frame, int frames);
    void complete(InputEvent& event);

    Player& player_;
    const ScriptFolders folders_;
    const FrameObserver observer_;
    std::vector<ExpectDiagnosticCommand> expected_;
    std::vector<std::string> updates_;
    PlayerInput input_;
    Modifiers modifiers_;
    glm::dvec2 pointer_{0}; ///< pixels
};

/// The place of a diagnostic as scripts write it: "file:line:col" with the file relative to a
/// folder; "-" without a place.
std::string placeInScript(const Place& place, const std::filesystem::path& folder);

} // namespace terrane
