// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/context.h"
#include "ui/view_controller.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace terrane {

/// Frames that are drawn at most while the picture is not complete.
inline constexpr int kMostFrames = 1000;

/// What a player is to load and how it is to draw it.
struct PlayerOptions {
    std::filesystem::path archive;            ///< an .xml, or the folder of an archive
    std::vector<std::filesystem::path> paths; ///< more folders for names, in order
    int width = 1024;                         ///< of the picture, pixels
    int height = 768;
    double timeStep = 1.0 / 60; ///< seconds a frame; 0 follows the real time
    std::optional<View> view;   ///< instead of the archive's start view; in degrees
    bool keepGoing = false;     ///< draw what can be built, in spite of errors
    bool showProblems = false;  ///< write the errors of the last load or reload over the picture
    bool debug = false;         ///< GL errors become diagnostics
    float maxAnisotropy = 0;    ///< 0: 1 on a software renderer, else the driver's limit
    bool recordFrames = false;  ///< keep the times of each frame for the metrics
    bool trace = false;         ///< keep the times of each task
    HeadlessKind headless = HeadlessKind::any; ///< what draws where there is no window
    /// Makes the context instead, such as a window's; called when the archive has been read.
    std::function<std::unique_ptr<GlContext>(Diagnostics&, const GlContext::Options&)> makeContext;
    /// Counts allocations since the program started; null where nobody counts them.
    std::uint64_t (*allocations)() = nullptr;
};

/// "1024x768": both at least 1 and at most 16384.
struct PictureSize {
    int width = 0, height = 0;
};
std::optional<PictureSize> parseSize(std::string_view text);

/// "x0,y0,theta,phi,d" in metres and degrees, see TerrainViewController::fromDegrees.
std::optional<View> parseView(std::string_view text);

} // namespace terrane
