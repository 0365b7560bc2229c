// SPDX-License-Identifier: BSD-3-Clause
#include "scene/uncalled_methods.h"

#include "scene/bind_context.h"
#include "scene/scene_manager.h"

#include <set>

namespace terrane {

namespace {

// Each may be a loop over all nodes.
constexpr int kMostMethods = 1000;

/// Binds methods one by one, and takes back what is told of variables that no loop has set.
class Checker {
public:
    explicit Checker(SceneManager& scene)
        : scene_(scene)
        , diagnostics_(scene.resources().diagnostics()) {}

    void run() {
        if (!scene_.root()) return;
        const std::size_t before = diagnostics_.size();
        check(*scene_.root());
        const std::vector<Diagnostic> all = diagnostics_.all();
        diagnostics_.forget(before, all.size());
        for (std::size_t i = before; i < all.size(); ++i) {
            if (!concernsVariable(all[i])) diagnostics_.report(all[i]);
        }
    }

private:
    void check(SceneNode& node) {
        if (!seen_.insert(&node).second) return; // it may be used several times
        for (const auto& [id, method] : node.methods) {
            if (!method.task || scene_.calledMethods().contains({&node, id})) continue;
            if (++methods_ > kMostMethods) return;
            bind(node, id, *method.task);
        }
        for (const auto& child : node.children)
            check(*child);
    }

    void bind(SceneNode& node, const std::string& id, const SceneTask& task) {
        BindContext context(scene_, node);
        const BindContext::Call call(context, node, id);
        const auto bound = task.bind(context);
        context.finish();
    }

    static bool concernsVariable(const Diagnostic& d) {
        return d.code == "unknown-target" && d.place &&
               d.place.file->text().substr(d.place.offset, 1) == "$";
    }

    SceneManager& scene_;
    Diagnostics& diagnostics_;
    std::set<const SceneNode*> seen_;
    int methods_ = 0;
};

} // namespace

void checkUncalledMethods(SceneManager& scene) {
    Checker(scene).run();
}

} // namespace terrane
