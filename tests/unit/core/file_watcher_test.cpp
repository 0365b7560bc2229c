// SPDX-License-Identifier: BSD-3-Clause
#include "core/file_watcher.h"

#include "temporary_folder.h"

#include <doctest/doctest.h>
#include <fstream>
#include <thread>

using namespace terrane;
using namespace terrane::test;

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto kPatience = 20s; // of the test; a change is noticed long before

bool notices(FileWatcher& watcher) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < end) {
        if (watcher.takeChange()) return true;
        std::this_thread::sleep_for(1ms);
    }
    return false;
}

/// Until the watcher watches, and has told of all that happened so far.
void settle(FileWatcher& watcher, const TemporaryFolder& folder) {
    for (int i = 0;; ++i) {
        REQUIRE(i < 1000);
        folder.file("settle" + std::to_string(i));
        std::this_thread::sleep_for(30ms);
        if (watcher.takeChange()) break;
    }
    while (watcher.takeChange() || (std::this_thread::sleep_for(50ms), watcher.takeChange()))
        continue;
}

void write(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

} // namespace

TEST_CASE("a file watcher notices whatever happens to files, and nothing else") {
    for (const auto method : {FileWatcher::Method::events, FileWatcher::Method::polling}) {
        CAPTURE(method);
        TemporaryFolder folder;
        const fs::path file = folder.file("a.xml", "one");
        FileWatcher watcher({.method = method, .period = 10ms});
        watcher.watch({folder.path()});
        settle(watcher, folder);
        CHECK_FALSE(watcher.takeChange());

        write(file, "two!");
        CHECK(notices(watcher)); // written in place
        folder.file("a.xml", "three");
        CHECK(notices(watcher)); // written beside, and renamed
        fs::rename(file, folder / "b.xml");
        CHECK(notices(watcher));
        fs::remove(folder / "b.xml");
        CHECK(notices(watcher));
        folder.file("c.xml");
        CHECK(notices(watcher));
        fs::last_write_time(folder / "c.xml", fs::file_time_type::clock::now() + 1h);
        CHECK(notices(watcher)); // who asks finds that it says the same
        while (watcher.takeChange() || (std::this_thread::sleep_for(50ms), watcher.takeChange()))
            continue;
        CHECK_FALSE(watcher.takeChange());
    }
}

TEST_CASE("a folder may come, go, and come again while it is watched") {
    for (const auto method : {FileWatcher::Method::events, FileWatcher::Method::polling}) {
        CAPTURE(method);
        TemporaryFolder folder;
        FileWatcher watcher({.method = method, .period = 10ms});
        watcher.watch({folder / "later"});
        CHECK(notices(watcher)); // it has begun
        folder.file("later/a.xml");
        CHECK(notices(watcher));
        fs::remove_all(folder / "later");
        CHECK(notices(watcher));
        folder.file("later/b.xml");
        CHECK(notices(watcher));
        std::this_thread::sleep_for(50ms); // until it watches the new one
        while (watcher.takeChange())
            continue;
        write(folder / "later/b.xml", "other");
        CHECK(notices(watcher));
    }
}

TEST_CASE("folders are watched until others are") {
    TemporaryFolder first, second;
    FileWatcher watcher({.period = 10ms});
    watcher.watch({first.path()});
    settle(watcher, first);
    watcher.watch({second.path()});
    settle(watcher, second);
    first.file("a.xml");
    std::this_thread::sleep_for(100ms);
    CHECK_FALSE(watcher.takeChange());
}

TEST_CASE("a file that is written all the time is told of all the same") {
    TemporaryFolder folder;
    FileWatcher watcher({.quiet = 1h, .patience = 100ms});
    watcher.watch({folder.path()});
    std::thread writer([&] {
        for (int i = 0; i < 400; ++i) {
            folder.file("log.txt", std::to_string(i));
            std::this_thread::sleep_for(5ms);
        }
    });
    CHECK(notices(watcher));
    writer.join();
}
