// SPDX-License-Identifier: BSD-3-Clause
#include "producer/test_producer.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> allocations{0};
} // namespace

void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

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
    const long before = allocations;
    const bool good = frame();
    CHECK(allocations - before == 0);
    CHECK(good);
}
