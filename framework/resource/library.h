// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "core/file_stamp.h"
#include "core/files.h"
#include "resource/xml.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace terrane {

/// The element that describes a resource, however its name led there (ork reference 1.2, 1.3).
struct FoundElement {
    XmlElement element;
    std::filesystem::path file; ///< empty when it was made from the name alone
    bool synthesised = false;   ///< made from the name: `grass.png`, `a;b;`, `grid.mesh`
    bool caseDiffers = false;   ///< the file was found only by ignoring the case of its name
};

/// Turns names into XML elements and data files: the archives in order, then the search folders.
/// Parses each file once.
class Library {
public:
    Library(SearchPath searchPath, Diagnostics& diagnostics);

    /// Parses an archive: every direct child of its root with a `name` becomes an entry. False with
    /// diagnostics ("file-missing", "xml-syntax") when it can't be read.
    bool addArchive(const std::filesystem::path& file);
    /// The same, of a text that was read already.
    bool addArchive(const std::filesystem::path& file, std::shared_ptr<const SourceFile> text);

    /// The entries of all archives in document order, unnamed ones included.
    const std::vector<XmlElement>& entries() const { return entries_; }

    /// The element for a name, or nothing (without a diagnostic) when there is none.
    std::optional<FoundElement> find(const std::string& name);
    /// True when there is a file for a name that was not found, but one that is no XML. That has
    /// been reported.
    bool isDamaged(const std::string& name) const { return damaged_.contains(name); }

    /// Names of archive entries, for suggestions.
    const std::vector<std::string>& names() const { return names_; }

    /// The root element of the first archive; none before there is one.
    const Place& archivePlace() const { return archivePlace_; }

    const SearchPath& searchPath() const { return searchPath_; }
    Diagnostics& diagnostics() const { return diagnostics_; }

    /// A data file of the search folders. Nothing, with a diagnostic at `place` ("file-missing",
    /// "name-leaves-folders"), when there is none, or with a note ("data-not-prepared") when a
    /// script has yet to make it (see prepared_data.h); a warning ("case-differs") when only the
    /// case of its name differs.
    std::optional<std::filesystem::path> findFile(const std::string& name, const Place& place,
                                                  Diagnostics& diagnostics) const;

    /// What a file is to say instead of what it says; to be called before anybody reads it.
    void setText(const std::filesystem::path& path, std::string text);
    /// A text file that diagnostics can point into; read once. Null when it can't be read; the
    /// reason is told where there is one beyond that.
    std::shared_ptr<const SourceFile> source(const std::filesystem::path& path,
                                             std::string* problem = nullptr);
    /// What a file was like when it was first asked for here, which is before its text is read: all
    /// who use the text share it.
    const FileStamp& stamp(const std::filesystem::path& path, FileStamp::Significant significant);
    /// All that were read, by path.
    const std::map<std::filesystem::path, std::shared_ptr<const SourceFile>>& sources() const {
        return sources_;
    }

private:
    struct Entry {
        std::size_t element; // in entries_
        std::size_t archive; // in archives_
    };

    void addEntry(const XmlElement& element);
    std::optional<FoundElement> findEntry(const std::string& name) const;
    std::optional<FoundElement> findXmlFile(const std::string& name);
    std::shared_ptr<const XmlDocument> parsed(const std::filesystem::path& path);
    std::optional<FoundElement> synthesise(const std::string& name, const std::string& xml);

    SearchPath searchPath_;
    Diagnostics& diagnostics_;
    std::vector<XmlElement> entries_;
    std::vector<std::string> names_;
    std::unordered_map<std::string, Entry> entryByName_; ///< the first of each name
    std::vector<std::filesystem::path> archives_;
    Place archivePlace_;
    std::map<std::filesystem::path, std::shared_ptr<const XmlDocument>>
        documents_; ///< null: damaged
    std::map<std::filesystem::path, std::shared_ptr<const SourceFile>> sources_;
    std::map<std::pair<std::filesystem::path, FileStamp::Significant>, FileStamp> stamps_;
    std::set<std::string> damaged_;
};

/// The XML file of an archive, and what it is in.
struct ArchiveFile {
    std::filesystem::path path;
    FileTree files;
};

/// The archive that a path given by a user stands for: an .xml file itself; of a folder,
/// archive.xml, else <folder>.xml, helloworld.xml, or the only .xml whose root is <archive>. A zip
/// is a folder, or stands for the only folder that it has; a path may lead on into it. Nothing,
/// with a diagnostic ("no-archive" that lists the candidates, or why ZipFile refuses the zip),
/// otherwise.
std::optional<ArchiveFile> resolveArchive(const std::filesystem::path& path,
                                          Diagnostics& diagnostics);

/// The same of a zip that is open already.
std::optional<ArchiveFile> resolveArchive(std::shared_ptr<const ZipFile> zip,
                                          Diagnostics& diagnostics);

/// The folders in which an archive's names are looked up: its own, then `more` in order, then the
/// original's neighbour folders that exist, then Terrane's own resources.
/// @param files what the archive is in
SearchPath archiveSearchPath(const std::filesystem::path& archive,
                             const std::vector<std::filesystem::path>& more, FileTree files = {});
SearchPath archiveSearchPath(const ArchiveFile& archive,
                             const std::vector<std::filesystem::path>& more);

/// The folders of Terrane's own resources.
SearchPath builtInSearchPath();

} // namespace terrane
