// SPDX-License-Identifier: BSD-3-Clause
#include "resource/predecessors.h"

#include <cstdint>
#include <map>
#include <string>
#include <tuple>

namespace terrane {

namespace {

/// Hands out elements by a key, each once, in document order.
template <class Key>
class Pool {
public:
    void add(Key key, const Child& child) { children_.emplace(std::move(key), &child); }

    const Child* take(const Key& key) {
        const auto found = children_.find(key);
        if (found == children_.end()) return nullptr;
        const Child* const child = found->second;
        children_.erase(found);
        return child;
    }

private:
    std::multimap<Key, const Child*> children_;
};

using Content = std::pair<const ElementDeclaration*, std::uint64_t>;
using Identity = std::pair<const ElementDeclaration*, std::string>;

Content contentOf(const Child& child) {
    return {child.declaration, child.description->fingerprint};
}

Identity identityOf(const Child& child) {
    const ElementDescription& d = *child.description;
    return {child.declaration, d.id->empty() ? *d.name : *d.id};
}

} // namespace

std::vector<const Child*> predecessors(const ElementDescription* before,
                                       const ElementDescription& now) {
    std::vector<const Child*> result(now.children.size(), nullptr);
    if (!before) return result;
    Pool<Content> byContent;
    for (const Child& child : before->children)
        byContent.add(contentOf(child), child);
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = byContent.take(contentOf(now.children[i]));
    Pool<Identity> byIdentity;
    for (const Child& child : before->children) {
        const Child* const left = byContent.take(contentOf(child));
        if (left && !identityOf(*left).second.empty()) byIdentity.add(identityOf(*left), *left);
    }
    for (std::size_t i = 0; i < result.size(); ++i) {
        if (!result[i]) result[i] = byIdentity.take(identityOf(now.children[i]));
    }
    return result;
}

} // namespace terrane
