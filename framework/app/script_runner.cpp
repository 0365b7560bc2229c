// SPDX-License-Identifier: BSD-3-Clause
#include "app/script_runner.h"

#include "app/player.h"
#include "core/files.h"
#include "core/image.h"
#include "core/text.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace terrane {

namespace fs = std::filesystem;

namespace {

constexpr const char* kNothing = "there is nothing to draw";
constexpr const char* kStopped = "stopped before its end";

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", value);
    return text;
}

std::optional<Image> readPicture(const fs::path& path, std::string& problem) {
    const auto bytes = readFile(path);
    if (!bytes) {
        problem = "there is no picture " + shownPath(path);
        return std::nullopt;
    }
    Diagnostics diagnostics;
    auto image = decodeImage(*bytes, path.string(), diagnostics, {});
    if (!image || image->type != PixelType::u8) {
        problem = shownPath(path) + " is no picture";
        return std::nullopt;
    }
    return image;
}

bool write(const fs::path& path, const Image& image) {
    makeFolderOf(path);
    return writePng(path, image);
}

} // namespace

std::string placeInScript(const Place& place, const fs::path& folder) {
    if (!place) return "-";
    const LineColumn at = place.position();
    std::error_code error;
    const fs::path file = fs::weakly_canonical(place.file->path(), error);
    const fs::path base = fs::weakly_canonical(folder.empty() ? "." : folder, error);
    return file.lexically_proximate(base).generic_string() + ":" + std::to_string(at.line) + ":" +
           std::to_string(at.column);
}

std::string ScriptRunner::run(const ScriptLine& line) {
    if (!line.command) return line.problem;
    const bool drawsNothing = std::holds_alternative<ExpectDiagnosticCommand>(*line.command) ||
                              std::holds_alternative<ExpectNoErrorsCommand>(*line.command) ||
                              std::holds_alternative<ReloadCommand>(*line.command);
    if (!drawsNothing && !player_.drawable()) return kNothing;
    return std::visit([this](const auto& command) { return run(command); }, *line.command);
}

std::string ScriptRunner::drawFrame(int frame, int frames) {
    input_.advance(player_, player_.options().timeStep);
    if (!player_.frame()) return kNothing;
    if (observer_ && !observer_(frame, frames)) return kStopped;
    return {};
}

std::string ScriptRunner::run(const CameraCommand& command) {
    TerrainViewController& controller = player_.controller();
    const View from = controller.fromDegrees(command.from);
    if (!command.to) {
        controller.view = from;
        return {};
    }
    const View to = controller.fromDegrees(*command.to);
    for (int i = 0; i < command.frames; ++i) {
        const double t = command.frames == 1 ? 1 : double(i) / (command.frames - 1);
        controller.view = controller.between(from, to, t);
        if (const std::string problem = drawFrame(i + 1, command.frames); !problem.empty())
            return problem;
    }
    return {};
}

std::string ScriptRunner::run(const FramesCommand& command) {
    for (int i = 0; i < command.count; ++i) {
        if (const std::string problem = drawFrame(i + 1, command.count); !problem.empty())
            return problem;
    }
    return {};
}

std::string ScriptRunner::run(const WaitCommand& command) {
    for (int i = 0; i < command.maxFrames && !player_.complete(); ++i) {
        if (const std::string problem = drawFrame(i + 1, command.maxFrames); !problem.empty())
            return problem;
    }
    if (player_.complete()) return {};
    return "the picture is not complete after " + std::to_string(command.maxFrames) + " frames";
}

std::string ScriptRunner::run(const ScreenshotCommand& command) {
    if (player_.frames() == 0) return "no frame has been drawn yet";
    const fs::path path = folders_.output / command.file;
    if (!write(path, player_.capture())) return "can't write " + shownPath(path);
    return {};
}

std::string ScriptRunner::run(const MarkCommand&) {
    player_.mark();
    return {};
}

// What is wrong is told as always, and is for `expect` to judge: a script may want it so.
std::string ScriptRunner::run(const ReloadCommand&) {
    player_.reload();
    return {};
}

std::string ScriptRunner::run(const ArchiveCommand&) {
    return "'archive' stands in the first line of fixtures only";
}

std::string ScriptRunner::run(const NeedsCommand&) {
    return "'needs' stands in fixtures only";
}

std::string ScriptRunner::run(const SetCommand& command) {
    return player_.set(command.resource, command.attribute, command.value);
}

std::string ScriptRunner::run(const InputCommand& command) {
    for (InputEvent event : command.events) {
        complete(event);
        if (presses(event, Key::f5))
            player_.reload();
        else
            input_.handle(player_, event);
    }
    return {};
}

// Where the pointer is, and which modifiers are held, lines before have said.
void ScriptRunner::complete(InputEvent& event) {
    if (auto* move = std::get_if<MouseMoveEvent>(&event)) pointer_ = {move->x, move->y};
    if (auto* key = std::get_if<KeyEvent>(&event)) key->modifiers = modifiers_;
    if (auto* wheel = std::get_if<WheelEvent>(&event)) wheel->modifiers = modifiers_;
    if (auto* button = std::get_if<MouseButtonEvent>(&event)) {
        button->modifiers = modifiers_;
        button->x = pointer_.x;
        button->y = pointer_.y;
    }
}

std::string ScriptRunner::run(const ModifierCommand& command) {
    modifiers_.*command.modifier = command.down;
    return {};
}

std::string ScriptRunner::run(const ExpectTilesCommand& command) {
    const std::int64_t tiles = player_.counters().tiles(*player_.resources(), command.producer);
    if (tiles < 0) return "there is no producer '" + command.producer + "'";
    if (holds(double(tiles), command.comparison, command.count)) return {};
    return "'" + command.producer + "' made " + std::to_string(tiles) + " tiles";
}

std::string ScriptRunner::run(const ExpectHeightCommand& command) {
    if (player_.frames() == 0) return "no frame has been drawn yet";
    const auto place = player_.placeAt(command.x, command.y);
    if (!place) return "there is no terrain at this place";
    const auto found = player_.elevationAt(*place);
    if (!found) return "there is no tile with elevations at this place";
    if (std::abs(found->elevation - command.z) <= command.tolerance) return {};
    return "the elevation is " + number(found->elevation) + ", of a tile of level " +
           std::to_string(found->level);
}

std::string ScriptRunner::run(const ExpectImageCommand& command) {
    if (player_.frames() == 0) return "no frame has been drawn yet";
    const fs::path path = folders_.script / command.file;
    const Image actual = player_.capture();
    std::string problem;
    const auto expected = readPicture(path, problem);
    double share = kPictureShare;
    if (command.percent) share = *command.percent / 100;
    if (expected) {
        const PictureDifference difference = comparePictures(actual, *expected);
        if (difference.agree(share)) return {};
        problem = difference.toString();
    }
    if (folders_.failure.empty() && !folders_.updatePictures) return problem;
    // Who updates a picture is shown what it was.
    const Image& other = folders_.updatePictures && expected ? *expected : actual;
    if (!folders_.failure.empty() && (expected || !folders_.updatePictures)) {
        const fs::path shown = folders_.failure / fs::path(command.file).filename();
        write(shown, other);
        problem += "; see " + shownPath(shown);
        if (expected) {
            fs::path difference = shown;
            difference.replace_extension(".difference.png");
            write(difference, differenceImage(actual, *expected));
            problem += " and " + shownPath(difference);
        }
    }
    if (!folders_.updatePictures) return problem;
    if (!write(path, actual)) return "can't write " + shownPath(path);
    updates_.push_back("updated " + shownPath(path) + ": " + problem);
    return {};
}

std::string ScriptRunner::run(const ExpectDiagnosticCommand& command) {
    std::string nearest;
    std::vector<std::string> places;
    for (const Diagnostic& diagnostic : player_.diagnostics().all()) {
        const std::string place = placeInScript(diagnostic.place, folders_.script);
        if (diagnostic.code == command.code && place == command.place) {
            expected_.push_back(command);
            return {};
        }
        if (diagnostic.code == command.code) nearest += (nearest.empty() ? "" : ", ") + place;
        places.push_back(diagnostic.code + " " + place);
    }
    if (!nearest.empty()) return "'" + command.code + "' is reported at " + nearest;
    if (places.empty()) return "nothing is reported";
    return "only reported: " + listOfNames(places);
}

std::string ScriptRunner::run(const ExpectMetricCommand& command) {
    const nlohmann::ordered_json metrics = player_.metrics();
    const nlohmann::ordered_json* value = nullptr;
    try {
        const nlohmann::ordered_json::json_pointer pointer(command.pointer);
        if (metrics.contains(pointer)) value = &metrics.at(pointer);
    } catch (const nlohmann::json::exception&) { // misuse of '~', or of a number
    }
    if (!value || !value->is_number()) return "there is no number at '" + command.pointer + "'";
    if (holds(value->get<double>(), command.comparison, command.value)) return {};
    return "'" + command.pointer + "' is " + number(value->get<double>());
}

std::string ScriptRunner::run(const ExpectNoErrorsCommand&) {
    for (const Diagnostic& diagnostic : player_.diagnostics().all()) {
        if (diagnostic.severity == Severity::error) return toString(diagnostic);
    }
    return {};
}

} // namespace terrane
