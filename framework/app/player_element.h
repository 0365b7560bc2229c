// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/description.h"
#include "resource/value.h"
#include "task/scheduler.h"
#include "ui/view_controller.h"

#include <optional>
#include <string>

namespace terrane {

class Library;
class Registry;
class SceneNode;

/// What an archive says about how it is to be played: its <player> and <view> elements, or the
/// conventions of the original where it has none (terrain reference 6).
struct PlayerSettings {
    Ref<SceneNode> root{"scene"};
    Attr<std::string> camera = "camera"; ///< flag of the camera node
    Attr<std::string> method = "draw";   ///< of that node; draws a frame
    Ref<Scheduler> scheduler{"defaultScheduler"};
    std::optional<View> view;                       ///< radians
    bool rootGiven = false, schedulerGiven = false; ///< the archive names them itself
};

/// Allows <player root camera method scheduler ui view> and <view> at the top of archives.
void declarePlayerElements(Registry& registry);

/// Reads them from the archives of a library; problems are reported to its diagnostics. References
/// are not resolved.
PlayerSettings readPlayerSettings(Library& library, const Registry& registry);

} // namespace terrane
