// SPDX-License-Identifier: BSD-3-Clause
#include "scene/bind_context.h"

#include "core/text.h"
#include "scene/scene_manager.h"

#include <algorithm>

namespace terrane {

Diagnostics& BindContext::diagnostics() const {
    return scene_.resources().diagnostics();
}

ResourceManager& BindContext::resources() const {
    return scene_.resources();
}

ResourceEntry& BindContext::uses() const {
    return scene_.uses_;
}

SceneNode* BindContext::findNode(const std::string& target) const {
    if (target == "this") return owner_;
    if (target.starts_with('$')) {
        const std::string variable = target.substr(1);
        for (const auto& [name, node] : variables_) {
            if (name == variable) return node;
        }
        return nullptr;
    }
    const auto& nodes = scene_.ask(target, {});
    return nodes.empty() ? nullptr : nodes.front();
}

bool BindContext::isResource(const std::string& name) const {
    return resources().library().find(name).has_value();
}

SceneNode* BindContext::nodeOf(const Attr<Target>& name, const std::string& ending) const {
    if (name->node.empty()) return nullptr;
    SceneNode* const node = findNode(name->node);
    if (!node) {
        const bool resource = isResource(name->name + ending);
        diagnostics().report(
            {.severity = resource ? Severity::warning : Severity::error,
             .code = "unknown-target",
             .place = name.place,
             .message = "no node matches the target '" + name->node + "'" +
                        (resource ? "; '" + name->name + "' is taken as the name of a resource"
                                  : std::string()),
             .expected = "'this', '$variable' of a loop around it, or a flag of a node",
             .suggestion = suggestTarget(*name)});
    }
    return node;
}

std::string BindContext::suggestTarget(const Target& name) const {
    std::vector<std::string> targets = scene_.flags();
    targets.emplace_back("this");
    for (const auto& [variable, node] : variables_)
        targets.push_back("$" + variable);
    const std::string nearest = nearestName(name.node, targets);
    return nearest.empty() ? nearest : nearest + "." + name.name;
}

void BindContext::reportMissingOf(const Attr<Target>& name, const SceneNode& node,
                                  const std::string& what, const std::vector<std::string>& has,
                                  const std::string& expected) const {
    const std::string which = node.name.empty() ? "the node" : "node '" + node.name + "'";
    const std::string nearest = nearestName(name->name, has);
    diagnostics().report({.code = "missing-" + what,
                          .place = name.place,
                          .message = which + " has no " + what + " '" + name->name + "'",
                          .expected = expected,
                          .suggestion = nearest.empty() ? nearest : name->node + "." + nearest});
}

void BindContext::setVariable(const std::string& name, SceneNode* node) {
    const auto known = std::find_if(variables_.begin(), variables_.end(),
                                    [&](const auto& v) { return v.first == name; });
    if (known != variables_.end())
        known->second = node;
    else
        variables_.emplace_back(name, node);
}

BindContext::Call::Call(BindContext& context, SceneNode& owner, const std::string& method)
    : context_(context)
    , caller_(context.owner_) {
    const auto call = std::make_pair(&owner, method);
    auto& calls = context.calls_;
    if (calls.size() >= kDeepestCall) return;
    if (std::find(calls.begin(), calls.end(), call) != calls.end()) return;
    calls.push_back(call);
    context.scene_.calledMethods_.insert(call);
    context.owner_ = &owner;
    entered_ = true;
}

void BindContext::finish() const {
    for (const auto& work : whenBound_)
        work();
}

bool BindContext::count(const Place& place) {
    if (++bound_ <= kMostTasks) return true;
    if (bound_ == kMostTasks + 1) {
        diagnostics().error("too-many", place,
                            "the methods of the frame call one another too many times",
                            "at most " + std::to_string(kMostTasks) + " calls and rounds of loops");
    }
    return false;
}

BindContext::Call::~Call() {
    if (!entered_) return;
    context_.calls_.pop_back();
    context_.owner_ = caller_;
}

} // namespace terrane
