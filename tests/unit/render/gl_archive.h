// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/files.h"
#include "gl_fixture.h"
#include "resource/manager.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <unistd.h>

namespace terrane {

/// A folder of files and an archive in it, whose resources are built in an off-screen context.
struct GlArchive : GlFixture {
    std::filesystem::path folder;
    Registry registry;
    std::optional<Library> library;
    std::optional<ResourceManager> manager;

    GlArchive() {
        static int count = 0;
        folder = std::filesystem::temp_directory_path() /
                 ("terrane_gl_archive." + std::to_string(getpid()) + "." + std::to_string(++count));
        std::filesystem::create_directories(folder);
    }
    ~GlArchive() {
        manager.reset();
        std::filesystem::remove_all(folder);
    }

    /// Reads an archive with these elements, in place of an earlier one.
    void read(const std::string& elements) {
        manager.reset();
        diagnostics.clear();
        const auto file = folder / "archive.xml";
        writeFile(file, "<archive>\n" + elements + "\n</archive>\n");
        SearchPath path;
        path.add(folder);
        library.emplace(std::move(path), diagnostics);
        library->addArchive(file);
        manager.emplace(registry, *library, diagnostics);
        manager->services().provide(*context);
    }
    template <class T>
    T* get(const std::string& name) {
        return manager->get<T>(name).get();
    }
    /// Reads an archive and loads one resource of it.
    template <class T>
    T* load(const std::string& elements, const std::string& name) {
        read(elements);
        return get<T>(name);
    }
    /// "code column" of each diagnostic, and forgets them.
    std::string told() {
        std::string text;
        for (const auto& diagnostic : diagnostics.all()) {
            text += (text.empty() ? "" : ", ") + diagnostic.code + " " +
                    std::to_string(diagnostic.place.position().column);
        }
        diagnostics.clear();
        return text;
    }
};

} // namespace terrane
