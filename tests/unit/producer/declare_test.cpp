// SPDX-License-Identifier: BSD-3-Clause
#include "producer/declare.h"
#include "producer/gpu_tile_storage.h"
#include "producer/tile_cache.h"
#include "render/context.h"
#include "resource/manager.h"
#include "task/declare.h"
#include "temporary_folder.h"

#include <doctest/doctest.h>

#include <optional>

using namespace terrane;

namespace {

struct ArchiveFixture {
    ArchiveFixture() {
        REQUIRE(context);
        context->makeCurrent();
        declareScheduler(registry);
        declareProducers(registry);
    }
    ~ArchiveFixture() { manager.reset(); }
    std::string load(const std::string& entries) {
        manager.reset();
        diagnostics.clear();
        const auto file =
            folder.file("archive.xml", "<archive>\n<multithreadScheduler name=\"s\"/>\n" + entries +
                                           "\n</archive>\n");
        library.emplace(archiveSearchPath(file, {}), diagnostics);
        REQUIRE(library->addArchive(file));
        manager.emplace(registry, *library, diagnostics);
        manager->services().provide(*context);
        manager->loadAll();
        std::string text;
        for (const Diagnostic& d : diagnostics.all()) {
            const LineColumn at = d.place.position();
            text += d.code + " " + std::to_string(at.line) + ":" + std::to_string(at.column) + "\n";
        }
        return text;
    }

    Diagnostics diagnostics;
    Registry registry;
    std::unique_ptr<GlContext> context = createHeadlessContext(diagnostics, {.debug = true});
    test::TemporaryFolder folder;
    std::optional<Library> library;
    std::optional<ResourceManager> manager;
};

} // namespace

TEST_CASE_FIXTURE(ArchiveFixture, "A cache has a nested storage, or one by name") {
    CHECK(load("<tileCache name=\"a\" scheduler=\"s\">\n"
               "<!-- first the storage -->\n"
               "<gpuTileStorage tileSize=\"21\" nTiles=\"7\" internalformat=\"RG8\" format=\"RG\" "
               "type=\"UNSIGNED_BYTE\" min=\"LINEAR_MIPMAP_LINEAR\" mag=\"LINEAR\" minLOD=\"0\" "
               "maxLod=\"1\" anisotropy=\"16\" swizzle=\"rgr1\" tileMap=\"true\"/></tileCache>\n"
               "<cpuByteTileStorage name=\"bytes\" tileSize=\"21\" channels=\"3\" "
               "capacity=\"9\"/>\n"
               "<tileCache name=\"b\" scheduler=\"s\" storage=\"bytes\"/>\n"
               "<tileCache name=\"c\" scheduler=\"s\" storage=\"bytes\"/>\n"
               "<tileCache name=\"d\" scheduler=\"s\"><objectTileStorage capacity=\"5\"/>"
               "</tileCache>") == "");
    const auto a = manager->get<TileCache>("a");
    REQUIRE(a);
    CHECK(a->name() == "a");
    const auto& storage = dynamic_cast<GpuTileStorage&>(a->storage());
    CHECK(storage.tileSize() == 21);
    CHECK(storage.capacity() == 7);
    CHECK(storage.format().value == InternalFormat::rg8);
    CHECK(storage.tileMap());
    const SamplingParameters& sampling = storage.textures()[0]->sampling();
    CHECK(sampling.minLod == 0);
    CHECK(sampling.maxLod == 1);
    CHECK(sampling.swizzle[2] == Swizzle::red);
    CHECK(sampling.swizzle[3] == Swizzle::one);
    CHECK(&manager->get<TileCache>("b")->storage() == &manager->get<TileCache>("c")->storage());
    CHECK(manager->get<TileCache>("d")->storage().capacity() == 5);
}

TEST_CASE_FIXTURE(ArchiveFixture, "What is wrong with a storage or a cache is told at its place") {
    struct Row {
        const char* name;
        const char* entries;
        const char* told;
    };
    const Row rows[] = {
        {"no storage", "<tileCache name=\"a\" scheduler=\"s\"/>", "missing-element 3:1\n"},
        {"no scheduler", "<tileCache name=\"a\"><objectTileStorage capacity=\"5\"/></tileCache>",
         "missing-attribute 3:1\n"},
        {"two storages",
         "<tileCache name=\"a\" scheduler=\"s\"><objectTileStorage capacity=\"5\"/>"
         "<objectTileStorage capacity=\"6\"/></tileCache>",
         "too-many-elements 3:1\n"},
        {"a scheduler for a storage", "<tileCache name=\"a\" scheduler=\"s\" storage=\"s\"/>",
         "mistyped-reference 3:44\n"},
        {"no slots", "<objectTileStorage name=\"a\" capacity=\"0\"/>", "out-of-range 3:39\n"},
        {"five channels",
         "<cpuFloatTileStorage name=\"a\" tileSize=\"9\" channels=\"5\" capacity=\"1\"/>",
         "out-of-range 3:54\n"},
        {"more than there is memory",
         "<cpuFloatTileStorage name=\"a\" tileSize=\"60000\" channels=\"4\" capacity=\"9999\"/>",
         "out-of-range 3:71\n"},
        {"a tile larger than a texture",
         "<gpuTileStorage name=\"a\" tileSize=\"1000000\" nTiles=\"1\" internalformat=\"R8\" "
         "format=\"RED\" type=\"UNSIGNED_BYTE\"/>",
         "bad-texture 3:36\n"},
        {"a tile map over several textures",
         "<gpuTileStorage name=\"a\" tileSize=\"1\" nTiles=\"100000\" internalformat=\"R8\" "
         "format=\"RED\" type=\"UNSIGNED_BYTE\" tileMap=\"true\"/>",
         "bad-texture 3:118\n"},
    };
    for (const Row& row : rows) {
        CAPTURE(std::string(row.name));
        CHECK(load(row.entries) == row.told);
    }
}
