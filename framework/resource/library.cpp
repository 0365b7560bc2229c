// SPDX-License-Identifier: BSD-3-Clause
#include "resource/library.h"

#include "core/text.h"
#include "resource/prepared_data.h"

#include <algorithm>

namespace terrane {

namespace fs = std::filesystem;

namespace {

bool isImage(const std::string& name) {
    const auto ends = [&](const char* ending) { return name.ends_with(ending); };
    return name.size() > 4 && (ends(".jpg") || ends(".png") || ends(".bmp") || ends(".tga"));
}

// "renderbuffer-<size>-<internalformat>[-<anything>]"; an empty text for any other name.
std::string renderbufferXml(const std::string& name) {
    if (!name.starts_with("renderbuffer")) return {};
    const auto pieces = split(name, '-');
    if (pieces.size() < 3) return {};
    const std::string size = asXml(pieces[1]);
    return "<texture2D internalformat=\"" + asXml(pieces[2]) + "\" width=\"" + size +
           "\" height=\"" + size +
           "\" format=\"RED\" type=\"FLOAT\" min=\"NEAREST\" mag=\"NEAREST\"/>";
}

std::string imageXml(const std::string& name) {
    return "<texture2D source=\"" + asXml(name) +
           "\" internalformat=\"RGBA8\" min=\"LINEAR_MIPMAP_LINEAR\" mag=\"LINEAR\" "
           "wraps=\"REPEAT\" wrapt=\"REPEAT\"/>";
}

// The texture or mesh that a name stands for by itself, whatever archives say; an empty text for
// names that are looked up.
std::string fixedXml(const std::string& name) {
    if (std::string xml = renderbufferXml(name); !xml.empty()) return xml;
    if (isImage(name)) return imageXml(name);
    const bool program = name.find(';') != std::string::npos;
    if (!program && name.ends_with(".mesh")) return "<mesh source=\"" + asXml(name) + "\"/>";
    return {};
}

// Every piece needs its ';': what follows the last one is dropped.
std::string programXml(const std::string& name) {
    std::string xml = "<program>";
    const std::string list = name.substr(0, name.rfind(';'));
    for (const std::string_view piece : split(list, ';'))
        xml += "<module name=\"" + asXml(piece) + "\"/>";
    return xml + "</program>";
}

} // namespace

Library::Library(SearchPath searchPath, Diagnostics& diagnostics)
    : searchPath_(std::move(searchPath))
    , diagnostics_(diagnostics) {}

bool Library::addArchive(const fs::path& file) {
    const auto text = source(file);
    if (text) return addArchive(file, text);
    diagnostics_.error("file-missing", {}, "can't read the archive " + inQuotes(shownPath(file)));
    return false;
}

bool Library::addArchive(const fs::path& file, std::shared_ptr<const SourceFile> text) {
    const auto document = XmlDocument::parse(std::move(text), diagnostics_);
    if (!document) return false;
    if (archives_.empty()) archivePlace_ = document->root().place();
    archives_.push_back(file);
    for (const XmlElement& element : document->root().children())
        addEntry(element);
    return true;
}

void Library::addEntry(const XmlElement& element) {
    entries_.push_back(element);
    const std::string name = element.attribute("name");
    if (name.empty()) return;
    if (!fixedXml(name).empty()) {
        diagnostics_.warning("reserved-name", element.place(),
                             "the name " + inQuotes(name) +
                                 " always stands for the file or buffer itself; this entry is "
                                 "never used",
                             "another name");
        return;
    }
    const auto [known, isNew] =
        entryByName_.insert({name, {entries_.size() - 1, archives_.size() - 1}});
    if (isNew) {
        names_.push_back(name);
        return;
    }
    const Place first = entries_[known->second.element].place();
    diagnostics_.warning("duplicate-name", element.place(),
                         "an entry named " + inQuotes(name) + " stands at " + first.toString() +
                             " already; this one is never used",
                         "another name");
}

std::optional<FoundElement> Library::find(const std::string& name) {
    if (name.empty()) return std::nullopt;
    if (const std::string xml = fixedXml(name); !xml.empty()) return synthesise(name, xml);
    if (auto entry = findEntry(name)) return entry;
    if (auto file = findXmlFile(name)) return file;
    if (name.find(';') != std::string::npos) return synthesise(name, programXml(name));
    return std::nullopt;
}

std::optional<FoundElement> Library::findEntry(const std::string& name) const {
    const auto found = entryByName_.find(name);
    if (found == entryByName_.end()) return std::nullopt;
    return FoundElement{entries_[found->second.element], archives_[found->second.archive]};
}

// A folder whose file is damaged is passed over.
std::optional<FoundElement> Library::findXmlFile(const std::string& name) {
    for (const SearchPath::Found& found : searchPath_.findAll(name + ".xml")) {
        if (const auto document = parsed(found.path))
            return FoundElement{document->root(), found.path, false, found.caseDiffers};
        damaged_.insert(name);
    }
    return std::nullopt;
}

std::shared_ptr<const XmlDocument> Library::parsed(const fs::path& path) {
    const auto [document, isNew] = documents_.try_emplace(path);
    if (!isNew) return document->second;
    const auto text = source(path);
    if (!text) {
        diagnostics_.error("file-unreadable", {}, "can't read " + inQuotes(shownPath(path)));
        return nullptr;
    }
    return document->second = XmlDocument::parse(text, diagnostics_);
}

std::optional<FoundElement> Library::synthesise(const std::string& name, const std::string& xml) {
    const auto text = std::make_shared<SourceFile>("name " + inQuotes(name), xml);
    const auto document = XmlDocument::parse(text, diagnostics_);
    if (!document) return std::nullopt;
    return FoundElement{document->root(), {}, true};
}

std::optional<fs::path> Library::findFile(const std::string& name, const Place& place,
                                          Diagnostics& diagnostics) const {
    if (SearchPath::leavesFolders(name)) {
        diagnostics.error("name-leaves-folders", place,
                          inQuotes(name) + " leaves the search folders",
                          "a name relative to the archive's folder or a --path, without '..'");
        return std::nullopt;
    }
    const auto found = searchPath_.find(name);
    if (!found) {
        if (const auto script = preparingScript(searchPath_, name)) {
            diagnostics.report(
                {.severity = Severity::note,
                 .code = kDataNotPrepared,
                 .place = place,
                 .message = "skipped: the data " + inQuotes(name) + " is not prepared yet",
                 .expected = "the file that " + inQuotes(shownPath(*script)) + " makes"});
            return std::nullopt;
        }
        diagnostics.report({.code = "file-missing",
                            .place = place,
                            .message = "there is no file " + inQuotes(name),
                            .expected = "a file in the archive's folder or in a --path",
                            .suggestion = nearestName(name, searchPath_.namesNear(name))});
        return std::nullopt;
    }
    if (found->caseDiffers) {
        diagnostics.warning("case-differs", place,
                            inQuotes(name) + " is found only as " +
                                inQuotes(found->path.filename().string()),
                            "the same case, which other systems need");
    }
    return found->path;
}

void Library::setText(const fs::path& path, std::string text) {
    sources_[path] = std::make_shared<SourceFile>(shownPath(path), std::move(text));
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
    // A damaged archive is still the one that was meant; opening it tells what is wrong.
    if (!document) return text->find("<archive") != std::string::npos;
    return document->root().tag() == "archive";
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
        diagnostics.error("no-archive", {}, "there is no " + inQuotes(path.string()),
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
                      "the folder " + inQuotes(path.string()) + " has " +
                          (names.empty() ? "no archive" : "several archives"),
                      names.empty() ? "archive.xml in it" : "one of " + listOfNames(names));
    return std::nullopt;
}

namespace {

void addBuiltIn(SearchPath& search) {
    std::error_code error;
    const fs::path resources = homeFolder() / "resources";
    for (const char* name : {"shaders", "meshes", "methods", "textures", "fonts"}) {
        if (fs::is_directory(resources / name, error)) search.add(resources / name);
    }
}

} // namespace

SearchPath builtInSearchPath() {
    SearchPath search;
    addBuiltIn(search);
    return search;
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
    addBuiltIn(search);
    return search;
}

} // namespace terrane
