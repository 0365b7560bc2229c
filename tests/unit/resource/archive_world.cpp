// SPDX-License-Identifier: BSD-3-Clause
#include "resource/archive_world.h"

#include <algorithm>

namespace terrane::test {

namespace {

std::string lineAndColumn(const Place& place) {
    const LineColumn at = place.position();
    return std::to_string(at.line) + ":" + std::to_string(at.column);
}

} // namespace

MarkedText::MarkedText(const std::string& marked) {
    int line = 1, column = 1;
    for (const char c : marked) {
        if (c == '^') {
            places.push_back(std::to_string(line) + ":" + std::to_string(column));
            continue;
        }
        text += c;
        ++column;
        if (c == '\n') {
            ++line;
            column = 1;
        }
    }
}

std::vector<std::string> problems(const Diagnostics& diagnostics) {
    std::vector<Diagnostic> all = diagnostics.all();
    std::stable_sort(all.begin(), all.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return a.place.offset < b.place.offset;
    });
    std::vector<std::string> result;
    for (const Diagnostic& d : all)
        result.push_back(d.code + " " + lineAndColumn(d.place));
    return result;
}

std::vector<std::string> reports(const Diagnostics& diagnostics) {
    std::vector<std::string> result;
    for (const Diagnostic& d : diagnostics.all()) {
        const std::string path = d.place ? d.place.file->path() : "";
        result.push_back(d.code + " " + path.substr(path.rfind('/') + 1) + ":" +
                         lineAndColumn(d.place));
    }
    return result;
}

std::vector<std::string> expected(const MarkedText& marked, const std::vector<std::string>& codes) {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < std::max(codes.size(), marked.places.size()); ++i)
        result.push_back((i < codes.size() ? codes[i] : "no code") + " " +
                         (i < marked.places.size() ? marked.places[i] : "no mark"));
    return result;
}

ArchiveWorld::ArchiveWorld() {
    declareTestTypes(registry);
    SearchPath search;
    search.add(folder.path());
    library = std::make_unique<Library>(search, diagnostics);
    manager = std::make_unique<ResourceManager>(registry, *library, diagnostics);
    manager->services().provide(log);
}

ArchiveWorld::~ArchiveWorld() = default;

bool ArchiveWorld::add(const std::string& text, const std::string& name) {
    return library->addArchive(folder.file(name, text));
}

void ArchiveWorld::load(const std::string& entries) {
    add("<archive>" + entries + "</archive>");
    manager->loadAll();
}

const Diagnostic* ArchiveWorld::find(const std::string& code) const {
    all_ = diagnostics.all();
    for (const Diagnostic& d : all_) {
        if (d.code == code) return &d;
    }
    return nullptr;
}

} // namespace terrane::test
