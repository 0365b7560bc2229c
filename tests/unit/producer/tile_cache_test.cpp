// SPDX-License-Identifier: BSD-3-Clause
#include "producer/test_producer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <list>
#include <map>
#include <random>
#include <set>

using namespace terrane;
using terrane::test::ProducerFixture;
using terrane::test::SumProducer;

namespace {

/// What a cache must do, in the plainest way.
struct CacheModel {
    using Name = std::pair<int, int>; // producer, tile
    std::size_t capacity;
    std::map<Name, int> used;
    std::list<Name> unused; // oldest first

    bool get(const Name& name) {
        if (const auto found = used.find(name); found != used.end()) return ++found->second, true;
        const auto old = std::find(unused.begin(), unused.end(), name);
        if (old != unused.end())
            unused.erase(old);
        else if (!makeRoom())
            return false;
        used[name] = 1;
        return true;
    }
    void put(const Name& name) {
        if (--used[name] > 0) return;
        used.erase(name);
        unused.push_back(name);
    }
    bool prefetch(const Name& name) {
        if (holds(name) || !makeRoom()) return false;
        unused.push_back(name);
        return true;
    }
    bool makeRoom() {
        if (used.size() + unused.size() < capacity) return true;
        if (unused.empty()) return false;
        unused.pop_front();
        return true;
    }
    bool holds(const Name& name) const {
        return used.contains(name) || std::find(unused.begin(), unused.end(), name) != unused.end();
    }
};

TileId tileOf(int number) {
    return {5, number % 32, number / 32};
}

} // namespace

TEST_CASE_FIXTURE(ProducerFixture, "A cache behaves like its model under random operations") {
    std::mt19937 random(2024);
    const auto cache = makeCache(24);
    std::vector<std::shared_ptr<SumProducer>> producers;
    for (int i = 0; i < 3; ++i)
        producers.push_back(makeProducer<SumProducer>("p" + std::to_string(i), cache));
    CacheModel model{.capacity = 24};
    std::vector<Tile*> held;
    std::vector<CacheModel::Name> heldNames;

    for (int step = 0; step < 20000; ++step) {
        const int p = static_cast<int>(random() % 3);
        const int t = static_cast<int>(random() % 20);
        SumProducer& producer = *producers[static_cast<std::size_t>(p)];
        switch (random() % 6) {
        case 0:
        case 1: {
            Tile* const tile = producer.getTile(tileOf(t));
            REQUIRE((tile != nullptr) == model.get({p, t}));
            if (!tile) break;
            held.push_back(tile);
            heldNames.emplace_back(p, t);
            break;
        }
        case 2:
        case 3: {
            if (held.empty()) break;
            const std::size_t i = random() % held.size();
            held[i]->producer().putTile(*held[i]);
            model.put(heldNames[i]);
            held.erase(held.begin() + static_cast<std::ptrdiff_t>(i));
            heldNames.erase(heldNames.begin() + static_cast<std::ptrdiff_t>(i));
            break;
        }
        case 4: {
            const auto task = cache->prefetchTile(producer, tileOf(t));
            REQUIRE((task != nullptr) == model.prefetch({p, t}));
            break;
        }
        default:
            if (random() % 10 == 0) producer.invalidateTiles();
            if (random() % 2) run(held);
            break;
        }
        REQUIRE((producer.findTile(tileOf(t)) != nullptr) == model.used.contains({p, t}));
        REQUIRE((producer.findTile(tileOf(t), true) != nullptr) == model.holds({p, t}));
        const auto statistics = cache->statistics();
        REQUIRE(statistics.used == static_cast<int>(model.used.size()));
        REQUIRE(statistics.unused == static_cast<int>(model.unused.size()));
    }

    // No two tiles share a slot, and all that are held can be made.
    run(held);
    std::set<int> slots;
    std::set<Tile*> tiles(held.begin(), held.end());
    for (Tile* tile : tiles) {
        CHECK(slots.insert(tile->slot().index()).second);
        CHECK(tile->done());
        CHECK(SumProducer::value(*tile) ==
              static_cast<SumProducer&>(tile->producer()).expected(tile->id()));
    }
}

TEST_CASE_FIXTURE(ProducerFixture, "A tile is made once and found again") {
    const auto cache = makeCache(4);
    const auto producer = makeProducer<SumProducer>("sums", cache);
    Tile* const tile = producer->getTile({1, 1, 0});
    REQUIRE(tile);
    CHECK_FALSE(tile->done());
    CHECK(producer->findTile({1, 1, 0}, false, true) == nullptr);
    run({tile});
    CHECK(tile->done());
    CHECK(producer->findTile({1, 1, 0}, false, true) == tile);
    CHECK(SumProducer::value(*tile) == 10001);

    CHECK(producer->getTile({1, 1, 0}) == tile);
    CHECK(tile->users() == 2);
    producer->putTile(*tile);
    producer->putTile(*tile);
    CHECK(producer->findTile({1, 1, 0}) == nullptr);
    CHECK(producer->findTile({1, 1, 0}, true) == tile);
    CHECK(producer->getTile({1, 1, 0}) == tile);
    run({tile});
    CHECK(producer->made == 1);
    const auto statistics = cache->statistics();
    CHECK(statistics.hits == 2);
    CHECK(statistics.misses == 1);
    CHECK(statistics.evicted == 0);
    CHECK(producer->statistics().tiles == 1);
}

TEST_CASE_FIXTURE(ProducerFixture,
                  "The tile that has been unused for longest gives its slot away") {
    const auto cache = makeCache(3);
    const auto producer = makeProducer<SumProducer>("sums", cache);
    std::vector<Tile*> tiles;
    for (int i = 0; i < 3; ++i)
        tiles.push_back(producer->getTile(tileOf(i)));
    run(tiles);
    for (const std::size_t i : {1u, 0u, 2u})
        producer->putTile(*tiles[i]);
    producer->getTile(tileOf(1)); // the oldest is in use again
    producer->getTile(tileOf(7));
    CHECK(producer->findTile(tileOf(0), true) == nullptr);
    CHECK(producer->findTile(tileOf(2), true) != nullptr);
    CHECK(cache->statistics().evicted == 1);
}

TEST_CASE_FIXTURE(ProducerFixture, "A full cache refuses, and tells how many slots are needed") {
    const auto cache = makeCache(64, "elevations");
    const auto producer = makeProducer<SumProducer>("sums", cache);
    for (int i = 0; i < 93; ++i)
        CHECK((producer->getTile(tileOf(i)) != nullptr) == (i < 64));
    CHECK(producer->getTile(tileOf(80)) == nullptr); // again: it is one and the same tile
    const auto shortage = cache->shortage();
    CHECK(shortage.slots == 64);
    CHECK(shortage.needed == 93);
    CHECK(shortage.message == "cache 'elevations' has 64 slots; this view needs at least 93");
    CHECK(cache->statistics().refused == 30);

    cache->clearShortage();
    CHECK(cache->shortage().needed == 0);
    CHECK(cache->shortage().message.empty());
    producer->putTile(*producer->findTile(tileOf(0)));
    CHECK(producer->getTile(tileOf(80)) != nullptr);
}

TEST_CASE_FIXTURE(ProducerFixture, "A tile whose inputs find no room is refused as a whole") {
    const auto inputs = makeCache(2, "inputs");
    const auto outputs = makeCache(10, "outputs");
    const auto heights = makeProducer<SumProducer>("heights", inputs);
    const auto normals = makeProducer<SumProducer>(
        "normals", outputs, std::vector<std::shared_ptr<SumProducer>>{heights});
    Tile* const a = normals->getTile(tileOf(1));
    Tile* const b = normals->getTile(tileOf(2));
    REQUIRE(a);
    REQUIRE(b);
    CHECK(normals->getTile(tileOf(3)) == nullptr);
    CHECK(inputs->shortage().needed == 3);
    // What the full cache is called is known where the tile was asked for.
    CHECK(outputs->shortage().message == "cache 'inputs' has 2 slots; this view needs at least 3");
    outputs->clearShortage();
    CHECK(outputs->shortage().needed == 0);
    CHECK(inputs->shortage().needed == 0);
    CHECK(outputs->statistics().used == 2);
    CHECK(outputs->storage().freeSlots() == 8);
    CHECK(normals->findTile(tileOf(3), true) == nullptr);

    // Once the first two are made, their inputs may go.
    run({a, b});
    CHECK(inputs->statistics().unused == 2);
    Tile* const c = normals->getTile(tileOf(3));
    REQUIRE(c);
    run({c});
    CHECK(SumProducer::value(*c) == normals->expected(tileOf(3)));
}

TEST_CASE_FIXTURE(ProducerFixture,
                  "A chain of ancestors that does not fit leaves the cache as it was") {
    const auto cache = makeCache(4, "deep");
    const auto producer =
        makeProducer<SumProducer>("sums", cache, std::vector<std::shared_ptr<SumProducer>>{}, true);
    CHECK(producer->getTile({9, 100, 200}) == nullptr);
    CHECK(cache->shortage().needed == 5);
    CHECK(cache->statistics().used == 0);
    CHECK(cache->storage().freeSlots() == 4);
    // Level by level there is enough room: two tiles at a time.
    TileId id{0, 0, 0};
    Tile* tile = producer->getTile(id);
    for (int level = 0; level < 9; ++level) {
        REQUIRE(tile);
        run({tile});
        CHECK(SumProducer::value(*tile) == producer->expected(id));
        Tile* const parent = tile;
        id = id.child(level % 2, 1);
        tile = producer->getTile(id);
        producer->putTile(*parent);
    }
}

TEST_CASE_FIXTURE(ProducerFixture, "What changes is made again, and all that was made of it") {
    const auto cache = makeCache(200);
    const auto heights = makeProducer<SumProducer>(
        "heights", cache, std::vector<std::shared_ptr<SumProducer>>{}, true);
    const auto normals = makeProducer<SumProducer>(
        "normals", cache, std::vector<std::shared_ptr<SumProducer>>{heights});
    std::vector<Tile*> tiles;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            tiles.push_back(normals->getTile({2, x, y}));
    run(tiles);
    CHECK(heights->made == 21);
    CHECK(normals->made == 16);

    SUBCASE("everything") {
        heights->version = 1;
        CHECK(heights->invalidateTiles() == 21);
        run(tiles);
        CHECK(heights->made == 42);
        CHECK(normals->made == 32);
    }
    SUBCASE("one tile at level 1 changes the four below it and their normals") {
        heights->compareResults();
        CHECK(heights->invalidateTile({1, 0, 1}) == 1);
        heights->version = 0;
        run(tiles);
        CHECK(heights->made == 22); // it came out as it was: nothing else is made again
        CHECK(normals->made == 16);
    }
    SUBCASE("the leaves only") {
        normals->version = 3;
        CHECK(normals->invalidateTiles() == 16);
        run(tiles);
        CHECK(heights->made == 21);
        CHECK(normals->made == 32);
    }
    SUBCASE("a tile that was evicted meanwhile") {
        // Other tiles push all heights out: those of the normals stay, being in use.
        const auto others = makeProducer<SumProducer>("others", cache);
        std::vector<Tile*> held;
        for (int i = 0; i < 184; ++i)
            held.push_back(others->getTile(tileOf(i)));
        CHECK(std::find(held.begin(), held.end(), nullptr) == held.end());
        CHECK(heights->findTile({1, 0, 1}, true) == nullptr);
        for (Tile* tile : held)
            others->putTile(*tile);
        heights->version = 1;
        heights->invalidateTiles();
        run(tiles);
        CHECK(normals->made == 32);
    }
    for (Tile* tile : tiles)
        CHECK(SumProducer::value(*tile) == normals->expected(tile->id()));
}

TEST_CASE_FIXTURE(ProducerFixture,
                  "Making an evicted tile again disturbs nothing that was made of it") {
    const auto heightCache = makeCache(1);
    const auto cache = makeCache(10);
    const auto heights = makeProducer<SumProducer>("heights", heightCache);
    const auto normals = makeProducer<SumProducer>(
        "normals", cache, std::vector<std::shared_ptr<SumProducer>>{heights});
    Tile* const normal = normals->getTile(tileOf(0));
    run({normal});
    const auto task = heights->findTile(tileOf(0), true)->task();
    for (int i = 1; i < 3; ++i) {
        Tile* const tile = heights->getTile(tileOf(i));
        run({tile});
        heights->putTile(*tile);
    }
    REQUIRE(heights->findTile(tileOf(0), true) == nullptr);
    Tile* const again = heights->getTile(tileOf(0));
    CHECK(again->task() == task);
    CHECK_FALSE(again->done());
    CHECK(normal->done());
    run({again, normal});
    CHECK(heights->made == 4);
    CHECK(normals->made == 1);
}

TEST_CASE_FIXTURE(ProducerFixture, "Tasks of one context run between one begin and one end") {
    const auto cache = makeCache(30);
    const auto a = makeProducer<SumProducer>(
        "a", cache, std::vector<std::shared_ptr<SumProducer>>{}, false, Task::Kind::gpu);
    const auto b = makeProducer<SumProducer>(
        "b", cache, std::vector<std::shared_ptr<SumProducer>>{}, false, Task::Kind::gpu);
    a->contextual = b->contextual = true;
    std::vector<Tile*> tiles;
    for (int i = 0; i < 10; ++i) {
        tiles.push_back(a->getTile(tileOf(i)));
        tiles.push_back(b->getTile(tileOf(i)));
    }
    run(tiles);
    for (const auto& producer : {a, b}) {
        CHECK(producer->made == 10);
        CHECK(producer->begun == 1);
        CHECK(producer->ended == 1);
        CHECK(producer->statistics().tiles == 10);
    }
}

TEST_CASE_FIXTURE(ProducerFixture,
                  "Producers have ids in their order, and keep them when built anew") {
    const auto cache = makeCache(4);
    const auto a = makeProducer<SumProducer>("a", cache);
    auto b = makeProducer<SumProducer>("b", cache);
    const auto c = makeProducer<SumProducer>("c", cache);
    CHECK(a->id() == 0);
    CHECK(b->id() == 1);
    CHECK(c->id() == 2);
    const auto task = b->getTile(tileOf(3))->task();
    const unsigned before = b->serial();
    b = nullptr;
    CHECK(cache->producers()[1] == nullptr);
    CHECK(cache->storage().freeSlots() == 4);
    CHECK_FALSE(task->run()); // of a producer that is gone: nothing happens
    b = makeProducer<SumProducer>("b", cache);
    CHECK(b->id() == 1);
    CHECK(b->serial() != before);
}

namespace {

class RecordingLayer final : public TileLayer {
public:
    std::string calls;
    void useTile(const TileId&) override { calls += 'u'; }
    void unuseTile(const TileId&) override { calls += 'n'; }
    bool startCreateTile(const TileId&, TileInputs&) override { return calls += 's', true; }
    bool doCreateTile(const TileId&, TileSlot&, const TileInputs&) override {
        return calls += 'd', true;
    }
};

class PlainProducer final : public TileProducer {
public:
    explicit PlainProducer(std::shared_ptr<TileCache> cache)
        : TileProducer("plain", Task::Kind::cpu, "CreatePlain", std::move(cache)) {}
};

} // namespace

TEST_CASE_FIXTURE(ProducerFixture, "Layers follow the life of a tile, unless they are disabled") {
    const auto cache = makeCache(4);
    const auto producer = makeProducer<PlainProducer>(cache);
    const auto layer = std::make_shared<RecordingLayer>();
    producer->addLayer(layer);
    CHECK(layer->producer() == producer.get());
    Tile* tile = producer->getTile({0, 0, 0});
    CHECK(layer->calls == "su");
    run({tile});
    CHECK(layer->calls == "sud");
    producer->putTile(*tile);
    CHECK(layer->calls == "sudn");

    layer->setEnabled(false);
    CHECK_FALSE(producer->hasEnabledLayers());
    CHECK_FALSE(tile->done());
    tile = producer->getTile({0, 0, 0});
    run({tile});
    CHECK(layer->calls == "sudnu");
    CHECK(tile->done());
}

TEST_CASE("Tiles that workers make are right, whatever is evicted and invalidated meanwhile") {
    ProducerFixture f(2);
    std::mt19937 random(7);
    const auto heightCache = f.makeCache(40, "heights");
    const auto cache = f.makeCache(30, "sums");
    const auto heights = makeProducer<SumProducer>(
        "heights", heightCache, std::vector<std::shared_ptr<SumProducer>>{}, true);
    const auto sums = makeProducer<SumProducer>(
        "sums", cache, std::vector<std::shared_ptr<SumProducer>>{heights}, true);
    for (int frame = 0; frame < 600; ++frame) {
        std::vector<Tile*> tiles;
        for (int i = 0; i < 4; ++i) {
            const TileId id{4, static_cast<int>(random() % 16), static_cast<int>(random() % 16)};
            if (Tile* tile = sums->getTile(id)) tiles.push_back(tile);
            sums->prefetchTile(
                {4, static_cast<int>(random() % 16), static_cast<int>(random() % 16)});
        }
        if (frame % 10 == 0) {
            f.scheduler->waitIdle(); // the data must not change while it is read
            ++heights->version;
            heights->invalidateTiles();
        }
        f.run(tiles);
        for (Tile* tile : tiles) {
            REQUIRE(tile->done());
            REQUIRE(SumProducer::value(*tile) == sums->expected(tile->id()));
        }
        for (Tile* tile : tiles)
            sums->putTile(*tile);
    }
    f.scheduler->waitIdle();
    CHECK(heightCache->statistics().used == 0);
    CHECK(cache->statistics().used == 0);
}
