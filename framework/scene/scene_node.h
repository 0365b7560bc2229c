// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/box.h"
#include "core/frustum.h"
#include "resource/resource.h"
#include "resource/value.h"

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace terrane {

class Mesh;
class Module;
class SceneTask;
class Texture;

/// A value that a node hands to shaders (`uniform*` children).
struct NodeValue {
    enum class Type { floats, doubles, integers, unsignedIntegers, booleans, sampler };
    Type type = Type::floats;
    int components = 0; ///< 1..4; 0 for samplers
    glm::dvec4 value{0};
    Ref<Texture> texture;
    Place place; ///< of its id
};

/// What a node does when a callMethod asks for it.
struct NodeMethod {
    Ref<SceneTask> task;
    bool enabled = true;
};

/// A node of the scene graph: a transformation, and what hangs at it, keyed by id. Flags (its name
/// is one of them) let methods find it. Frames are double precision, right-handed, column vectors;
/// `SceneManager::update` fills in all that depends on the parents and on the camera.
class SceneNode : public Resource {
public:
    std::string name;
    std::vector<std::string> flags; ///< the name included
    Place flagsPlace;               ///< of the first one; none without the attribute
    Place place;                    ///< of its element; none for a node that no archive describes
    glm::dmat4 localToParent{1};    ///< ignored on the root, whose frame is the world
    glm::dmat4 described{1};        ///< localToParent as the archive says it
    Box localBounds;                ///< of what is drawn at this node itself

    // References to what could not be had are empty.
    std::map<std::string, NodeValue, std::less<>> values;
    std::map<std::string, Ref<Module>, std::less<>> modules;
    std::map<std::string, Ref<Mesh>, std::less<>> meshes;
    std::map<std::string, NodeMethod, std::less<>> methods;
    std::vector<std::shared_ptr<SceneNode>> children;
    /// Nodes below this one and itself; one that is referenced several times counts each time.
    std::size_t size = 1;

    /// Resources of any other type: named by a <field>, or nested and owned by the node.
    struct Field {
        Ref<Resource> reference;
        std::shared_ptr<Resource> owned;
        Resource* get() const { return owned ? owned.get() : reference.get(); }
    };
    std::map<std::string, Field, std::less<>> fields;

    bool hasFlag(std::string_view flag) const;
    /// A field by id if it is a T; else null.
    template <class T>
    T* field(std::string_view id) const {
        const auto found = fields.find(id);
        return found == fields.end() ? nullptr : dynamic_cast<T*>(found->second.get());
    }
    template <class T>
    std::vector<T*> fieldsOf() const {
        std::vector<T*> result;
        for (const auto& [id, field] : fields) {
            if (auto* found = dynamic_cast<T*>(field.get())) result.push_back(found);
        }
        return result;
    }

    // Since the last SceneManager::update.
    glm::dmat4 localToWorld{1};
    glm::dmat4 localToCamera{1};
    glm::dmat4 localToScreen{1};
    Box worldBounds; ///< of the node and its descendants
    Visibility visibility = Visibility::none;

    glm::dvec3 worldPosition() const { return glm::dvec3(localToWorld[3]); }
};

class Registry;
/// <node> with its transforms, bounds, values, modules, meshes, fields, methods and nodes.
void declareSceneNode(Registry& registry);

} // namespace terrane
