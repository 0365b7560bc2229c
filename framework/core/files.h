// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/file_tree.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace terrane {

/// The bytes of a regular file; empty when it can't be read (missing, a directory, no permission).
std::optional<std::string> readFile(const std::filesystem::path& path);

/// Makes the folders that a file is to be in, as far as it can.
void makeFolderOf(const std::filesystem::path& file);
/// Writes beside the target and renames, so that nobody ever sees half a file. False on failure.
bool writeFile(const std::filesystem::path& path, std::string_view bytes);

/// How a path is shown to people: relative to the working directory where that is shorter.
std::string shownPath(const std::filesystem::path& path);

/// The folder that holds Terrane's own "resources" (and "archives"), found from where the running
/// program or libterrane stands: an installed share/terrane, or a source tree above the build
/// folder. TERRANE_HOME overrides it. Empty when there is none.
std::filesystem::path homeFolder();

/// Where names of resources and data files are looked up: folders in order, never recursive. They
/// may be in a zip; what is found has to be read through files(). Immutable after its set-up, so
/// any thread may search.
class SearchPath {
public:
    SearchPath() = default; ///< of the disk
    explicit SearchPath(FileTree files)
        : files_(std::move(files)) {}

    struct Found {
        std::filesystem::path path;
        bool caseDiffers = false; ///< found only by ignoring the case of the name
    };

    /// What the folders are in.
    const FileTree& files() const { return files_; }
    void add(std::filesystem::path folder);
    const std::vector<std::filesystem::path>& folders() const { return folders_; }

    /// True for a name that leaves the folders: absolute, or with a "..", and so is refused.
    static bool leavesFolders(std::string_view name);

    /// The first folder that has a regular file of this name ('\' counts as '/'); failing that, one
    /// whose case differs. Names that leave the folders are never found.
    std::optional<Found> find(std::string_view name) const;
    /// The same, of every folder that has one, in order.
    std::vector<Found> findAll(std::string_view name) const;

    /// Files in the folders whose names start with the name's folder part: candidates for "did you
    /// mean".
    std::vector<std::string> namesNear(std::string_view name) const;

private:
    std::optional<std::filesystem::path> findIgnoringCase(std::filesystem::path folder,
                                                          const std::filesystem::path& name) const;

    FileTree files_;
    std::vector<std::filesystem::path> folders_;
};

} // namespace terrane
