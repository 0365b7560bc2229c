// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace terrane {

class RandomAccessFile;
class ZipFile;

/// Where files are read from: the disk, and, if there is one, a zip as if it were a folder of its
/// path, so that "scene.zip/archive.xml" is a file in it. Whoever reads files of an archive asks
/// here, and need not know which it is. Cheap to copy; immutable, so any thread may read.
class FileTree {
public:
    FileTree() = default; ///< the disk alone
    explicit FileTree(std::shared_ptr<const ZipFile> zip)
        : zip_(std::move(zip)) {}

    /// Null without a zip.
    const ZipFile* zip() const { return zip_.get(); }
    /// The name in the zip, if the path leads there; that of the zip itself is "".
    std::optional<std::string> nameInZip(const std::filesystem::path& path) const;

    bool isFile(const std::filesystem::path& path) const;
    bool isFolder(const std::filesystem::path& path) const;
    /// Names of the files and folders in a folder, sorted.
    std::vector<std::string> namesIn(const std::filesystem::path& folder) const;

    /// The bytes of a file; nothing when it can't be read. The reason is told where there is one
    /// beyond that.
    std::optional<std::string> read(const std::filesystem::path& path,
                                    std::string* problem = nullptr) const;
    /// The same, to be read in pieces.
    std::unique_ptr<RandomAccessFile> open(const std::filesystem::path& path,
                                           std::string* problem = nullptr) const;

private:
    std::shared_ptr<const ZipFile> zip_;
};

} // namespace terrane
