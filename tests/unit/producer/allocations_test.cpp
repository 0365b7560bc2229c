// SPDX-License-Identifier: BSD-3-Clause
#include "producer/test_producer.h"
#include "tools/terrane/allocation_counter.h"

#include <doctest/doctest.h>

using namespace terrane;
using terrane::test::ProducerFixture;
using terrane::test::SumProducer;

TEST_CASE_FIXTURE(ProducerFixture, "A frame that finds all its tiles allocates nothing") {
    const auto cache = makeCache(100);
    const auto producer =
        makeProducer<SumProducer>("sums", cache, std::vector<std::shared_ptr<SumProducer>>{}, true);
    std::vector<Tile*> tiles;
    const auto frame = [&] {
        cache->clearShortage();
        for (int i = 0; i < 64; ++i)
            tiles.push_back(producer->getTile({3, i % 8, i / 8}));
        run(tiles);
        for (Tile* tile : tiles)
            producer->putTile(*tile);
        tiles.clear();
        return producer->findTile({3, 1, 1}, true, true) != nullptr && cache->room() == 100;
    };
    REQUIRE(frame());
    const auto before = countedAllocations();
    const bool good = frame();
    CHECK(countedAllocations() == before);
    CHECK(good);
}
