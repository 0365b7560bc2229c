// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/manager.h"
#include "resource/test_types.h"
#include "temporary_folder.h"

#include <doctest/doctest.h>
#include <memory>
#include <string>
#include <vector>

namespace doctest {

template <>
struct StringMaker<std::vector<std::string>> {
    static String convert(const std::vector<std::string>& lines) {
        std::string text;
        for (const std::string& line : lines)
            text += (text.empty() ? "" : ", ") + line;
        return text.c_str();
    }
};

} // namespace doctest

namespace terrane::test {

/// A text in which every '^' marks the place of an expected diagnostic.
struct MarkedText {
    explicit MarkedText(const std::string& marked);

    std::string text;                ///< without the marks
    std::vector<std::string> places; ///< "line:col" of the marks, counted here
};

/// The problems as "code line:col", in the order of their places.
std::vector<std::string> problems(const Diagnostics& diagnostics);
/// The same in the order of the reports, with the file: "code file:line:col".
std::vector<std::string> reports(const Diagnostics& diagnostics);
/// "code line:col" for each mark and its code.
std::vector<std::string> expected(const MarkedText& marked, const std::vector<std::string>& codes);

/// An archive of the test types in a folder of its own, with a manager that loads it.
class ArchiveWorld {
public:
    ArchiveWorld();
    ~ArchiveWorld();

    /// Adds an archive; the text is the whole file.
    bool add(const std::string& text, const std::string& name = "a.xml");
    /// Adds an archive with these entries and loads them all.
    void load(const std::string& entries);

    const Diagnostic* find(const std::string& code) const;

    TemporaryFolder folder;
    Registry registry;
    Diagnostics diagnostics;
    Log log;
    std::unique_ptr<Library> library;
    std::unique_ptr<ResourceManager> manager;

private:
    mutable std::vector<Diagnostic> all_; // keeps what find() points to
};

} // namespace terrane::test
