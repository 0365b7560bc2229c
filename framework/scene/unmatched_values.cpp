// SPDX-License-Identifier: BSD-3-Clause
#include "scene/unmatched_values.h"

#include "render/unmatched_uniforms.h"
#include "scene/scene_manager.h"

#include <set>

namespace terrane {

namespace {

// A node may be used several times.
void collect(const SceneNode& node, std::set<const SceneNode*>& seen,
             std::vector<NamedValue>& values) {
    if (!seen.insert(&node).second) return;
    for (const auto& [id, value] : node.values) {
        if (value.type != NodeValue::Type::sampler) values.push_back({id, value.place});
    }
    for (const auto& child : node.children)
        collect(*child, seen, values);
}

} // namespace

void reportUnmatchedValues(SceneManager& scene) {
    std::set<const SceneNode*> seen;
    std::vector<NamedValue> values;
    if (scene.root()) collect(*scene.root(), seen, values);
    reportUnmatchedValues(scene.resources(), values);
}

} // namespace terrane
