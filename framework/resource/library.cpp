// SPDX-License-Identifier: BSD-3-Clause
#include "resource/library.h"

#include "core/text.h"
#include "core/zip_file.h"
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
    std::string problem;
    const auto text = source(file, &problem);
    if (text) return addArchive(file, text);
    diagnostics_.error("file-missing", {},
                       "can't read the archive " + inQuotes(shownPath(file)) +
                           (problem.empty() ? "" : ": " + problem));
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
    std::string problem;
    const auto text = source(path, &problem);
    if (!text) {
        diagnostics_.error("file-unreadable", {},
                           "can't read " + inQuotes(shownPath(path)) +
                               (problem.empty() ? "" : ": " + problem));
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

std::shared_ptr<const SourceFile> Library::source(const fs::path& path, std::string* problem) {
    auto& source = sources_[path];
    if (!source) {
        if (auto text = searchPath_.files().read(path, problem))
            source = std::make_shared<SourceFile>(shownPath(path), std::move(*text));
    }
    return source;
}

const FileStamp& Library::stamp(const fs::path& path, FileStamp::Significant significant) {
    const auto [known, isNew] = stamps_.try_emplace({path, significant});
    if (isNew) known->second = FileStamp::of(path, significant, searchPath_.files());
    return known->second;
}

namespace {

bool isArchive(const FileTree& files, const fs::path& file) {
    const auto text = files.read(file);
    if (!text) return false;
    Diagnostics ignored;
    const auto source = std::make_shared<SourceFile>(file.string(), *text);
    const auto document = XmlDocument::parse(source, ignored);
    // A damaged archive is still the one that was meant; opening it tells what is wrong.
    if (!document) return text->find("<archive") != std::string::npos;
    return document->root().tag() == "archive";
}

std::vector<fs::path> archivesIn(const FileTree& files, const fs::path& folder) {
    std::vector<fs::path> found;
    for (const std::string& name : files.namesIn(folder)) {
        const fs::path file = folder / name;
        if (file.extension() == ".xml" && isArchive(files, file)) found.push_back(file);
    }
    return found;
}

bool isZip(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return extension == ".zip";
}

// The zip that a path leads into; empty for others.
fs::path zipAbove(fs::path path) {
    std::error_code error;
    while (path.has_relative_path() && path.has_parent_path()) {
        path = path.parent_path();
        if (isZip(path) && fs::is_regular_file(path, error)) return path;
    }
    return {};
}

// Whoever zips a folder gets a zip of that folder, and some systems add one of their own.
fs::path topFolder(const FileTree& files, const fs::path& zip) {
    std::vector<std::string> names = files.namesIn(zip);
    std::erase(names, "__MACOSX");
    const bool one = names.size() == 1 && files.isFolder(zip / names.front());
    return one ? zip / names.front() : zip;
}

std::optional<ArchiveFile> archiveIn(const FileTree& files, const fs::path& folder,
                                     Diagnostics& diagnostics) {
    std::error_code error;
    const bool zipped = files.nameInZip(folder).has_value();
    const fs::path full = zipped ? folder : fs::canonical(folder, error);
    for (const std::string& name :
         {std::string("archive"), zipped ? full.stem().string() : full.filename().string(),
          std::string("helloworld")}) {
        const fs::path file = folder / (name + ".xml");
        if (files.isFile(file)) return ArchiveFile{file, files};
    }
    const std::vector<fs::path> candidates = archivesIn(files, folder);
    if (candidates.size() == 1) return ArchiveFile{candidates.front(), files};
    std::vector<std::string> names;
    for (const fs::path& candidate : candidates)
        names.push_back(shownPath(candidate));
    diagnostics.error("no-archive", {},
                      (zipped ? "the zip " : "the folder ") + inQuotes(folder.string()) + " has " +
                          (names.empty() ? "no archive" : "several archives"),
                      names.empty() ? "archive.xml in it" : "one of " + listOfNames(names));
    return std::nullopt;
}

} // namespace

std::optional<ArchiveFile> resolveArchive(std::shared_ptr<const ZipFile> zip,
                                          Diagnostics& diagnostics) {
    const fs::path path = zip->path();
    const FileTree files(std::move(zip));
    return archiveIn(files, topFolder(files, path), diagnostics);
}

std::optional<ArchiveFile> resolveArchive(const fs::path& path, Diagnostics& diagnostics) {
    std::error_code error;
    if (fs::is_directory(path, error)) return archiveIn({}, path, diagnostics);
    const bool found = fs::exists(path, error);
    if (found && !isZip(path)) return ArchiveFile{.path = path, .files = {}};
    const fs::path above = found ? path : zipAbove(path);
    if (above.empty()) {
        diagnostics.error("no-archive", {}, "there is no " + inQuotes(path.string()),
                          "an .xml file, a .zip, or the folder of an archive");
        return std::nullopt;
    }
    const auto zip = ZipFile::open(above, diagnostics);
    if (!zip) return std::nullopt;
    if (found) return resolveArchive(zip, diagnostics);
    const FileTree files(zip);
    if (files.isFile(path)) return ArchiveFile{path, files};
    if (files.isFolder(path)) return archiveIn(files, path, diagnostics);
    diagnostics.report(
        {.code = "no-archive",
         .message = "there is no " + inQuotes(path.string()),
         .expected = "a file of the zip",
         .suggestion = nearestName(path.filename().string(), files.namesIn(path.parent_path()))});
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

SearchPath archiveSearchPath(const ArchiveFile& archive, const std::vector<fs::path>& more) {
    return archiveSearchPath(archive.path, more, archive.files);
}

SearchPath archiveSearchPath(const fs::path& archive, const std::vector<fs::path>& more,
                             FileTree files) {
    SearchPath search(std::move(files));
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
