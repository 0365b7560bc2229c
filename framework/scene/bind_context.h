// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "resource/manager.h"
#include "resource/value.h"
#include "scene/scene_node.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace terrane {

class SceneManager;

/// Where a task is being bound: the node that owns the running method, and the loop variables. What
/// is resolved here stays resolved until the scene changes.
class BindContext {
public:
    BindContext(SceneManager& scene, SceneNode& owner)
        : scene_(scene)
        , owner_(&owner) {}

    SceneManager& scene() const { return scene_; }
    /// Owner of the method: `this`.
    SceneNode& owner() const { return *owner_; }
    Diagnostics& diagnostics() const;
    ResourceManager& resources() const;
    ResourceEntry& uses() const;

    /// The node of a target (ork reference 3): `this`, `$v`, or the first one with a flag, in
    /// document order. Null when there is none; nothing is reported.
    SceneNode* findNode(const std::string& target) const;

    /// The node of a qualified name; the owner itself must not be meant by a plain name. Null for a
    /// plain name, and, with a warning "unknown-target", when no node matches: the name is then
    /// taken as that of a resource, as archives of the original may rely on. An error when there is
    /// none either; resourceOf() then says no more.
    /// @param ending of the name of the resource
    SceneNode* nodeOf(const Attr<Target>& name, const std::string& ending = {}) const;

    /// The resource that a name stands for which has no node. Null, reported, when there is none.
    template <class T>
    Ref<T> resourceOf(const Attr<Target>& name) const {
        if (!name->node.empty() && !isResource(name->name)) return {};
        return resource<T>(name->name, name.place);
    }

    /// A resource by its name, which the frame needs from then on. Null, reported, when it can't be
    /// had.
    template <class T>
    Ref<T> resource(const std::string& name, const Place& place) const {
        return resources().get<T>(name, place, &uses());
    }

    /// A field of the target node (`this.terrain`), or a resource of a plain name. Null, with an
    /// error, when it is missing or no T.
    template <class T>
    T* field(const Attr<Target>& name) const {
        if (name->node.empty()) return resource<T>(name->name, name.place).get();
        SceneNode* const node = nodeOf(name);
        if (!node) return resourceOf<T>(name).get();
        T* const found = node->field<T>(name->name);
        const auto field = node->fields.find(name->name);
        const bool told = field != node->fields.end() && !field->second.get();
        if (!found && !told)
            reportMissing(name, *node, "field", node->fields,
                          resources().registry().describeInterface(typeid(T)));
        return found;
    }

    /// Tells that a node has no module, mesh, method... of a name, and the nearest that it has.
    template <class Map>
    void reportMissing(const Attr<Target>& name, const SceneNode& node, const std::string& what,
                       const Map& has, const std::string& expected = {}) const {
        std::vector<std::string> ids;
        for (const auto& entry : has)
            ids.push_back(entry.first);
        reportMissingOf(name, node, what, ids, expected);
    }
    /// `flag.name` with the nearest flag that a node has; empty when none is near.
    std::string suggestTarget(const Target& name) const;

    /// For the duration of a loop's body, and, as in the original, after the loop.
    void setVariable(const std::string& name, SceneNode* node);

    /// Has something done as soon as everything is bound, and so all programs are linked.
    void whenBound(std::function<void()> work) { whenBound_.push_back(std::move(work)); }
    /// Does what was left for then.
    void finish() const;

    /// Counts a call or a round of a loop. False, reported once, beyond what any frame needs.
    bool count(const Place& place);

    /// Enters a method of a node, until the object goes. Inactive when it is being bound already,
    /// since the methods then call one another in a circle, and when calls are nested too deeply.
    class Call {
    public:
        Call(BindContext& context, SceneNode& owner, const std::string& method);
        ~Call();
        Call(const Call&) = delete;
        Call& operator=(const Call&) = delete;
        explicit operator bool() const { return entered_; }

    private:
        BindContext& context_;
        SceneNode* caller_;
        bool entered_ = false;
    };

private:
    bool isResource(const std::string& name) const;
    void reportMissingOf(const Attr<Target>& name, const SceneNode& node, const std::string& what,
                         const std::vector<std::string>& has, const std::string& expected) const;

    static constexpr std::size_t kDeepestCall = 200;
    static constexpr int kMostTasks = 100000;

    SceneManager& scene_;
    SceneNode* owner_;
    int bound_ = 0;
    std::vector<std::pair<std::string, SceneNode*>> variables_;
    std::vector<std::pair<SceneNode*, std::string>> calls_;
    std::vector<std::function<void()>> whenBound_;
};

} // namespace terrane
