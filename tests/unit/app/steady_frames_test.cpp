// SPDX-License-Identifier: BSD-3-Clause
#include "app/player.h"
#include "app/register_types.h"
#include "plugins/standard_plugins.h"
#include "resource/registry.h"
#include "tools/terrane/allocation_counter.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>

using namespace terrane;

TEST_CASE("steady frames of the kernel's elements allocate nothing") {
    const char* const source = std::getenv("TERRANE_SOURCE");
    if (!source) return;
    Registry registry;
    registerStandardTypes(registry);
    registerStandardPlugins(registry);
    for (const char* name :
         {"setTarget/parts", "setTarget/good", "setState/buffers", "setTransforms/screen",
          "uniform/all-types", "uniform/subroutines", "sampling/good", "module/stages",
          "showInfo/good", "showLog/good", "foreach/good", "planned/landscape"}) {
        CAPTURE(name);
        const auto folder = std::filesystem::path(source) / "tests" / "fixtures" / name;
        Player player(registry, {.archive = folder,
                                 .width = 64,
                                 .height = 48,
                                 .recordFrames = true,
                                 .allocations = countedAllocations});
        REQUIRE(player.load());
        player.drawUntilComplete(60);
        // Beyond the second after which the frame rate is another.
        for (int i = 0; i < 70; ++i)
            CHECK(player.frame());
        for (int i = 0; i < 3; ++i) {
            CHECK(player.frame());
            CHECK(player.counters().allocationsLastFrame == 0);
        }
    }
}
