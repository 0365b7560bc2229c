// SPDX-License-Identifier: BSD-3-Clause
// What setting a uniform costs, as drawTerrain does for each quad.
#include "mountains.h"
#include "render/program.h"
#include "resource/manager.h"

#include <benchmark/benchmark.h>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace terrane::bench {
namespace {

/// Sets a uniform of the program of the ground to the one or the other value in turn.
template <class T>
void set(benchmark::State& state, const char* name, T one, T other) {
    const auto player = loadMountains();
    if (!player) return state.SkipWithError("no mountains");
    const auto program = player->resources()->get<Program>("weather;groundModule;");
    if (!program) return state.SkipWithError("no program");
    const UniformHandle uniform = program->find(name);
    for (auto _ : state) {
        uniform.set(one);
        std::swap(one, other);
    }
    state.SetItemsProcessed(state.iterations());
}

void setChangedVec4(benchmark::State& state) {
    set(state, "deformation.offset", glm::vec4(1), glm::vec4(2));
}
BENCHMARK(setChangedVec4);

void setEqualVec4(benchmark::State& state) {
    set(state, "deformation.offset", glm::vec4(1), glm::vec4(1));
}
BENCHMARK(setEqualVec4);

void setChangedMat4(benchmark::State& state) {
    set(state, "deformation.localToScreen", glm::mat4(1), glm::mat4(2));
}
BENCHMARK(setChangedMat4);

void setEqualMat4(benchmark::State& state) {
    set(state, "deformation.localToScreen", glm::mat4(1), glm::mat4(1));
}
BENCHMARK(setEqualMat4);

void setMat4ThatTheProgramLacks(benchmark::State& state) {
    set(state, "deformation.screenQuadCorners", glm::mat4(1), glm::mat4(2));
}
BENCHMARK(setMat4ThatTheProgramLacks);

} // namespace
} // namespace terrane::bench
