// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_node.h"

#include <algorithm>

namespace terrane {

bool SceneNode::hasFlag(std::string_view flag) const {
    return std::find(flags.begin(), flags.end(), flag) != flags.end();
}

} // namespace terrane
