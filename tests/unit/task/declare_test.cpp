// SPDX-License-Identifier: BSD-3-Clause
#include "resource/manager.h"
#include "task/declare.h"
#include "task/multithread_scheduler.h"
#include "temporary_folder.h"

#include "test_task.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

using namespace terrane;

namespace {

/// An archive with one element, loaded.
class Loaded {
public:
    explicit Loaded(const std::string& element) {
        declareScheduler(registry_);
        library_.addArchive(
            folder_.file("archive.xml", "<archive>\n" + element + "\n</archive>\n"));
        scheduler = manager_.get<Scheduler>("s").get();
    }

    Diagnostics diagnostics;

private:
    test::TemporaryFolder folder_;
    Registry registry_;
    Library library_{SearchPath(), diagnostics};
    ResourceManager manager_{registry_, library_, diagnostics};

public:
    Scheduler* scheduler = nullptr;
};

} // namespace

TEST_CASE("multithreadScheduler builds a scheduler with its options") {
    const Loaded loaded("<multithreadScheduler name='s' nthreads='2' fps='60' prefetchRate='1' "
                        "prefetchQueue='32'/>");
    CHECK(loaded.diagnostics.all().empty());
    const auto* scheduler = dynamic_cast<const MultithreadScheduler*>(loaded.scheduler);
    REQUIRE(scheduler);
    CHECK(scheduler->options().nthreads == 2);
    CHECK(scheduler->options().fps == 60);
    CHECK(scheduler->options().prefetchRate == 1);
    CHECK(scheduler->options().prefetchQueue == 32);
}

TEST_CASE("All attributes of multithreadScheduler are optional") {
    const Loaded loaded("<multithreadScheduler name='s'/>");
    CHECK(loaded.diagnostics.all().empty());
    REQUIRE(loaded.scheduler);
    CHECK_FALSE(loaded.scheduler->supportsPrefetch(Task::Kind::cpu));
}

TEST_CASE("What a task throws becomes a diagnostic") {
    const Loaded loaded("<multithreadScheduler name='s'/>");
    REQUIRE(loaded.scheduler);
    TaskGraph graph;
    graph.add(cpuTask([]() -> bool { throw std::runtime_error("no more disk"); }, "ReadTile"));
    loaded.scheduler->run(graph);
    REQUIRE(loaded.diagnostics.all().size() == 1);
    CHECK(loaded.diagnostics.all()[0].code == "task-failed");
    CHECK(loaded.diagnostics.all()[0].message == "ReadTile: no more disk");
}

TEST_CASE("Wrong attributes of multithreadScheduler are told at their place") {
    struct Row {
        const char* attributes;
        const char* code;
        int column;
    };
    for (const Row& row : {
             Row{"nthreads='-1'", "out-of-range", 42},
             Row{"nthreads='many'", "wrong-kind", 42},
             Row{"fps='-1'", "out-of-range", 37},
             Row{"fps='60'", "out-of-range", 1},
             Row{"prefetchRate='1'", "out-of-range", 1},
             Row{"fps='60' prefetchQueue='0'", "out-of-range", 56},
             Row{"threads='3'", "unknown-attribute", 32},
         }) {
        CAPTURE(row.attributes);
        const Loaded loaded("<multithreadScheduler name='s' " + std::string(row.attributes) + "/>");
        const auto all = loaded.diagnostics.all();
        REQUIRE(all.size() == 1);
        CHECK(all[0].code == row.code);
        CHECK(all[0].place.position().line == 2);
        CHECK(all[0].place.position().column == row.column);
    }
}
