// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_task.h"

#include "scene/frame_builder.h"

namespace terrane {

void BoundStep::emit(FrameBuilder& frame) {
    frame.add(task_);
}

} // namespace terrane
