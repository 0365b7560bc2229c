// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a script, and as a view and a size of a picture.
#include "app/options.h"
#include "app/script.h"
#include "core/text.h"
#include "require.h"

#include <cmath>
#include <cstdint>
#include <string_view>

using namespace terrane;
using test::require;

namespace {

void checkView(const View& view) {
    for (const double value : {view.x0, view.y0, view.theta, view.phi, view.d})
        require(std::isfinite(value), "a view is finite");
    require(view.d > 0, "a view is from a distance");
}

struct CheckEvent {
    void operator()(const KeyEvent&) const {}
    void operator()(const TextEvent& event) const {
        require(event.character <= 0x10ffff, "a character is one of Unicode");
    }
    void operator()(const MouseButtonEvent&) const {}
    void operator()(const MouseMoveEvent& event) const {
        require(std::isfinite(event.x) && std::isfinite(event.y), "the mouse is somewhere");
    }
    void operator()(const WheelEvent& event) const {
        require(std::isfinite(event.steps), "the wheel stands still some time");
    }
};

struct CheckCommand {
    void operator()(const CameraCommand& command) const {
        checkView(command.from);
        if (command.to) checkView(*command.to);
        require(!command.to || command.frames > 0, "a flight takes frames");
    }
    void operator()(const FramesCommand& command) const {
        require(command.count >= 0, "frames are counted");
    }
    void operator()(const WaitCommand& command) const {
        require(command.maxFrames >= 0, "frames are counted");
    }
    void operator()(const SetCommand& command) const {
        require(!command.resource.empty() && !command.attribute.empty(), "something is set");
    }
    void operator()(const InputCommand& command) const {
        for (const InputEvent& event : command.events)
            std::visit(CheckEvent{}, event);
    }
    void operator()(const ExpectTilesCommand& command) const {
        require(std::isfinite(command.count), "tiles are counted");
    }
    void operator()(const ExpectHeightCommand& c) const {
        for (const double value : {c.x, c.y, c.z, c.tolerance})
            require(std::isfinite(value), "a height is finite");
    }
    void operator()(const ExpectImageCommand& command) const {
        require(!command.percent || std::isfinite(*command.percent), "a share is finite");
    }
    void operator()(const ExpectMetricCommand& command) const {
        require(std::isfinite(command.value), "a metric is finite");
    }
    template <class Other>
    void operator()(const Other&) const {}
};

void checkScript(std::string_view text) {
    const auto source = split(text, '\n');
    int last = 0;
    for (const ScriptLine& line : parseScript(text)) {
        require(line.number > last, "lines are in order");
        last = line.number;
        require(static_cast<std::size_t>(last) <= source.size(), "a line is one of the text");
        require(line.text == source[static_cast<std::size_t>(last) - 1], "a line says the same");
        require(line.command.has_value() == line.problem.empty(), "a command or a problem");
        const auto alone = parseScriptLine(line.text, last);
        require(alone && alone->problem == line.problem, "a line means the same alone");
        if (line.command) std::visit(CheckCommand{}, *line.command);
    }
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it so.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    checkScript(text);
    if (const auto view = parseView(text)) checkView(*view);
    if (const auto picture = parseSize(text))
        require(picture->width >= 1 && picture->height >= 1, "a picture has pixels");
    return 0;
}
