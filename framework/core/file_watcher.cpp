// SPDX-License-Identifier: BSD-3-Clause
#include "core/file_watcher.h"

#include <algorithm>
#include <atomic>
#include <fcntl.h>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <sys/stat.h>
#include <thread>
#include <utility>
#include <uv.h>

namespace terrane {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

std::int64_t milliseconds(Clock::time_point time) {
    return std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count();
}

/// What tells a folder from another one that took its place: systems use numbers again.
struct Identity {
    std::uint64_t inode = 0; ///< 0: there is no such folder
    std::int64_t born = 0;   ///< nanoseconds, where the file system knows
    bool operator==(const Identity&) const = default;
};

Identity identityOf(const fs::path& folder) {
    struct statx status {};
    const int wanted = STATX_TYPE | STATX_INO | STATX_BTIME;
    if (::statx(AT_FDCWD, folder.c_str(), 0, wanted, &status) != 0 || !S_ISDIR(status.stx_mode))
        return {};
    return {status.stx_ino, status.stx_btime.tv_sec * 1000000000LL + status.stx_btime.tv_nsec};
}

/// Names, sizes and times of what is in a folder; 0 for one that is not there.
std::size_t signatureOf(const fs::path& folder) {
    std::size_t sum = 0;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        std::error_code ignored;
        const std::string text =
            entry->path().filename().string() + '/' + std::to_string(entry->file_size(ignored)) +
            '/' + std::to_string(entry->last_write_time(ignored).time_since_epoch().count());
        sum += std::hash<std::string>()(text) | 1; // in any order
    }
    return sum;
}

} // namespace

/// The thread, and all that only it may touch.
class FileWatcher::Loop {
public:
    explicit Loop(const Options& options)
        : options_(options) {
        uv_loop_init(&loop_);
        uv_async_init(&loop_, &wake_, [](uv_async_t* handle) { of(handle).update(); });
        uv_timer_init(&loop_, &timer_);
        wake_.data = timer_.data = this;
        const auto period = static_cast<std::uint64_t>(options_.period.count());
        uv_timer_start(
            &timer_, [](uv_timer_t* handle) { of(handle).poll(); }, period, period);
        thread_ = std::thread([this] { uv_run(&loop_, UV_RUN_DEFAULT); });
    }

    ~Loop() {
        stop_ = true;
        uv_async_send(&wake_);
        thread_.join();
        uv_loop_close(&loop_);
    }

    void watch(std::vector<fs::path> folders) {
        {
            const std::lock_guard lock(mutex_);
            wanted_ = std::move(folders);
        }
        uv_async_send(&wake_);
    }

    bool takeChange() {
        const std::int64_t first = first_.load(std::memory_order_relaxed);
        if (first == kNever) return false;
        const std::int64_t now = milliseconds(Clock::now());
        const bool quiet = now - last_.load(std::memory_order_relaxed) >= options_.quiet.count();
        if (!quiet && now - first < options_.patience.count()) return false;
        first_.store(kNever, std::memory_order_relaxed);
        return true;
    }

private:
    static constexpr std::int64_t kNever = -1;

    struct Folder {
        std::unique_ptr<uv_fs_event_t> events; ///< null: it is polled
        Identity identity;                     ///< of what is watched
        std::size_t signature = 0;             ///< of the last look, where it is polled
    };

    template <class Handle>
    static Loop& of(Handle* handle) {
        return *static_cast<Loop*>(handle->data);
    }

    void notice() {
        const std::int64_t now = milliseconds(Clock::now());
        last_.store(now, std::memory_order_relaxed);
        std::int64_t never = kNever;
        first_.compare_exchange_strong(never, now, std::memory_order_relaxed);
    }

    void update() {
        if (stop_) return close();
        std::vector<fs::path> wanted;
        {
            const std::lock_guard lock(mutex_);
            wanted = wanted_;
        }
        for (auto folder = folders_.begin(); folder != folders_.end();) {
            const bool kept =
                std::find(wanted.begin(), wanted.end(), folder->first) != wanted.end();
            if (!kept) stopEvents(folder->second);
            folder = kept ? std::next(folder) : folders_.erase(folder);
        }
        for (const fs::path& path : wanted) {
            const auto [folder, isNew] = folders_.try_emplace(path);
            if (!isNew) continue;
            start(path, folder->second);
            notice(); // nobody knows what happened before
        }
    }

    void start(const fs::path& path, Folder& folder) {
        folder.identity = identityOf(path);
        folder.signature = signatureOf(path);
        if (options_.method == Method::polling || folder.identity == Identity()) return;
        auto events = std::make_unique<uv_fs_event_t>();
        uv_fs_event_init(&loop_, events.get());
        events->data = this;
        const int status = uv_fs_event_start(
            events.get(), [](uv_fs_event_t* handle, const char*, int, int) { of(handle).notice(); },
            path.c_str(), 0);
        folder.events = std::move(events);
        if (status != 0) stopEvents(folder); // the system can't watch so many, or not this one
    }

    // The handle has to live until the loop has closed it.
    static void stopEvents(Folder& folder) {
        if (!folder.events) return;
        uv_close(reinterpret_cast<uv_handle_t*>(folder.events.release()),
                 [](uv_handle_t* handle) { delete reinterpret_cast<uv_fs_event_t*>(handle); });
    }

    // The system goes on watching a folder that was deleted, not the one that took its place.
    void poll() {
        for (auto& [path, folder] : folders_) {
            if (folder.identity != identityOf(path)) {
                stopEvents(folder);
                start(path, folder);
                notice();
            } else if (!folder.events) {
                const std::size_t before = std::exchange(folder.signature, signatureOf(path));
                if (folder.signature != before) notice();
            }
        }
    }

    void close() {
        for (auto& [path, folder] : folders_)
            stopEvents(folder);
        folders_.clear();
        uv_close(reinterpret_cast<uv_handle_t*>(&timer_), nullptr);
        uv_close(reinterpret_cast<uv_handle_t*>(&wake_), nullptr);
    }

    const Options options_;
    std::atomic<std::int64_t> first_ = kNever, last_ = 0; ///< of what was not taken yet
    std::atomic<bool> stop_ = false;
    std::mutex mutex_;
    std::vector<fs::path> wanted_; ///< guarded by the mutex

    uv_loop_t loop_{};
    uv_async_t wake_{};
    uv_timer_t timer_{};
    std::map<fs::path, Folder> folders_;
    std::thread thread_; ///< last: everything is there when it starts
};

FileWatcher::FileWatcher()
    : FileWatcher(Options()) {}

FileWatcher::FileWatcher(const Options& options)
    : loop_(std::make_unique<Loop>(options)) {}

FileWatcher::~FileWatcher() = default;

void FileWatcher::watch(std::vector<fs::path> folders) {
    loop_->watch(std::move(folders));
}

bool FileWatcher::takeChange() {
    return loop_->takeChange();
}

} // namespace terrane
