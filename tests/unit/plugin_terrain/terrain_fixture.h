// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "plugins/terrain/declare.h"
#include "producer/declare.h"
#include "producer/gpu_tile_storage.h"
#include "producer/tile_producer.h"
#include "render/context.h"
#include "render/mesh_resource.h"
#include "render/module_resource.h"
#include "render/program_bindings.h"
#include "render/program_resource.h"
#include "render/texture_resource.h"
#include "resource/manager.h"
#include "task/declare.h"
#include "task/scheduler.h"
#include "temporary_folder.h"

#include <doctest/doctest.h>

#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec4.hpp>

namespace terrane::test {

/// Loads an archive's text as the player does, with an off-screen context, and makes tiles.
class TerrainFixture {
public:
    TerrainFixture()
        : context(createHeadlessContext(diagnostics, {.debug = true})) {
        REQUIRE(context);
        context->makeCurrent();
        bindings.emplace(*context);
        declareScheduler(registry);
        declareTextures(registry);
        declareMesh(registry);
        declareModule(registry);
        declareProgram(registry);
        declareProducers(registry);
        declareTerrainPlugin(registry);
    }
    ~TerrainFixture() {
        for (const Diagnostic& diagnostic : diagnostics.all())
            FAIL_CHECK(toString(diagnostic));
        graph.clear();
        manager.reset();
        bindings.reset();
        CHECK(context->objectCount() == 0);
    }
    TerrainFixture(const TerrainFixture&) = delete;
    TerrainFixture& operator=(const TerrainFixture&) = delete;

    /// Entries of an archive; a scheduler is there already.
    void open(const std::string& entries) {
        graph.clear();
        manager.reset();
        const auto file =
            folder.file("archive.xml", "<archive>\n<multithreadScheduler name=\"scheduler\"/>\n" +
                                           entries + "</archive>\n");
        library.emplace(archiveSearchPath(file, {}), diagnostics);
        REQUIRE(library->addArchive(file));
        manager.emplace(registry, *library, diagnostics);
        manager->services().provide(*context);
        manager->services().provide(*bindings);
    }
    void write(const std::string& name, const std::string& text) { folder.file(name, text); }
    TileProducer* producer(const std::string& name) {
        return manager->get<TileProducer>(name).get();
    }
    /// The tile with its data made; it stays locked until the archive is closed.
    Tile& make(TileProducer& producer, const TileId& id) {
        Tile* const tile = producer.getTile(id);
        REQUIRE(tile);
        graph.clear();
        graph.add(tile->task());
        producer.cache().scheduler().run(graph);
        graph.clear();
        REQUIRE(tile->done());
        return *tile;
    }
    /// Texels of a tile, row by row from the bottom.
    static std::vector<glm::vec4> texels(const Tile& tile) {
        const auto& slot = tile.slot().as<GpuTileStorage::Slot>();
        const Texture& texture = *slot.texture();
        const auto bytes = texture.download(
            {.z = slot.layer(), .width = texture.width(), .height = texture.height()},
            {TransferFormat::rgba, TransferType::f32});
        std::vector<glm::vec4> result(bytes.size() / sizeof(glm::vec4));
        std::memcpy(result.data(), bytes.data(), bytes.size());
        return result;
    }
    /// "code line:col" of each diagnostic, which are taken out.
    std::string told() {
        std::string text;
        for (const Diagnostic& d : diagnostics.all()) {
            const LineColumn at = d.place.position();
            text += d.code + " " + std::to_string(at.line) + ":" + std::to_string(at.column) + "\n";
        }
        diagnostics.clear();
        return text;
    }

    Diagnostics diagnostics;
    Registry registry;
    std::unique_ptr<GlContext> context;
    std::optional<ProgramBindings> bindings;
    TemporaryFolder folder;
    std::optional<Library> library;
    std::optional<ResourceManager> manager;
    TaskGraph graph;
};

} // namespace terrane::test
