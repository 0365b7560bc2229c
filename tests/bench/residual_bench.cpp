// SPDX-License-Identifier: BSD-3-Clause
// What a tile of a residual pyramid costs a worker: unpacking it, and adding it to its parent.
#include "core/random_access_file.h"
#include "plugins/terrain/residual_file.h"
#include "plugins/terrain/upsample.h"

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace terrane::bench {
namespace {

/// Tiles of Mount Rainier, 197x197 values each; needs TERRANE_TEST_DATA.
void decodeResidualTile(benchmark::State& state) {
    const char* const folder = std::getenv("TERRANE_TEST_DATA");
    const auto path = std::filesystem::path(folder ? folder : ".") / "rainier" / "DEM.dat";
    std::shared_ptr<const RandomAccessFile> bytes = RandomAccessFile::open(path);
    if (!bytes) return state.SkipWithError("no rainier/DEM.dat in TERRANE_TEST_DATA");
    std::string problem;
    const auto file = ResidualFile::parse(std::move(bytes), problem);
    if (!file) return state.SkipWithError(problem.c_str());
    int tile = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(file->read({6, tile % 8, tile / 8}, problem));
        tile = (tile + 1) % 64;
    }
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(decodeResidualTile);

void upsampleOnCpu(benchmark::State& state) {
    const auto width = static_cast<std::size_t>(state.range(0));
    const std::vector<float> parent(width * width, 1.0f);
    std::vector<float> child(width * width);
    for (auto _ : state) {
        addUpsampled({parent.data(), width}, {child.data(), width}, static_cast<int>(width));
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(upsampleOnCpu)->Arg(101)->Arg(197);

} // namespace
} // namespace terrane::bench
