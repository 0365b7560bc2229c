// SPDX-License-Identifier: BSD-3-Clause
// How fast archives are parsed, and how much of that their size is to blame for.
#include "core/files.h"
#include "core/source.h"
#include "resource/library.h"

#include <benchmark/benchmark.h>

#include <string>

namespace terrane::bench {
namespace {

void parse(benchmark::State& state, const std::string& text) {
    for (auto _ : state) {
        Diagnostics diagnostics;
        Library library(SearchPath{}, diagnostics);
        const auto source = std::make_shared<const SourceFile>("archive.xml", text);
        if (!library.addArchive("archive.xml", source)) state.SkipWithError("can't be parsed");
        benchmark::DoNotOptimize(library.entries().size());
    }
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}

void parseMountains(benchmark::State& state) {
    const auto text = readFile(homeFolder() / "archives/mountains/archive.xml");
    if (text) return parse(state, *text);
    state.SkipWithError("there are no mountains");
}
BENCHMARK(parseMountains);

/// Many small entries: the time per byte should not depend on how many.
void parseEntries(benchmark::State& state) {
    std::string text = "<archive>\n";
    for (int i = 0; i < state.range(0); ++i)
        text += "    <texture2D name=\"texture" + std::to_string(i) +
                "\" source=\"rock.png\" internalformat=\"RGBA8\" min=\"LINEAR\" mag=\"LINEAR\"/>\n";
    parse(state, text + "</archive>\n");
}
BENCHMARK(parseEntries)->Arg(100)->Arg(1000)->Arg(10000);

} // namespace
} // namespace terrane::bench
