// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

/// Anything that an archive describes: textures, programs, nodes, tasks, producers... Built from a
/// typed description by the builder of its declaration, owned by the ResourceManager, or by its
/// parent when it is nested in another element. Derive once and not virtually.
class Resource {
public:
    Resource() = default;
    Resource(const Resource&) = delete;
    Resource& operator=(const Resource&) = delete;
    virtual ~Resource() = default;

protected:
    Resource(Resource&&) = default;
    Resource& operator=(Resource&&) = default;
};

} // namespace terrane
