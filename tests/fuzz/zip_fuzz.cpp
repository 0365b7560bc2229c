// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a zip: its directory, all its entries, and the file tree that shows them.
#include "core/diagnostic.h"
#include "core/file_stamp.h"
#include "core/files.h"
#include "core/zip_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <span>
#include <string>

using namespace terrane;

namespace {

// More bytes to unpack only cost time.
constexpr std::uint64_t kMostBytes = 4 << 20;

void demand(bool good) {
    if (!good) std::abort();
}

// What names promise: they stay below the zip, and each is one file.
void judgeNames(const ZipFile& zip) {
    const auto& entries = zip.entries();
    std::set<std::string> lowered;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        demand(!SearchPath::leavesFolders(entries[i].name));
        demand(std::filesystem::path(entries[i].name).lexically_normal() == entries[i].name);
        demand(i == 0 || entries[i - 1].name < entries[i].name);
        demand(zip.find(entries[i].name) == &entries[i]);
        demand(!zip.isFolder(entries[i].name));
        std::string lower = entries[i].name;
        for (char& c : lower)
            c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
        demand(lowered.insert(lower).second);
    }
}

std::uint64_t readEntry(const ZipFile& zip, const ZipFile::Entry& entry) {
    std::string problem;
    const auto bytes = zip.read(entry, problem);
    demand(bytes.has_value() == problem.empty());
    demand(!bytes || bytes->size() == entry.size);
    const auto file = zip.openEntry(entry, problem);
    demand(!bytes || file);
    std::array<std::byte, 7> piece;
    const std::uint64_t middle = entry.size / 2;
    const std::size_t count = std::min<std::uint64_t>(piece.size(), entry.size - middle);
    const auto out = std::span(piece).first(count);
    if (file) demand(file->size() == entry.size && file->read(middle, out));
    if (bytes)
        demand(std::ranges::equal(
            out,
            std::as_bytes(std::span(*bytes)).subspan(static_cast<std::size_t>(middle), count)));
    return bytes ? bytes->size() : 0;
}

void walk(const SearchPath& search, const std::string& folder, int& left) {
    const FileTree& files = search.files();
    for (const std::string& name : files.namesIn("a.zip/" + folder)) {
        if (--left < 0) return;
        const std::string path = folder.empty() ? name : folder + '/' + name;
        const bool file = files.isFile("a.zip/" + path);
        demand(file != files.isFolder("a.zip/" + path));
        if (file) {
            const auto found = search.find(path);
            demand(found && !found->caseDiffers && found->path == "a.zip/" + path);
            demand(!FileStamp::of(found->path, nullptr, files).differs(found->path, files));
        } else {
            walk(search, path, left);
        }
    }
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it so.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Diagnostics diagnostics;
    const auto zip = ZipFile::open(
        RandomAccessFile::ofBytes(std::string(reinterpret_cast<const char*>(data), size)), "a.zip",
        diagnostics);
    demand((zip == nullptr) == (diagnostics.errors() > 0));
    for (const Diagnostic& diagnostic : diagnostics.all())
        toString(diagnostic);
    if (!zip) return 0;
    judgeNames(*zip);
    std::uint64_t bytes = 0;
    for (const ZipFile::Entry& entry : zip->entries()) {
        if (bytes > kMostBytes || entry.size > kMostBytes) break;
        bytes += readEntry(*zip, entry);
    }
    SearchPath search{FileTree(zip)};
    search.add("a.zip");
    int left = 1000;
    walk(search, "", left);
    return 0;
}
