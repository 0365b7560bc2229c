// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as shader files that include one another. A line "=== NAME" starts the next file; the
// first one is expanded.
#include "render/glsl_legacy.h"
#include "render/glsl_source.h"

#include <cstdint>
#include <cstdlib>
#include <map>

using namespace terrane;

namespace {

using Files = std::map<std::string, std::shared_ptr<const SourceFile>>;

Files split(const std::string& text) {
    Files files;
    std::string name = "main";
    std::size_t start = 0;
    for (;;) {
        const std::size_t mark = text.find("=== ", start);
        const std::size_t end = mark == std::string::npos ? text.size() : mark;
        files[name] = std::make_shared<SourceFile>(name, text.substr(start, end - start));
        if (mark == std::string::npos) return files;
        const std::size_t line = std::min(text.find('\n', mark), text.size());
        name = text.substr(mark + 4, line - mark - 4);
        start = std::min(line + 1, text.size());
    }
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it so.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Files files = split(std::string(reinterpret_cast<const char*>(data), size));
    GlslFiles finder;
    finder.find = [&](const std::string& name, const Place&) {
        const auto found = files.find(name);
        return found == files.end() ? nullptr : found->second;
    };
    Diagnostics diagnostics;
    const auto main = files.find("main");
    const ExpandedGlsl expanded = expandGlsl(main->second, finder, diagnostics);
    if (expanded.complete == (diagnostics.errors() > 0)) std::abort();
    if (expanded.text.text().size() > kLongestGlsl) std::abort();
    const GlslText stage = assembleStage({.version = 330}, expanded.text);
    for (std::size_t i = 0; i < stage.text().size(); i += 1 + stage.text().size() / 64) {
        const Place place = stage.place(i);
        if (place && place.offset > place.file->text().size()) std::abort();
        stage.inclusions(i);
    }
    mentionsStage(expanded.text, ShaderStage::vertex);
    for (const Diagnostic& diagnostic : diagnostics.all())
        toString(diagnostic);
    return 0;
}
