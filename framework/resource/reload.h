// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/manager.h"
#include "resource/transaction.h"

#include <memory>
#include <set>
#include <vector>

namespace terrane {

/// Replaces the resources that say something else by now, with all that was made from them, or
/// changes nothing (ork reference 1.6). To be made, used and ended between two frames.
///
///     Reload reload(resources, freshLibrary);
///     reload.rebuild();                 // references show the new versions from here on
///     ...                               // bind the scene to them
///     if (errors) reload.rollBack();    // all is as it was
///     else reload.commit(roots);        // the old versions go
///
/// A resource is affected when its element, a file it was made from, or what it found under a name
/// differs; when it could not be made before; and when it was made from one that is affected. GL
/// thread.
class Reload {
public:
    /// @param fresh the archives and search folders as they are now; must outlive the manager from
    ///     commit() on
    Reload(ResourceManager& manager, Library& fresh);
    /// Rolls back what was neither committed nor rolled back.
    ~Reload();
    Reload(const Reload&) = delete;
    Reload& operator=(const Reload&) = delete;

    /// What is affected; known from the start.
    const std::set<ResourceEntry*>& affected() const { return affected_; }
    /// What they were, after rebuild().
    const std::map<ResourceEntry*, ResourceVersion>& replaced() const {
        return transaction_.replaced;
    }

    /// Builds affected resources that unaffected ones refer to, and what they need. The others are
    /// built when they are asked for. Problems are reported as those of the first load are.
    void rebuild();

    /// Lets go of the old versions, and of all that none of the roots needs any more.
    void commit(const std::vector<ResourceEntry*>& roots);
    /// Brings the old versions back. Whoever refers to new ones must have let go of them.
    void rollBack();

private:
    bool isChanged(ResourceEntry& entry);
    bool isChanged(const UsedFile& file);
    void findAffected();
    void setAside(ResourceEntry& entry);
    std::set<ResourceEntry*> needed(const std::vector<ResourceEntry*>& roots) const;

    ResourceManager& manager_;
    Library& fresh_;
    Library& stale_;
    std::set<ResourceEntry*> affected_;
    std::set<ResourceEntry*> gone_; ///< of these: nothing has their name any more
    /// Where the names of files lead now.
    std::map<std::string, std::optional<std::filesystem::path>> found_;
    Transaction transaction_;
    bool open_ = true; ///< neither committed nor rolled back
};

} // namespace terrane
