// SPDX-License-Identifier: BSD-3-Clause
#include "resource/library.h"

#include "core/text.h"

#include <algorithm>

namespace terrane {

namespace fs = std::filesystem;

namespace {

bool endsWithAny(const std::string& name, std::initializer_list<const char*> endings) {
    return std::any_of(endings.begin(), endings.end(), [&](const char* ending) {
        return name.size() > 4 && name.ends_with(ending);
    });
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += c;
        }
    }
    return result;
}

// "renderbuffer-<size>-<internalformat>[-<anything>]"
std::string renderbufferXml(const std::string& name) {
    const auto pieces = split(name, '-');
    if (pieces.size() < 3) return {};
    const std::string size = escaped(pieces[1]);
    return "<texture2D internalformat=\"" + escaped(pieces[2]) + "\" width=\"" + size +
           "\" height=\"" + size + "\" min=\"NEAREST\" mag=\"NEAREST\"/>";
}

std::string imageXml(const std::string& name) {
    return "<texture2D source=\"" + escaped(name) +
           "\" internalformat=\"RGBA8\" min=\"LINEAR_MIPMAP_LINEAR\" mag=\"LINEAR\" "
           "wraps=\"REPEAT\" wrapt=\"REPEAT\"/>";
}

// Every piece needs its ';': what follows the last one is dropped.
std::string programXml(const std::string& name) {
    std::string xml = "<program>";
    const std::string list = name.substr(0, name.rfind(';'));
    for (const std::string_view piece : split(list, ';'))
        xml += "<module name=\"" + escaped(piece) + "\"/>";
    return xml + "</program>";
}

} // namespace

Library::Library(SearchPath searchPath, Diagnostics& diagnostics)
    : searchPath_(std::move(searchPath))
    , diagnostics_(diagnostics) {}

bool Library::addArchive(const fs::path& file) {
    const auto text = source(file);
    if (!text) {
        diagnostics_.error("file-missing", {}, "can't read the archive '" + shownPath(file) + "'");
        return false;
    }
    const auto document = XmlDocument::parse(text, diagnostics_);
    if (!document) return false;
    archives_.push_back(file);
    for (const XmlElement& entry : document->root().children())
        entries_.push_back(entry);
    warnDuplicates();
    return true;
}

void Library::warnDuplicates() const {
    std::map<std::string, Place> seen;
    for (const XmlElement& entry : entries_) {
        const std::string name = entry.attribute("name");
        if (name.empty()) continue;
        const auto [first, isNew] = seen.emplace(name, entry.place());
        if (isNew) continue;
        diagnostics_.warning("duplicate-name", entry.place(),
                             "an entry named '" + name + "' stands at " + first->second.toString() +
                                 " already; this one is never used",
                             "another name");
    }
}

std::optional<FoundElement> Library::find(const std::string& name) {
    if (name.starts_with("renderbuffer")) {
        const std::string xml = renderbufferXml(name);
        if (!xml.empty()) return synthesise(name, xml);
    }
    if (endsWithAny(name, {".jpg", ".png", ".bmp", ".tga"}))
        return synthesise(name, imageXml(name));
    if (name.ends_with(".mesh") && name.size() > 5)
        return synthesise(name, "<mesh source=\"" + escaped(name) + "\"/>");
    if (auto entry = findEntry(name)) return entry;
    if (auto file = findXmlFile(name)) return file;
    if (name.find(';') != std::string::npos) return synthesise(name, programXml(name));
    return std::nullopt;
}

std::optional<FoundElement> Library::findEntry(const std::string& name) {
    for (const XmlElement& entry : entries_) {
        if (entry.attribute("name") == name)
            return FoundElement{entry, entry.place().file->path(), false};
    }
    return std::nullopt;
}

std::optional<FoundElement> Library::findXmlFile(const std::string& name) {
    const auto found = searchPath_.find(name + ".xml");
    if (!found) return std::nullopt;
    auto& document = documents_[found->path];
    if (!document) {
        const auto text = source(found->path);
        if (text) document = XmlDocument::parse(text, diagnostics_);
        if (!document) return std::nullopt;
        if (found->caseDiffers) {
            diagnostics_.warning("case-differs", document->root().place(),
                                 "'" + name + ".xml' is found only as '" +
                                     found->path.filename().string() + "'");
        }
    }
    return FoundElement{document->root(), found->path, false};
}

std::optional<FoundElement> Library::synthesise(const std::string& name, const std::string& xml) {
    const auto text = std::make_shared<SourceFile>("name '" + name + "'", xml);
    const auto document = XmlDocument::parse(text, diagnostics_);
    if (!document) return std::nullopt;
    return FoundElement{document->root(), {}, true};
}

std::vector<std::string> Library::names() const {
    std::vector<std::string> names;
    for (const XmlElement& entry : entries_) {
        const std::string name = entry.attribute("name");
        if (!name.empty()) names.push_back(name);
    }
    return names;
}

std::optional<fs::path> Library::findFile(const std::string& name, const Place& place,
                                          Diagnostics& diagnostics) const {
    if (SearchPath::leavesFolders(name)) {
        diagnostics.error("name-leaves-folders", place, "'" + name + "' leaves the search folders",
                          "a name relative to the archive's folder or a --path, without '..'");
        return std::nullopt;
    }
    const auto found = searchPath_.find(name);
    if (!found) {
        diagnostics.report({.code = "file-missing",
                            .place = place,
                            .message = "there is no file '" + name + "'",
                            .expected = "a file in the archive's folder or in a --path",
                            .suggestion = nearestName(name, searchPath_.namesNear(name))});
        return std::nullopt;
    }
    if (found->caseDiffers) {
        diagnostics.warning("case-differs", place,
                            "'" + name + "' is found only as '" + found->path.filename().string() +
                                "'",
                            "the same case, which other systems need");
    }
    return found->path;
}

std::shared_ptr<const SourceFile> Library::source(const fs::path& path) {
    auto& source = sources_[path];
    if (!source) {
        if (auto text = readFile(path))
            source = std::make_shared<SourceFile>(shownPath(path), std::move(*text));
    }
    return source;
}

namespace {

bool isArchive(const fs::path& file) {
    const auto text = readFile(file);
    if (!text) return false;
    Diagnostics ignored;
    const auto source = std::make_shared<SourceFile>(file.string(), *text);
    const auto document = XmlDocument::parse(source, ignored);
    return document && document->root().tag() == "archive";
}

std::vector<fs::path> archivesIn(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        if (entry.path().extension() == ".xml" && isArchive(entry.path()))
            files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace

std::optional<fs::path> resolveArchive(const fs::path& path, Diagnostics& diagnostics) {
    std::error_code error;
    if (!fs::exists(path, error)) {
        diagnostics.error("no-archive", {}, "there is no '" + path.string() + "'",
                          "an .xml file or the folder of an archive");
        return std::nullopt;
    }
    if (!fs::is_directory(path, error)) return path;
    const fs::path folder = fs::canonical(path, error);
    for (const std::string& name :
         {std::string("archive"), folder.filename().string(), std::string("helloworld")}) {
        const fs::path file = path / (name + ".xml");
        if (fs::is_regular_file(file, error)) return file;
    }
    const std::vector<fs::path> candidates = archivesIn(path);
    if (candidates.size() == 1) return candidates.front();
    std::vector<std::string> names;
    for (const fs::path& candidate : candidates)
        names.push_back(shownPath(candidate));
    diagnostics.error("no-archive", {},
                      "the folder '" + path.string() + "' has " +
                          (names.empty() ? "no archive" : "several archives"),
                      names.empty() ? "archive.xml in it" : "one of " + listOfNames(names));
    return std::nullopt;
}

SearchPath archiveSearchPath(const fs::path& archive, const std::vector<fs::path>& more) {
    SearchPath search;
    fs::path folder = archive.parent_path();
    if (folder.empty()) folder = ".";
    search.add(folder);
    for (const fs::path& path : more)
        search.add(path);
    std::error_code error;
    // Where the original's examples keep what several archives share.
    const fs::path parent = fs::absolute(folder, error).lexically_normal();
    const fs::path above =
        parent.has_filename() ? parent.parent_path() : parent.parent_path().parent_path();
    for (const char* name : {"textures", "shaders", "meshes", "methods", "ui", "data"}) {
        if (fs::is_directory(above / name, error)) search.add(above / name);
    }
    const fs::path home = homeFolder();
    for (const char* name : {"shaders", "meshes", "methods", "textures"})
        search.add(home / "resources" / name);
    return search;
}

} // namespace terrane
