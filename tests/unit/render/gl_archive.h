// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/files.h"
#include "gl_fixture.h"
#include "resource/manager.h"
#include "temporary_folder.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace terrane {

/// A folder of files and an archive in it, whose resources are built in an off-screen context.
struct GlArchive : GlFixture {
    test::TemporaryFolder temporary;
    std::filesystem::path folder = temporary.path();
    Registry registry;
    std::optional<Library> library;
    std::optional<ResourceManager> manager;

    ~GlArchive() { manager.reset(); }

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
