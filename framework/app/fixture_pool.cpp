// SPDX-License-Identifier: BSD-3-Clause
#include "app/fixture_pool.h"

#include "app/fixture_report.h"
#include "core/files.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ostream>
#include <poll.h>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace terrane {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;
using Status = FixtureResult::Status;

/// Far longer than any fixture takes under a sanitizer: only one that hangs gets there.
constexpr std::chrono::minutes kTimeout{10};

const char* word(Status status) {
    switch (status) {
    case Status::passed:
        return "passed ";
    case Status::skipped:
        return "skipped";
    case Status::failed:
        break;
    }
    return "FAILED ";
}

std::string indented(const std::string& text) {
    std::string result = "    ";
    for (std::size_t i = 0; i < text.size(); ++i) {
        result += text[i];
        if (text[i] == '\n' && i + 1 < text.size()) result += "    ";
    }
    return result;
}

/// A process that runs one fixture and writes what came of it into a pipe: a digit, then the
/// report.
struct Process {
    fs::path folder;
    pid_t id = -1;
    int pipe = -1;
    std::string output;
    Clock::time_point start;
};

void writeAll(int file, const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t count = write(file, text.data() + done, text.size() - done);
        if (count < 0 && errno != EINTR) return;
        if (count > 0) done += static_cast<std::size_t>(count);
    }
}

std::string resultText(const FixtureResult& result) {
    return std::to_string(static_cast<int>(result.status)) + result.report;
}

class Pool {
public:
    Pool(const Registry& registry, const FixtureOptions& options, std::ostream& out)
        : registry_(registry)
        , options_(options)
        , out_(out) {}

    void run(const std::vector<fs::path>& fixtures) {
        const std::size_t most = std::max(1U, std::thread::hardware_concurrency());
        std::size_t next = 0;
        while (next < fixtures.size() || !running_.empty()) {
            while (next < fixtures.size() && running_.size() < most)
                start(fixtures[next++]);
            wait();
        }
    }

    int passed = 0, failed = 0, skipped = 0;
    std::vector<FixtureCase> cases; ///< in the order in which they ended

private:
    void start(const fs::path& folder) {
        out_.flush();
        std::fflush(nullptr); // or the child would write it, too
        int ends[2];
        Process process{.folder = folder, .start = Clock::now()};
        if (pipe(ends) != 0) return tell(process, {Status::failed, "no pipe\n"});
        process.id = fork();
        if (process.id == 0) {
            close(ends[0]);
            runHere(folder, ends[1]);
        }
        close(ends[1]);
        process.pipe = ends[0];
        if (process.id < 0) {
            close(ends[0]);
            return tell(process, {Status::failed, "no process\n"});
        }
        running_.push_back(std::move(process));
    }

    [[noreturn]] void runHere(const fs::path& folder, int pipe) {
        // Several run at once, so the rasteriser needs no threads of its own.
        setenv("LP_NUM_THREADS", "0", 0);
        FixtureOptions options = options_;
        options.output /= fs::path(folder).lexically_normal().relative_path();
        writeAll(pipe, resultText(runFixture(registry_, folder, options)));
        close(pipe);
        std::exit(0); // leak checkers run here
    }

    void wait() {
        std::vector<pollfd> files;
        for (const Process& process : running_)
            files.push_back({process.pipe, POLLIN, 0});
        poll(files.data(), files.size(), 1000);
        for (std::size_t i = running_.size(); i-- > 0;) {
            const bool ended = files[i].revents != 0 && !read(running_[i]);
            const bool late = Clock::now() - running_[i].start > kTimeout;
            if (late) kill(running_[i].id, SIGKILL);
            if (!ended && !late) continue;
            Process process = std::move(running_[i]);
            running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
            finish(process, late);
        }
    }

    /// False at the end.
    static bool read(Process& process) {
        char buffer[4096];
        const ssize_t count = ::read(process.pipe, buffer, sizeof buffer);
        if (count < 0) return errno == EINTR;
        process.output.append(buffer, static_cast<std::size_t>(count));
        return count > 0;
    }

    void finish(Process& process, bool late) {
        close(process.pipe);
        int status = 0;
        waitpid(process.id, &status, 0);
        FixtureResult result{Status::failed, process.output};
        if (!process.output.empty()) {
            result.status = static_cast<Status>(process.output[0] - '0');
            result.report = process.output.substr(1);
        }
        if (late) {
            result = {Status::failed, result.report + "takes too long\n"};
        } else if (WIFSIGNALED(status)) {
            result = {Status::failed,
                      result.report + "crashed: " + strsignal(WTERMSIG(status)) + "\n"};
        } else if (WEXITSTATUS(status) != 0) {
            result = {Status::failed, result.report + "exited with status " +
                                          std::to_string(WEXITSTATUS(status)) + "\n"};
        }
        tell(process, result);
    }

    void tell(const Process& process, const FixtureResult& result) {
        int& counter = result.status == Status::passed    ? passed
                       : result.status == Status::skipped ? skipped
                                                          : failed;
        ++counter;
        const std::chrono::duration<double> seconds = Clock::now() - process.start;
        cases.push_back({process.folder, result, seconds.count()});
        char time[32];
        std::snprintf(time, sizeof time, " (%.1f s)", seconds.count());
        out_ << word(result.status) << " " << shownPath(process.folder) << time << "\n";
        if (!result.report.empty()) out_ << indented(result.report);
        out_.flush();
    }

    const Registry& registry_;
    const FixtureOptions& options_;
    std::ostream& out_;
    std::vector<Process> running_;
};

} // namespace

int testFixtures(const Registry& registry, const std::vector<fs::path>& paths,
                 const FixtureOptions& options, std::ostream& out) {
    std::vector<fs::path> fixtures;
    bool allThere = true;
    for (const fs::path& path : paths) {
        const std::vector<fs::path> found = findFixtures(path);
        if (found.empty())
            out << "no fixture (a folder with a script) at " << shownPath(path) << "\n";
        allThere &= !found.empty();
        fixtures.insert(fixtures.end(), found.begin(), found.end());
    }
    if (!allThere) return 2;
    Pool pool(registry, options, out);
    pool.run(fixtures);
    out << pool.passed << " passed, " << pool.failed << " failed, " << pool.skipped << " skipped"
        << std::endl;
    if (options.junit.empty()) return pool.failed == 0 ? 0 : 1;
    std::sort(pool.cases.begin(), pool.cases.end(),
              [](const auto& a, const auto& b) { return a.folder < b.folder; });
    if (!writeFile(options.junit, junitReport(pool.cases))) {
        out << "can't write " << shownPath(options.junit) << std::endl;
        return 1;
    }
    return pool.failed == 0 ? 0 : 1;
}

} // namespace terrane
