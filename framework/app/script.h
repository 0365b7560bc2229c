// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/input_event.h"
#include "ui/view_controller.h"

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// Scripts: lines that move the camera, draw frames and check what came of it. Blank lines and
/// lines that start with '#' are nothing. Words are separated by blanks; one with blanks stands in
/// double quotes.
namespace terrane {

enum class Comparison { equal, notEqual, less, lessOrEqual, greater, greaterOrEqual };
bool holds(double left, Comparison comparison, double right);

struct CameraCommand {
    View from; ///< degrees
    std::optional<View> to;
    int frames = 0; ///< of the flight to `to`
};
struct FramesCommand {
    int count = 0;
};
struct WaitCommand {
    int maxFrames = 0;
};
struct ScreenshotCommand {
    std::string file;
};
struct MarkCommand {};
struct ReloadCommand {};
/// `archive PATH` and `needs PATH`: for who runs fixtures.
struct ArchiveCommand {
    std::string path;
};
struct NeedsCommand {
    std::string path;
};
/// Sets an attribute of an entry of the archive.
struct SetCommand {
    std::string resource, attribute, value;
};
/// Events; a key that is neither held nor let go is both.
struct InputCommand {
    std::vector<InputEvent> events;
};
/// A modifier that goes with the events that follow.
struct ModifierCommand {
    bool Modifiers::*modifier = nullptr;
    bool down = false;
};
struct ExpectTilesCommand {
    std::string producer;
    Comparison comparison = Comparison::equal;
    double count = 0;
};
struct ExpectHeightCommand {
    double x = 0, y = 0, z = 0, tolerance = 0;
};
struct ExpectImageCommand {
    std::string file;
    std::optional<double> percent; ///< of the pixels may differ
};
struct ExpectDiagnosticCommand {
    std::string code;
    std::string place; ///< "file:line:col", or just "-" for one without a place
};
struct ExpectMetricCommand {
    std::string pointer; ///< a JSON pointer, such as /caches/elevations/used
    Comparison comparison = Comparison::equal;
    double value = 0;
};
struct ExpectNoErrorsCommand {};

using ScriptCommand =
    std::variant<CameraCommand, FramesCommand, WaitCommand, ScreenshotCommand, MarkCommand,
                 ReloadCommand, ArchiveCommand, NeedsCommand, SetCommand, InputCommand,
                 ModifierCommand, ExpectTilesCommand, ExpectHeightCommand, ExpectImageCommand,
                 ExpectDiagnosticCommand, ExpectMetricCommand, ExpectNoErrorsCommand>;

/// A line that says something: a command, or why it is none.
struct ScriptLine {
    int number = 0; ///< from 1
    std::string text;
    std::optional<ScriptCommand> command;
    std::string problem;
};

/// Nothing for a blank line or a comment.
std::optional<ScriptLine> parseScriptLine(std::string_view text, int number);
std::vector<ScriptLine> parseScript(std::string_view text);

/// The manual: one line a command.
std::string scriptUsage();

} // namespace terrane
