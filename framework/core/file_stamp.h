// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/file_tree.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace terrane {

/// What a file was like when it was last looked at, to tell later whether it says something else.
/// Its times and size are compared first; only where these differ, or prove nothing because the
/// file had just been written, its bytes are. Files of more than 64 MiB are known by times and size
/// alone. One in a zip has the checksum that the zip gives it instead of times.
class FileStamp {
public:
    /// What counts of a text, such as all but its comments. Null: every byte.
    using Significant = std::string (*)(std::string_view text);

    /// A stamp of a file that can't be read equals that of any other such file.
    /// @param files where the file is
    static FileStamp of(const std::filesystem::path& path, Significant significant = nullptr,
                        const FileTree& files = {});

    /// Whether the file says something else by now, or is gone, or is back.
    bool differs(const std::filesystem::path& path, const FileTree& files = {}) const;

private:
    struct Status {
        std::uintmax_t size = 0;
        std::filesystem::file_time_type written{}; ///< none in a zip
        std::uint32_t checksum = 0;                ///< none but in a zip
        bool operator==(const Status&) const = default;
    };

    static std::optional<Status> statusOf(const std::filesystem::path& path, const FileTree& files);
    std::optional<std::size_t> digestOf(const std::filesystem::path& path, const FileTree& files,
                                        const std::optional<Status>& status) const;

    Significant significant_ = nullptr;
    std::optional<Status> status_;      ///< none: there is no such file
    std::optional<std::size_t> digest_; ///< none: too large, or unreadable
    bool fresh_ = false; ///< written so shortly before that its times may not tell the next change
};

} // namespace terrane
