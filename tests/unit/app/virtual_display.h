// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/image.h"
#include "environment.h"
#include "temporary_folder.h"

#include <optional>
#include <string>
#include <sys/types.h>

namespace terrane::test {

/// An X server without a screen (Xvfb), and DISPLAY set to it, until the test is over. Its windows
/// have no frames, and stand in the upper left corner.
class VirtualDisplay {
public:
    VirtualDisplay();
    ~VirtualDisplay();
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;

    /// False where Xvfb is not installed or does not start: the test is to be skipped.
    bool running() const { return environment_.has_value(); }
    /// What the screen shows from the upper left corner on, as pictures are: RGB, last row first.
    Image screen(int width, int height) const;

    /// Moves the pointer, presses keys... as xdotool's words say. False without xdotool.
    static bool act(const std::string& words);

private:
    TemporaryFolder folder_;
    pid_t server_ = -1;
    std::optional<Environment> environment_;
};

} // namespace terrane::test
