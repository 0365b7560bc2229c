// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/description.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace terrane {

struct ElementDeclaration;

/// A named resource in the manager's table. Its address is stable for the life of the manager; a
/// reload swaps the instance in it.
struct ResourceEntry {
    enum class State {
        unloaded,
        loading,
        ready,
        planned, ///< of a type that is not built yet: there is no instance, and no error
        failed,  ///< there is no instance; the errors have been reported
    };

    std::string name;
    State state = State::unloaded;
    const ElementDeclaration* declaration = nullptr;
    std::shared_ptr<ElementDescription> description;
    std::shared_ptr<Resource> instance;
    std::vector<ResourceEntry*> dependencies; ///< what it names, directly
    std::vector<ResourceEntry*> dependents;   ///< what names it, directly
    std::vector<std::filesystem::path> files; ///< data files that it was made from
};

} // namespace terrane
