// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as shader files that include one another. A line "=== NAME" starts the next file; the
// first one is expanded, and rewritten for the core profile. A file "log" is what a compiler and a
// linker say of it.
#include "render/glsl_legacy.h"
#include "render/glsl_log.h"
#include "render/glsl_source.h"
#include "require.h"

#include <algorithm>
#include <cstdint>
#include <map>

using namespace terrane;
using test::require;

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

// The places of a text of one stage, some of them.
void checkPlaces(const GlslText& text) {
    for (std::size_t i = 0; i < text.text().size(); i += 1 + text.text().size() / 64) {
        const Place place = text.place(i);
        require(!place || place.offset <= place.file->text().size(), "a place lies in its file");
        text.inclusions(i);
    }
}

std::ptrdiff_t lines(const GlslText& text) {
    return std::count(text.text().begin(), text.text().end(), '\n');
}

GlslText checkLegacy(const GlslText& text, int version, ShaderStage stage,
                     Diagnostics& diagnostics) {
    std::vector<LegacyChange> changes;
    GlslText rewritten = rewriteLegacyGlsl(text, version, stage, {"USED 1"}, changes);
    checkPlaces(rewritten);
    // A declared output is a line more.
    require(lines(rewritten) >= lines(text), "a rewriting keeps lines");
    for (const LegacyChange& change : changes) {
        require(!change.from.empty(), "a change is one of something");
        originalGlslName(change.to);
    }
    reportLegacyGlsl(changes, diagnostics);
    return rewritten;
}

void checkLog(const std::string& log, const GlslText& text) {
    for (const GlslMessage& message : parseGlslLog(log)) {
        const auto offset = offsetOf(message, text);
        require(!offset || *offset <= text.text().size(), "a message points into its text");
    }
    for (const bool failed : {false, true}) {
        Diagnostics diagnostics;
        reportCompileLog(log, failed, text, "vertex", {}, diagnostics);
        reportLinkLog(log, failed, {}, "program", {&text}, diagnostics);
        require(!failed || diagnostics.errors() > 0, "a failure has an error");
        test::requireToldWell(diagnostics);
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
    const ExpandedGlsl expanded = expandGlsl(files.at("main"), finder, diagnostics);
    require(expanded.complete == (diagnostics.errors() == 0), "either complete or an error");
    require(expanded.text.text().size() <= kLongestGlsl, "a text does not grow without end");
    mentionsStage(expanded.text, ShaderStage::vertex);
    checkPlaces(assembleStage({.version = 330}, expanded.text));
    checkLegacy(expanded.text, 330, ShaderStage::vertex, diagnostics);
    const GlslText rewritten = checkLegacy(expanded.text, 430, ShaderStage::fragment, diagnostics);
    test::requireToldWell(diagnostics);
    const auto log = files.find("log");
    if (log != files.end()) checkLog(log->second->text(), rewritten);
    return 0;
}
