// SPDX-License-Identifier: BSD-3-Clause
#include "app/pack.h"

#include "app/check.h"
#include "app/player.h"
#include "core/random_access_file.h"
#include "core/text.h"
#include "core/zip_file.h"
#include "core/zip_writer.h"
#include "resource/library.h"
#include "resource/manager.h"
#include "resource/prepared_data.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <unistd.h>

namespace terrane {

namespace fs = std::filesystem;

namespace {

/// The end of a path that a name led to, as the file system spells it.
std::string nameOf(const fs::path& path, const std::string& name) {
    std::string slashed = name;
    std::replace(slashed.begin(), slashed.end(), '\\', '/');
    const fs::path wanted = fs::path(slashed).lexically_normal();
    const fs::path found = path.lexically_normal();
    auto part = found.end();
    for (auto i = wanted.begin(); i != wanted.end() && part != found.begin(); ++i)
        --part;
    fs::path result;
    for (; part != found.end(); ++part)
        result /= *part;
    return result.generic_string();
}

/// Pictures are packed already.
bool isPacked(const fs::path& path) {
    const std::string extension = path.extension().string();
    return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

class Packing {
public:
    Packing(const Registry& registry, const fs::path& archive, const std::vector<fs::path>& paths)
        : player_(registry,
                  {.archive = archive, .paths = paths, .width = 64, .height = 64, .debug = true}) {}

    PackResult run(const fs::path& archive, const fs::path& output) {
        player_.check();
        if (diagnostics().errors() == 0) pack(archive, output);
        result_.diagnostics = diagnostics().all();
        sortByPlace(result_.diagnostics);
        return std::move(result_);
    }

private:
    Diagnostics& diagnostics() { return player_.diagnostics(); }

    void pack(const fs::path& archive, const fs::path& output) {
        const auto file = resolveArchive(archive, diagnostics());
        if (!file) return;
        files_ = file->files;
        add(file->path.filename().string(), file->path, false);
        for (const auto& [name, entry] : player_.resources()->entries()) {
            if (!entry->descriptor.empty() && entry->descriptor != file->path)
                add(name + ".xml", entry->descriptor, false);
            for (const UsedFile& used : entry->files)
                add(used.name, used.path, used.inPieces);
        }
        for (const auto& [name, path] : player_.resources()->filesNotRead())
            add(name, path, false);
        result_.builtIn = builtIn_.size();
        if (!namesDiffer()) return;
        fs::path beside = output;
        beside += "." + std::to_string(::getpid()) + ".tmp";
        if (write(beside, output, file->path)) return;
        std::error_code ignored;
        fs::remove(beside, ignored);
        result_.files.clear();
        result_.size = 0;
    }

    /// Of data that is not prepared, the script that makes it comes along: it tells that the data
    /// is not missing.
    void addScript(const std::string& name) {
        const SearchPath& search = player_.resources()->library().searchPath();
        const auto script = preparingScript(search, name);
        if (script) add(script->filename().string(), *script, false);
    }

    void add(const std::string& name, const fs::path& path, bool inPieces) {
        if (path.empty()) return addScript(name);
        if (isBuiltIn(path)) {
            builtIn_.insert(path);
            return;
        }
        const std::string packed = nameOf(path, name);
        const auto [content, isNew] = contents_.try_emplace(packed, ZipContent{packed, path});
        content->second.stored |= inPieces || isPacked(path);
        if (!isNew && content->second.path.lexically_normal() != path.lexically_normal())
            collide(path, content->second.path, "have one name");
        if (!isNew) return;
        const auto file = files_.open(path);
        const std::uint64_t size = file ? file->size() : 0;
        // Whatever they unpack to, smaller ones are no bombs.
        content->second.stored |= size > ZipFile::kSmall;
        result_.files.push_back({packed, path, size});
    }

    bool isBuiltIn(const fs::path& path) const {
        return std::any_of(own_.folders().begin(), own_.folders().end(), [&](const auto& folder) {
            return path.native().starts_with(folder.native() + '/');
        });
    }

    bool namesDiffer() {
        std::sort(result_.files.begin(), result_.files.end(),
                  [](const auto& a, const auto& b) { return a.name < b.name; });
        std::map<std::string, const PackedFile*> known;
        for (const PackedFile& file : result_.files) {
            std::string lower = file.name;
            std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
                return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
            });
            const auto [first, isNew] = known.try_emplace(lower, &file);
            if (isNew) continue;
            collide(file.path, first->second->path,
                    "differ in their case alone, which some systems ignore,");
        }
        if (diagnostics().errors() > 0) result_.files.clear();
        return diagnostics().errors() == 0;
    }

    void collide(const fs::path& a, const fs::path& b, const std::string& how) {
        diagnostics().error("pack-collision", {},
                            inQuotes(shownPath(a)) + " and " + inQuotes(shownPath(b)) + ' ' + how +
                                " in the zip",
                            "another name for one of them");
    }

    /// Nobody sees the zip before it has been opened as a player does.
    bool write(const fs::path& beside, const fs::path& output, const fs::path& archive) {
        std::vector<ZipContent> contents;
        for (const auto& [name, content] : contents_)
            contents.push_back(content);
        std::string problem;
        if (!writeZip(beside, contents, files_, problem)) return fail(output, problem);
        auto file = RandomAccessFile::open(beside);
        if (!file) return fail(output, "it can't be read again");
        result_.size = file->size();
        const auto zip = ZipFile::open(std::move(file), output, diagnostics());
        if (!zip || !plays(zip, archive.filename(), output)) return false;
        std::error_code error;
        fs::rename(beside, output, error);
        return error ? fail(output, error.message()) : true;
    }

    bool plays(std::shared_ptr<const ZipFile> zip, const fs::path& archive,
               const fs::path& output) {
        Diagnostics several;
        const auto first = resolveArchive(std::move(zip), several);
        if (first && first->path.filename() == archive) return true;
        diagnostics().error("pack-ambiguous", {},
                            inQuotes(shownPath(output)) +
                                " has several archives and would not play " +
                                inQuotes(archive.string()),
                            "the archive named 'archive.xml'");
        return false;
    }

    bool fail(const fs::path& output, const std::string& problem) {
        diagnostics().error("pack-failed", {},
                            "can't write " + inQuotes(shownPath(output)) + ": " + problem);
        return false;
    }

    Player player_;
    FileTree files_;
    const SearchPath own_ = builtInSearchPath();
    std::map<std::string, ZipContent> contents_; ///< by name, and so in order
    std::set<fs::path> builtIn_;
    PackResult result_;
};

} // namespace

PackResult packArchive(const Registry& registry, const fs::path& archive,
                       const std::vector<fs::path>& paths, const fs::path& output) {
    return Packing(registry, archive, paths).run(archive, output);
}

} // namespace terrane
