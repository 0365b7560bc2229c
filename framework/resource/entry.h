// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/file_stamp.h"
#include "resource/description.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace terrane {

struct ElementDeclaration;
struct ResourceEntry;

/// A file that a resource was made from, and the name that led there.
struct UsedFile {
    std::string name;
    std::filesystem::path path; ///< empty: there was no such file, and the resource did without it
    FileStamp stamp;            ///< from before it was read
    bool inPieces = false;      ///< what is never asked for is never read
};

/// What a resource is at the moment; a reload replaces all of it, or nothing.
struct ResourceVersion {
    enum class State {
        unloaded,
        loading,
        ready,
        planned, ///< of a type that is not built yet, or of data that is not prepared yet: there
                 ///< is no instance, and no error
        failed,  ///< there is no instance; the errors have been reported
    };

    State state = State::unloaded;
    const ElementDeclaration* declaration = nullptr;
    std::uint64_t fingerprint = 0;    ///< of its element; see XmlElement
    std::filesystem::path descriptor; ///< the XML file that describes it; empty: its name does
    std::shared_ptr<ElementDescription> description;
    std::shared_ptr<Resource> instance;
    std::vector<ResourceEntry*> dependencies; ///< what it names, directly
    /// Of these, those that it was made from: when they change, it has to be made anew. It sees a
    /// change of the others through its references.
    std::vector<ResourceEntry*> madeFrom;
    std::vector<UsedFile> files; ///< data files that it was made from
    bool incomplete = false;     ///< ready, but without something that an element in it names
    std::uint64_t order = 0;     ///< instances that were made later have greater numbers
};

/// A named resource in the manager's table. Its address is stable as long as anything refers to it;
/// a reload swaps the version in it.
struct ResourceEntry : ResourceVersion {
    std::string name;
    std::vector<ResourceEntry*> dependents; ///< what names it, directly
};

} // namespace terrane
