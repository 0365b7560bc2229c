// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <vector>

namespace terrane {

/// Notices that files of some folders were written, made, renamed or deleted. Watches on a thread
/// of its own, by what the system tells of folders, or by looking at them where it tells nothing;
/// asking costs one read of a flag. Which file it was is for who asks to find out: editors write,
/// rename and delete more than what they show.
class FileWatcher {
public:
    enum class Method {
        events,  ///< of the system; polling for folders it has none for
        polling, ///< every `period`
    };
    struct Options {
        Method method = Method::events;
        /// A change is told when nothing more has happened for this long: editors take several
        /// steps to save.
        std::chrono::milliseconds quiet{15};
        /// ...or when it is this old, however much goes on.
        std::chrono::milliseconds patience{300};
        std::chrono::milliseconds period{250}; ///< of polling
    };

    FileWatcher();
    explicit FileWatcher(const Options& options);
    ~FileWatcher();
    FileWatcher(const FileWatcher&) = delete;
    FileWatcher& operator=(const FileWatcher&) = delete;

    /// The folders to watch from now on, instead of those before; not what is below them. One that
    /// is missing is watched as soon as it is there. A change is told as soon as new ones are
    /// watched, for what may have happened until then.
    void watch(std::vector<std::filesystem::path> folders);

    /// Whether something has happened since the last true answer. Cheap.
    bool takeChange();

private:
    class Loop;
    std::unique_ptr<Loop> loop_;
};

} // namespace terrane
