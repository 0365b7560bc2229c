// SPDX-License-Identifier: BSD-3-Clause
#include "core/zip_file.h"

#include "core/diagnostic.h"
#include "core/zip_writer.h"
#include "temporary_folder.h"
#include "zip_bytes.h"

#include <doctest/doctest.h>

#include <functional>
#include <map>
#include <random>
#include <zip.h>

using namespace terrane;
using namespace terrane::test;
namespace fs = std::filesystem;

namespace {

std::shared_ptr<const ZipFile> open(std::string bytes, Diagnostics& diagnostics) {
    return ZipFile::open(RandomAccessFile::ofBytes(std::move(bytes)), "a.zip", diagnostics);
}

// The judge: what libzip reads.
std::map<std::string, std::string> contentsByLibzip(const std::string& bytes) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* const source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    zip_t* const zip = zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error);
    REQUIRE(zip);
    std::map<std::string, std::string> contents;
    for (zip_int64_t i = 0; i < zip_get_num_entries(zip, 0); ++i) {
        zip_stat_t stat;
        REQUIRE(zip_stat_index(zip, i, 0, &stat) == 0);
        std::string text(stat.size, '?');
        zip_file_t* const file = zip_fopen_index(zip, i, 0);
        REQUIRE(file);
        CHECK(zip_fread(file, text.data(), text.size()) == static_cast<zip_int64_t>(text.size()));
        zip_fclose(file);
        contents[stat.name] = text;
    }
    zip_discard(zip);
    return contents;
}

std::map<std::string, std::string> contentsOf(const ZipFile& zip) {
    std::map<std::string, std::string> contents;
    for (const ZipFile::Entry& entry : zip.entries()) {
        std::string problem;
        const auto bytes = zip.read(entry, problem);
        CHECK(problem.empty());
        REQUIRE(bytes);
        contents[entry.name] = *bytes;
        const auto file = zip.openEntry(entry, problem);
        REQUIRE(file);
        REQUIRE(file->size() == bytes->size());
        std::string pieces(bytes->size(), '?');
        CHECK(file->read(0, std::as_writable_bytes(std::span(pieces))));
        CHECK(pieces == *bytes);
    }
    return contents;
}

std::string noise(std::size_t count) {
    std::mt19937 random(7);
    std::string bytes(count, '\0');
    for (char& c : bytes)
        c = static_cast<char>(random());
    return bytes;
}

} // namespace

TEST_CASE("A zip is read as libzip reads it") {
    struct Row {
        const char* name;
        std::vector<ZipPiece> pieces;
        ZipEnds ends;
    };
    const std::string large = noise(200'000), text(150'000, 'x');
    const Row rows[] = {
        {"stored", {{.name = "a.xml", .bytes = "<archive/>"}}, {}},
        {"deflated", {{.name = "a.xml", .bytes = text, .deflated = true}}, {}},
        {"of several chunks", {{.name = "a", .bytes = large, .deflated = true}}, {}},
        {"empty files", {{.name = "a"}, {.name = "b", .deflated = true}}, {}},
        {"no entry", {}, {}},
        {"folders", {{.name = "f/b", .bytes = "1"}, {.name = "f/a/c", .bytes = "2"}}, {}},
        {"unsorted, with UTF-8",
         {{.name = "z", .bytes = "1"},
          {.name = "f\xc3\xbcr", .bytes = "2", .flags = 1 << 11},
          {.name = "a", .bytes = "3"}},
         {}},
        {"a comment", {{.name = "a", .bytes = "1"}}, {.comment = "PK\5\6 is no end"}},
        {"large values", {{.name = "a", .bytes = "12", .in64 = true}}, {}},
        {"large values, and their record",
         {{.name = "a", .bytes = text, .deflated = true, .in64 = true}, {.name = "b"}},
         {.in64 = true}},
        {"bytes before the first entry", {{.name = "a", .bytes = "1"}}, {.before = "#!run\n"}},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        const std::string bytes = zipBytes(row.pieces, row.ends);
        Diagnostics diagnostics;
        const auto zip = open(bytes, diagnostics);
        for (const Diagnostic& diagnostic : diagnostics.all())
            FAIL_CHECK(toString(diagnostic));
        REQUIRE(zip);
        const auto contents = contentsOf(*zip);
        CHECK(contents.size() == row.pieces.size());
        for (const ZipPiece& piece : row.pieces)
            CHECK(contents.at(piece.name) == piece.bytes);
        if (!row.pieces.empty()) CHECK(contents == contentsByLibzip(bytes));
    }
}

TEST_CASE("Folders of a zip are told by the names of its files") {
    Diagnostics diagnostics;
    const auto zip = open(zipBytes({{.name = "b/", .unixMode = 0040755},
                                    {.name = "a/x/1", .bytes = "1"},
                                    {.name = "a-b", .bytes = "2"},
                                    {.name = "a/y", .bytes = "3"}}),
                          diagnostics);
    REQUIRE(zip);
    CHECK(zip->namesIn("") == std::vector<std::string>{"a", "a-b"});
    CHECK(zip->namesIn("a") == std::vector<std::string>{"x", "y"});
    CHECK(zip->namesIn("a/y").empty());
    CHECK(zip->isFolder(""));
    CHECK(zip->isFolder("a"));
    CHECK(zip->isFolder("a/x"));
    CHECK_FALSE(zip->isFolder("a/y"));
    CHECK_FALSE(zip->isFolder("a-"));
    CHECK(zip->find("a/y"));
    CHECK_FALSE(zip->find("a"));
    CHECK_FALSE(zip->find("A/y"));
}

TEST_CASE("A hostile zip is refused, with its reason") {
    struct Row {
        const char* name;
        std::vector<ZipPiece> pieces;
        const char* code;
        const char* message;
    };
    const auto named = [](std::string name) {
        return std::vector<ZipPiece>{{.name = std::move(name), .bytes = "1"}};
    };
    const std::string zeros(3 << 20, '\0');
    std::vector<ZipPiece> many;
    for (std::size_t i = 0; i <= ZipFile::kMostEntries; ++i)
        many.push_back({.name = std::to_string(i)});
    std::vector<ZipPiece> sum;
    for (int i = 0; i < 5; ++i)
        sum.push_back({.name = std::to_string(i),
                       .deflated = true,
                       .size = ZipFile::kLargestUnpacked,
                       .packed = std::string(6 << 20, 'x')});
    const Row rows[] = {
        {"up", named("../a"), "zip-unsafe-name", "has a part '..'"},
        {"up, further in", named("a/../../b"), "zip-unsafe-name", "has a part '..'"},
        {"up, at the end", named("a/.."), "zip-unsafe-name", "has a part '..'"},
        {"absolute", named("/etc/passwd"), "zip-unsafe-name", "is absolute"},
        {"a drive", named("C:a"), "zip-unsafe-name", "has a colon"},
        {"a backslash", named("..\\a"), "zip-unsafe-name", "has a backslash"},
        {"here", named("./a"), "zip-unsafe-name", "has a part '.'"},
        {"an empty part", named("a//b"), "zip-unsafe-name", "has an empty part"},
        {"two slashes at the end", named("a//"), "zip-unsafe-name", "has an empty part"},
        {"no name", named(""), "zip-unsafe-name", "is empty"},
        {"only a slash", named("/"), "zip-unsafe-name", "is empty"},
        {"a zero", named(std::string("a\0b", 3)), "zip-unsafe-name", "control characters"},
        {"a line break", named("a\nb"), "zip-unsafe-name", "control characters"},
        {"no UTF-8", named("\x81\x82"), "zip-unsafe-name", "is no UTF-8"},
        {"a slash written long", named("..\xc0\xaf"), "zip-unsafe-name", "is no UTF-8"},
        {"half of a pair", named("\xed\xa0\x80"), "zip-unsafe-name", "is no UTF-8"},
        {"cut UTF-8", named("a\xe2\x82"), "zip-unsafe-name", "is no UTF-8"},
        {"very long", named(std::string(1001, 'a')), "zip-unsafe-name", "longer than 1000 bytes"},
        {"twice", {{.name = "a"}, {.name = "a"}}, "zip-duplicate-name", "is there twice"},
        {"another case", {{.name = "a"}, {.name = "A"}}, "zip-duplicate-name", "only in its case"},
        {"another case of a folder",
         {{.name = "a/b"}, {.name = "A/c"}},
         "zip-duplicate-name",
         "only in its case"},
        {"file and folder", {{.name = "a"}, {.name = "a/b"}}, "zip-duplicate-name", "a folder"},
        {"folder and file", {{.name = "a/b"}, {.name = "a"}}, "zip-duplicate-name", "a folder"},
        {"link", {{.name = "a", .bytes = "/", .unixMode = 0120777}}, "zip-special-file", "link"},
        {"pipe", {{.name = "a", .unixMode = 0010644}}, "zip-special-file", "neither a file"},
        {"device", {{.name = "a", .unixMode = 0020644}}, "zip-special-file", "neither a file"},
        {"a folder that is a file", {{.name = "a", .unixMode = 0040755}}, "zip-special-file", ""},
        {"encrypted", {{.name = "a", .flags = 1}}, "zip-encrypted", "is encrypted"},
        {"strongly", {{.name = "a", .flags = 1 << 6}}, "zip-encrypted", "is encrypted"},
        {"AES", {{.name = "a", .method = 99}}, "zip-method", "method 99"},
        {"bzip2", {{.name = "a", .method = 12}}, "zip-method", "method 12"},
        {"a bomb", {{.name = "a", .bytes = zeros, .deflated = true}}, "zip-too-large", "as bombs"},
        {"a lie",
         {{.name = "a", .bytes = "1", .deflated = true, .size = 1 << 30}},
         "zip-too-large",
         "as bombs"},
        {"one too large",
         {{.name = "a", .bytes = "1", .deflated = true, .size = ~std::uint64_t(0), .in64 = true}},
         "zip-too-large",
         "unpacks to 18446744073709551615"},
        {"too large together", sum, "zip-too-large", "its entries unpack to more than"},
        {"too many", many, "zip-too-large", "it has 20001 entries"},
        {"two sizes", {{.name = "a", .bytes = "1", .size = 2}}, "zip-damaged", "two sizes"},
        {"out of the zip",
         {{.name = "a", .bytes = "1", .size = 1000, .packedSize = 1000}},
         "zip-damaged",
         "behind the end"},
        {"far out of the zip",
         {{.name = "a",
           .bytes = "1",
           .size = ~std::uint64_t(0) - 1,
           .packedSize = ~std::uint64_t(0) - 1,
           .in64 = true}},
         "zip-damaged",
         "behind the end"},
        {"header far out",
         {{.name = "a", .header = ~std::uint64_t(0) - 20, .in64 = true}},
         "zip-damaged",
         "is not where"},
        {"no header", {{.name = "a", .header = 1}}, "zip-damaged", "is not where"},
        {"another name", {{.name = "a", .localName = "b"}}, "zip-damaged", "is another one"},
        {"a longer name", {{.name = "a", .localName = "ab"}}, "zip-damaged", "is another one"},
        {"shared bytes",
         {{.name = "a", .bytes = "1"}, {.name = "a1", .header = 0, .localName = "a"}},
         "zip-damaged",
         ""},
        {"on another disk", {{.name = "a", .disk = 1}}, "zip-damaged", "another part"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        Diagnostics diagnostics;
        CHECK_FALSE(open(zipBytes(row.pieces), diagnostics));
        REQUIRE(diagnostics.size() >= 1);
        const Diagnostic found = diagnostics.all()[0];
        CHECK(found.code == row.code);
        CHECK(found.severity == Severity::error);
        CAPTURE(found.message);
        CHECK(found.message.find(row.message) != std::string::npos);
        CHECK(found.message.find("'a.zip'") != std::string::npos);
    }
}

TEST_CASE("Entries that share bytes are refused") {
    // The second begins with the header that lies in the bytes of the first.
    const std::string inner = zipBytes({{.name = "b", .bytes = std::string(50, 'b')}});
    const std::string entry = inner.substr(0, 30 + 1 + 50);
    Diagnostics diagnostics;
    const auto zip = open(zipBytes({{.name = "a", .bytes = entry},
                                    {.name = "b", .bytes = std::string(50, 'b'), .header = 31}}),
                          diagnostics);
    CHECK_FALSE(zip);
    REQUIRE(diagnostics.size() == 1);
    CHECK(diagnostics.all()[0].message == "'a.zip': entry 'b' shares bytes with 'a'");
}

TEST_CASE("What a zip's end says is checked") {
    struct Row {
        const char* name;
        std::string bytes;
        const char* message;
    };
    const std::vector<ZipPiece> pieces = {{.name = "a", .bytes = "1"}};
    const std::string good = zipBytes(pieces);
    const Row rows[] = {
        {"nothing", "", "it is no zip"},
        {"a text", "<archive/>", "it is no zip"},
        {"cut at the end", good.substr(0, good.size() - 1), "it is cut short"},
        {"more behind", good + "x", "it is cut short"},
        {"fewer entries", zipBytes(pieces, {.entries = 0}), "more than the 0 entries"},
        {"more entries", zipBytes(pieces, {.entries = 2}), "entry 2 of its directory is damaged"},
        {"directory before", zipBytes(pieces, {.beginShift = -1}), "not where its end says"},
        {"directory behind", zipBytes(pieces, {.beginShift = 1}), "not where its end says"},
        {"far behind", zipBytes(pieces, {.beginShift = 1 << 30}), "not where its end says"},
        {"damaged record", zipBytes(pieces, {.in64 = true, .size64Shift = 1}), "zip64"},
        {"endless record", zipBytes(pieces, {.in64 = true, .size64Shift = ~0ULL - 43}), "zip64"},
        {"directory far behind", zipBytes(pieces, {.beginShift = 1LL << 60, .in64 = true}),
         "not where its end says"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        Diagnostics diagnostics;
        CHECK_FALSE(open(row.bytes, diagnostics));
        REQUIRE(diagnostics.size() == 1);
        CHECK(diagnostics.all()[0].code == "zip-damaged");
        CAPTURE(diagnostics.all()[0].message);
        CHECK(diagnostics.all()[0].message.find(row.message) != std::string::npos);
    }
    for (std::size_t length = 0; length < good.size(); ++length) {
        Diagnostics diagnostics;
        CHECK_FALSE(open(good.substr(0, length), diagnostics));
    }
}

TEST_CASE("Of many faults the first ones are told") {
    std::vector<ZipPiece> pieces(100, {.name = "../a"});
    for (std::size_t i = 0; i < pieces.size(); ++i)
        pieces[i].name += std::to_string(i);
    Diagnostics diagnostics;
    CHECK_FALSE(open(zipBytes(pieces), diagnostics));
    CHECK(diagnostics.size() == 20);
}

TEST_CASE("What is wrong with the bytes of an entry is told when it is read") {
    struct Row {
        const char* name;
        ZipPiece piece;
        const char* problem;
    };
    const std::string text = "a text of some length, of some length, of some length";
    const std::string packed = deflated(text);
    const Row rows[] = {
        {"checksum", {.name = "a", .bytes = text, .checksum = 1}, "checksum is wrong"},
        {"checksum of deflated",
         {.name = "a", .bytes = text, .deflated = true, .checksum = 1},
         "checksum is wrong"},
        {"more than it says",
         {.name = "a", .bytes = text, .deflated = true, .size = text.size() - 1},
         "damaged"},
        {"far more than it says",
         {.name = "a", .bytes = std::string(9 << 20, 'x'), .deflated = true, .size = 10},
         "damaged"},
        {"less than it says",
         {.name = "a", .bytes = text, .deflated = true, .size = text.size() + 1},
         "cut short"},
        {"half of it",
         {.name = "a",
          .bytes = text,
          .deflated = true,
          .packed = packed.substr(0, packed.size() / 2)},
         "cut short"},
        {"more behind",
         {.name = "a", .bytes = text, .deflated = true, .packed = packed + "x"},
         "damaged"},
        {"no such bytes",
         {.name = "a", .bytes = text, .deflated = true, .packed = std::string(20, '\xff')},
         "damaged"},
        {"nothing", {.name = "a", .bytes = text, .deflated = true, .packedSize = 0}, "cut short"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        Diagnostics diagnostics;
        const auto zip = open(zipBytes({row.piece}), diagnostics);
        REQUIRE(zip);
        std::string problem;
        CHECK_FALSE(zip->read(zip->entries()[0], problem));
        CAPTURE(problem);
        CHECK(problem.find(row.problem) != std::string::npos);
        if (row.piece.deflated) CHECK_FALSE(zip->openEntry(zip->entries()[0], problem));
    }
}

TEST_CASE("A zip that is cut short while it is open gives what is left") {
    TemporaryFolder folder;
    const std::string bytes = noise(100'000);
    const fs::path path = folder.file("a.zip", zipBytes({{.name = "a", .bytes = bytes}}));
    Diagnostics diagnostics;
    const auto zip = ZipFile::open(path, diagnostics);
    REQUIRE(zip);
    fs::resize_file(path, 1000);
    std::string problem;
    CHECK_FALSE(zip->read(zip->entries()[0], problem));
    CHECK(problem == "the zip was cut short");
    const auto file = zip->openEntry(zip->entries()[0], problem);
    REQUIRE(file);
    std::string piece(100, '?');
    CHECK(file->read(0, std::as_writable_bytes(std::span(piece))));
    CHECK(piece == bytes.substr(0, 100));
    CHECK_FALSE(file->read(50'000, std::as_writable_bytes(std::span(piece))));
    CHECK_FALSE(ZipFile::open(folder / "missing.zip", diagnostics));
    CHECK(diagnostics.all()[0].code == "file-unreadable");
}

TEST_CASE("The same files are written as the same zip") {
    TemporaryFolder folder;
    const std::string large = noise(200'000), text(20'000, 'x');
    const auto write = [&](const char* name) {
        const std::vector<ZipContent> contents = {
            {"archive.xml", folder.file("archive.xml", text)},
            {"data/dem.dat", folder.file("other.dat", large), true},
            {"empty", folder.file("empty", ""), true},
        };
        std::string problem;
        CHECK(writeZip(folder / name, contents, {}, problem));
        CHECK(problem.empty());
        return readFile(folder / name).value_or("");
    };
    const std::string first = write("1.zip");
    fs::last_write_time(folder / "archive.xml", fs::file_time_type());
    CHECK(write("2.zip") == first);
    Diagnostics diagnostics;
    const auto zip = open(first, diagnostics);
    REQUIRE(zip);
    CHECK(zip->entries().size() == 3);
    CHECK(contentsOf(*zip) == contentsByLibzip(first));
    const ZipFile::Entry* const dem = zip->find("data/dem.dat");
    REQUIRE(dem);
    CHECK_FALSE(dem->deflated);
    CHECK(first.substr(dem->begin, dem->size) == large);
    REQUIRE(zip->find("archive.xml"));
    CHECK(zip->find("archive.xml")->deflated);
    CHECK(first.size() < large.size() + 1000);

    std::string problem;
    CHECK_FALSE(writeZip(folder / "3.zip", {{"a", folder / "missing"}}, {}, problem));
    CHECK(problem.find("missing'") != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "3.zip"));
    CHECK_FALSE(writeZip(folder / "no/3.zip", {{"a", folder / "empty"}}, {}, problem));
    CHECK_FALSE(problem.empty());
}
