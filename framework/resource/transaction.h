// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/entry.h"

#include <map>
#include <vector>

namespace terrane {

/// What a reload keeps until it is known whether what it builds is good.
struct Transaction {
    std::map<ResourceEntry*, ResourceVersion> replaced; ///< as they were
    std::vector<ResourceEntry*> added;                  ///< of names that were not loaded before

    /// Whether what an entry gives is another instance than before.
    bool touches(ResourceEntry* entry) const { return replaced.contains(entry); }
    const ResourceVersion* previous(ResourceEntry* entry) const {
        const auto found = replaced.find(entry);
        return found == replaced.end() ? nullptr : &found->second;
    }
};

} // namespace terrane
