// SPDX-License-Identifier: BSD-3-Clause
#include "plugin_terrain/elevation_oracle.h"
#include "plugin_terrain/terrain_fixture.h"
#include "producer/cpu_tile_storage.h"
#include "render/framebuffer.h"
#include "render/mesh.h"
#include "render/program.h"
#include "resource/build_context.h"

#include <algorithm>
#include <cmath>

using namespace terrane;
using terrane::test::ElevationOracle;
using terrane::test::TerrainFixture;

namespace {

/// Residuals by formula, known down to a level.
class TestResiduals final : public TileProducer {
public:
    TestResiduals(std::string name, std::shared_ptr<TileCache> cache)
        : TileProducer(std::move(name), Task::Kind::cpu, "CreateTestResidual", std::move(cache)) {}

    int border() const override { return 2; }
    bool hasTile(const TileId& tile) const override { return tile.level <= 3; }

    static float value(int level, int x, int y) { // x and y over the whole level
        return 500.0f / static_cast<float>(1 << level) *
               std::sin(0.37f * static_cast<float>(x) + 0.11f * static_cast<float>(y * y % 17));
    }
    bool doCreateTile(const TileId& tile, TileSlot& slot, const TileInputs&) override {
        const int w = cache().storage().tileSize();
        float* const data = slot.as<CpuFloatTileStorage::Slot>().data();
        for (int k = 0; k < w; ++k)
            for (int i = 0; i < w; ++i)
                data[k * w + i] = value(tile.level, tile.tx * (w - 5) + i, tile.ty * (w - 5) + k);
        return true;
    }
};

/// Writes z and w over the left part of a tile, by a program of the archive.
class TestLayer final : public TileLayer {
public:
    TestLayer(const GlContext& context, std::shared_ptr<Program> program)
        : program_(std::move(program))
        , quad_(context, makeQuadMesh()) {}

    bool doCreateTile(const TileId&, TileSlot&, const TileInputs&) override {
        Framebuffer& target = *producer()->target();
        target.state.write.colour[0] = {.red = false, .green = false, .blue = true, .alpha = true};
        target.state.scissor = {.enabled = true, .rectangle = {0, 0, 10, 1000}};
        target.use();
        program_->use();
        quad_.draw();
        return true;
    }

private:
    std::shared_ptr<Program> program_;
    Mesh quad_;
};

struct CacheOnly : ElementDescription {
    Ref<TileCache> cache;
};
struct ProgramOnly : ElementDescription {
    Ref<Program> program;
};

struct InputsFixture : TerrainFixture {
    InputsFixture() {
        registry.resource<TestResiduals, CacheOnly, TileProducer>("testResiduals", "Residuals.")
            .attribute("cache", &CacheOnly::cache, "cache")
            .required()
            .build([](const CacheOnly& d, BuildContext& c) {
                return makeProducer<TestResiduals>(c.name(), d.cache.shared());
            });
        registry.resource<TestLayer, ProgramOnly, TileLayer>("testLayer", "A layer.")
            .attribute("program", &ProgramOnly::program, "program")
            .required()
            .build([](const ProgramOnly& d, BuildContext& c) {
                return std::make_shared<TestLayer>(c.service<GlContext>(), d.program.shared());
            });
    }
};

std::string gpuCache(int tileSize) {
    return "<tileCache name=\"cache\" scheduler=\"scheduler\"><gpuTileStorage tileSize=\"" +
           std::to_string(tileSize) +
           "\" nTiles=\"40\" internalformat=\"RGBA32F\" format=\"RGBA\" "
           "type=\"FLOAT\"/></tileCache>\n";
}

} // namespace

TEST_CASE_FIXTURE(InputsFixture, "Residuals are added to the upsampled parent, part by part") {
    open(gpuCache(29) +
         "<tileCache name=\"residualCache\" scheduler=\"scheduler\">"
         "<cpuFloatTileStorage tileSize=\"53\" channels=\"1\" capacity=\"10\"/></tileCache>\n"
         "<testResiduals name=\"residuals\" cache=\"residualCache\"/>\n"
         "<elevationProducer name=\"elevations\" cache=\"cache\" residuals=\"residuals\"/>\n");
    TileProducer* const elevations = producer("elevations");
    REQUIRE(elevations);
    elevations->setRootQuadSize(1000);
    CHECK(producer("residuals")->rootQuadSize() == 1000);

    const auto between = [](const std::array<double, 4>& z, int texel) {
        return texel % 2 == 0 ? z[1] : (9 * (z[1] + z[2]) - z[0] - z[3]) / 16;
    };
    std::vector<glm::vec4> parent;
    for (const TileId& id :
         {TileId{0, 0, 0}, TileId{1, 1, 0}, TileId{2, 2, 1}, TileId{3, 5, 3}, TileId{4, 11, 6}}) {
        CAPTURE(id.level);
        const auto texels = this->texels(make(*elevations, id));
        const int dx = id.tx % 2 * 12, dy = id.ty % 2 * 12;
        double worst = 0;
        for (int k = 0; k < 29; ++k) {
            for (int i = 0; i < 29; ++i) {
                double expected = 0;
                if (id.level > 0) {
                    std::array<double, 4> column;
                    for (int b = 0; b < 4; ++b) {
                        std::array<double, 4> row;
                        for (int a = 0; a < 4; ++a)
                            row[a] = parent[std::min(k / 2 + dy + b, 28) * 29 +
                                            std::min(i / 2 + dx + a, 28)] // weight 0
                                         .x;
                        column[b] = between(row, i);
                    }
                    expected = between(column, k);
                }
                if (id.level <= 3) // two elevation tiles along the edge of a residual tile
                    expected += TestResiduals::value(id.level, id.tx * 24 + i, id.ty * 24 + k);
                worst = std::max(worst, std::abs(texels[k * 29 + i].x - expected));
            }
        }
        CHECK(worst < 1e-3);
        parent = texels;
    }
}

TEST_CASE_FIXTURE(InputsFixture, "What layers write is blended into the elevations") {
    write("dig.glsl", "#ifdef _VERTEX_\n"
                      "layout(location = 0) in vec4 vertex;\n"
                      "void main() { gl_Position = vertex; }\n"
                      "#endif\n"
                      "#ifdef _FRAGMENT_\n"
                      "layout(location = 0) out vec4 data;\n"
                      "void main() { data = vec4(7.0, 7.0, 1000.0, 0.25); }\n"
                      "#endif\n");
    const std::string noise = "cache=\"cache\" noise=\"100,50\"";
    open(gpuCache(29) +
         "<module name=\"dig\" version=\"330\" source=\"dig.glsl\"/>\n"
         "<elevationProducer name=\"plain\" " +
         noise +
         "/>\n"
         "<elevationProducer name=\"dug\" " +
         noise +
         "><testLayer program=\"dig;\"/>"
         "</elevationProducer>\n");
    TileProducer* const plain = producer("plain");
    TileProducer* const dug = producer("dug");
    REQUIRE(plain);
    REQUIRE(dug);
    REQUIRE(dug->layers().size() == 1);
    const auto check = [&](const TileId& id, bool layered) {
        const auto before = texels(make(*plain, id)), after = texels(make(*dug, id));
        int wrong = 0;
        for (int i = 0; i < 29 * 29; ++i) {
            const bool inside = layered && i % 29 < 10;
            const float z = inside ? 1000.0f + (before[i].x - 1000.0f) * 0.25f : before[i].z;
            wrong += std::abs(after[i].z - z) > 1e-3f;
            wrong += after[i].x != before[i].x;
            if (id.level == 0) wrong += after[i].y != before[i].y;
        }
        return wrong;
    };
    CHECK(check({0, 0, 0}, true) == 0);
    CHECK(check({1, 1, 1}, true) == 0);
    dug->layers()[0]->setEnabled(false);
    CHECK(check({1, 1, 1}, false) == 0);
    dug->layers()[0]->setEnabled(true);
    CHECK(check({1, 1, 1}, true) == 0);
}

TEST_CASE_FIXTURE(InputsFixture, "A producer that can't work with a storage says what would do") {
    const std::string scheduler = "scheduler=\"scheduler\"";
    const auto gpu = [&](const std::string& name, int size, const std::string& format = "RGB32F") {
        return "<tileCache name=\"" + name + "\" " + scheduler + "><gpuTileStorage tileSize=\"" +
               std::to_string(size) + "\" nTiles=\"4\" internalformat=\"" + format +
               "\" format=\"RGB\" type=\"FLOAT\"/></tileCache>\n";
    };
    const auto cpu = [&](int size, int channels = 1) {
        return "<tileCache name=\"r\" " + scheduler + "><cpuFloatTileStorage tileSize=\"" +
               std::to_string(size) + "\" channels=\"" + std::to_string(channels) +
               "\" capacity=\"4\"/></tileCache>\n";
    };
    const std::string elevations = "<elevationProducer name=\"e\" cache=\"c\"/>\n";
    const std::string normals = "<normalProducer name=\"n\" cache=\"m\" elevations=\"e\"/>\n";
    const std::string residuals = "<testResiduals name=\"d\" cache=\"r\"/>\n"
                                  "<elevationProducer name=\"e\" cache=\"c\" residuals=\"d\"/>\n";
    struct Row {
        const char* name;
        std::string entries;
        const char* code;
        const char* at; ///< the text that is blamed
        const char* expected;
    };
    const Row rows[] = {
        {"elevations not k gridSize + 5", gpu("c", 100) + elevations, "wrong-tile-size", "100\" nT",
         "24k+5, such as 101"},
        {"elevations of another gridSize",
         gpu("c", 101) + "<elevationProducer name=\"e\" cache=\"c\" gridSize=\"20\"/>\n",
         "wrong-tile-size", "101\" nT", "20k+5, such as 105"},
        {"elevations in bytes", gpu("c", 101, "RGB8") + elevations, "wrong-format", "RGB8",
         "floats with three channels, such as RGB32F"},
        {"elevations without zm", gpu("c", 101, "RG32F") + elevations, "wrong-format", "RG32F",
         "three channels, such as RGB32F"},
        {"elevations on the CPU", cpu(101) + "<elevationProducer name=\"e\" cache=\"r\"/>\n",
         "wrong-storage", "r\"/>", "a cache with a gpuTileStorage"},
        {"normals of another size", gpu("c", 101) + gpu("m", 96, "RG16F") + elevations + normals,
         "wrong-tile-size", "96\" nT", "97, their tile size less their borders"},
        {"normals in three channels", gpu("c", 101) + gpu("m", 97) + elevations + normals,
         "wrong-format", "RGB32F\" format=\"RGB\" type=\"FLOAT\"/></tileCache>\n<e",
         "two or four channels of bytes or floats, such as RG8 or RGBA16F"},
        {"normals of residuals",
         cpu(101) + gpu("m", 97, "RG16F") + "<testResiduals name=\"e\" cache=\"r\"/>\n" + normals,
         "wrong-producer", "e\"/>\n", "an elevationProducer"},
        {"residuals of another size", gpu("c", 101) + cpu(180) + residuals, "wrong-tile-size",
         "180", "96k+5, such as 197"},
        {"residuals of two channels", gpu("c", 101) + cpu(197, 2) + residuals, "wrong-producer",
         "d\"/>\n", "a producer of one channel with a border of 2"},
    };
    for (const Row& row : rows) {
        CAPTURE(std::string(row.name));
        open(row.entries);
        producer(row.entries.find("name=\"n\"") == std::string::npos ? "e" : "n");
        REQUIRE(diagnostics.all().size() == 1);
        CHECK(diagnostics.all().front().expected == row.expected);
        const SourceFile text("", "<archive>\n<scheduler/>\n" + row.entries);
        const LineColumn at = text.position(text.text().rfind(row.at));
        CHECK(told() ==
              row.code + (" " + std::to_string(at.line)) + ":" + std::to_string(at.column) + "\n");
    }
}

TEST_CASE_FIXTURE(TerrainFixture,
                  "Archives with producers that are not built yet load with a warning") {
    open(gpuCache(29) +
         "<orthoCpuProducer name=\"residuals\" cache=\"x\" file=\"RGB.dat\"/>\n"
         "<elevationProducer name=\"e\" cache=\"cache\" residuals=\"residuals\" noise=\"10\">"
         "<textureLayer producer=\"x\"/></elevationProducer>\n"
         "<orthoGpuProducer name=\"o\" cache=\"x\" ortho=\"y\"/>\n");
    manager->loadAll();
    CHECK(diagnostics.errors() == 0);
    CHECK(diagnostics.warnings() >= 2);
    diagnostics.clear();
    TileProducer* const elevations = producer("e");
    REQUIRE(elevations);
    CHECK(elevations->layers().empty());
    make(*elevations, {2, 1, 3});
}
