// SPDX-License-Identifier: BSD-3-Clause
#include "tools/terrane/new_archive.h"

#include "core/files.h"
#include "resource/rnc_writer.h"
#include "resource/xsd_writer.h"

#include <filesystem>
#include <ostream>
#include <string_view>
#include <utility>
#include <vector>

namespace fs = std::filesystem;
using namespace terrane;

namespace {

// As a shell takes it for one word.
std::string asWord(const std::string& name) {
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                        "0123456789_-./+,:@%=";
    const bool plain = name.find_first_not_of(kPlain) == std::string::npos;
    if (plain) return name;
    std::string quoted = "'";
    for (const char c : name)
        quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + "'";
}

constexpr const char* kLocatingRules = R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- Tells nxml-mode of Emacs the schema of the XML files beside it. -->
<locatingRules xmlns="http://thaiopensource.com/ns/locating-rules/1.0">
    <documentElement localName="archive" uri="schema/terrane.rnc"/>
    <uri pattern="*.xml" uri="schema/terrane.rnc"/>
</locatingRules>
)";

constexpr std::string_view kRoot = "<archive>";
// By this, most editors find the schema by themselves.
constexpr std::string_view kRootWithSchema =
    "<archive xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\"\n"
    "    xsi:noNamespaceSchemaLocation=\"schema/terrane.xsd\">";

using Files = std::vector<std::pair<fs::path, std::string>>;

/// What the new folder holds; nothing when the example is not there.
Files filesOf(const Registry& registry) {
    const fs::path example = homeFolder() / "archives" / "hills";
    auto archive = readFile(example / "archive.xml");
    const auto shader = readFile(example / "hills.glsl");
    if (!archive || !shader) return {};
    const std::size_t root = archive->find(kRoot);
    if (root != std::string::npos) archive->replace(root, kRoot.size(), kRootWithSchema);
    const Schema schema(registry);
    return {{"archive.xml", *archive},
            {"hills.glsl", *shader},
            {"schemas.xml", kLocatingRules},
            {fs::path("schema") / "terrane.xsd", writeXsd(schema)},
            {fs::path("schema") / "terrane.rnc", writeRnc(schema)}};
}

int fail(int status, std::ostream& err, const std::string& message) {
    err << "terrane: " << message << "\n";
    return status;
}

} // namespace

int makeNewArchive(const Registry& registry, const std::string& name, std::ostream& out,
                   std::ostream& err) {
    if (name.empty()) return fail(2, err, "the new archive needs a name");
    std::error_code error;
    if (fs::exists(name, error)) return fail(1, err, "'" + name + "' exists already");
    const Files files = filesOf(registry);
    if (files.empty()) return fail(1, err, "can't find the example archives");
    fs::create_directories(fs::path(name) / "schema", error);
    if (error) return fail(1, err, "can't make " + name + ": " + error.message());
    for (const auto& [file, text] : files) {
        if (!writeFile(fs::path(name) / file, text))
            return fail(1, err, "can't write " + (fs::path(name) / file).string());
    }
    out << "Made " << name << ":\n"
        << "  archive.xml  the landscape, explained line by line: begin here\n"
        << "  hills.glsl   how its ground is coloured\n"
        << "  schema       by which editors complete and check archives; schemas.xml is for Emacs\n"
        << "Now try\n"
        << "  terrane play " << asWord(name) << "\n"
        << "or, without a display,\n"
        << "  terrane play " << asWord(name) << " --headless --screenshot picture.png\n";
    return 0;
}
