// SPDX-License-Identifier: BSD-3-Clause
#include "scene/unmatched_flags.h"

#include "core/text.h"
#include "resource/value_traits.h"
#include "scene/scene_manager.h"

#include <algorithm>
#include <map>
#include <set>

namespace terrane {

namespace {

std::string withoutDigits(std::string text) {
    std::erase_if(text, [](char c) { return c >= '0' && c <= '9'; });
    return text;
}

/// The flags of nodes and those that methods ask for, told apart where they should be the same.
class Matcher {
public:
    explicit Matcher(SceneManager& scene)
        : scene_(scene)
        , asked_(scene.askedFlags())
        , diagnostics_(scene.resources().diagnostics()) {
        for (const auto& [flag, place] : asked_)
            askedNames_.push_back(flag);
    }

    void run() {
        const std::vector<std::string> flags = scene_.flags();
        const std::set<std::string> present(flags.begin(), flags.end());
        for (const auto& [flag, place] : asked_) {
            if (place && !present.contains(flag)) checkAsked(flag, place, flags);
        }
        if (scene_.root()) checkNode(*scene_.root());
    }

private:
    // What differs by a number alone is meant so.
    static std::string nearest(const std::string& flag, const std::vector<std::string>& others) {
        const std::string found = nearestName(flag, others);
        return withoutDigits(found) == withoutDigits(flag) ? std::string() : found;
    }

    void checkAsked(const std::string& flag, const Place& place,
                    const std::vector<std::string>& flags) {
        const std::string near = nearest(flag, flags);
        if (near.empty()) return;
        told_.emplace(near, flag);
        report(place, "no node has the flag " + inQuotes(flag), near);
    }

    void checkNode(const SceneNode& node) {
        // A node may be used several times; it has been looked at then.
        if (!seen_.insert(&node).second) return;
        detail::ValueWalker walker(node.flagsPlace);
        for (const std::string& flag : node.flags) {
            if (!walker.place()) break;
            const Place place = walker.place();
            walker.advance(flag.size() + 1);
            const bool isName = &flag == &node.flags.back() && flag == node.name;
            if (isName || asked_.contains(flag)) continue;
            const std::string near = nearestAsked(flag);
            if (near.empty() || told_.contains({flag, near})) continue;
            report(place, "no method of the frame asks for the flag " + inQuotes(flag), near);
        }
        for (const auto& child : node.children)
            checkNode(*child);
    }

    // A flag is mostly that of many nodes.
    const std::string& nearestAsked(const std::string& flag) {
        const auto [known, isNew] = nearest_.try_emplace(flag);
        if (isNew) known->second = nearest(flag, askedNames_);
        return known->second;
    }

    void report(const Place& place, std::string message, const std::string& near) {
        diagnostics_.report({.severity = Severity::warning,
                             .code = "unknown-flag",
                             .place = place,
                             .message = std::move(message),
                             .suggestion = near});
    }

    SceneManager& scene_;
    const std::map<std::string, Place>& asked_;
    Diagnostics& diagnostics_;
    std::vector<std::string> askedNames_;
    std::set<std::pair<std::string, std::string>> told_; ///< of a node, that asked for
    std::map<std::string, std::string> nearest_;
    std::set<const SceneNode*> seen_;
};

} // namespace

void reportUnmatchedFlags(SceneManager& scene) {
    Matcher(scene).run();
}

} // namespace terrane
