// SPDX-License-Identifier: BSD-3-Clause
#include "render/mesh_file.h"

#include <doctest/doctest.h>

#include <cstring>
#include <random>
#include <string>

namespace terrane {

namespace {

std::optional<MeshData> parse(const std::string& text, Diagnostics& diagnostics) {
    return parseMesh(std::make_shared<SourceFile>("a.mesh", text), diagnostics);
}

float floatAt(const MeshData& mesh, std::size_t index) {
    float value = 0;
    std::memcpy(&value, &mesh.vertices.at(index * 4 + 3) - 3, 4);
    return value;
}

const std::string kTriangle = "-1 +1 -1 +1 0 0\n"
                              "triangles\n"
                              "1\n"
                              "0 2 float false\n"
                              "3\n"
                              "-1 -1\n"
                              "+1 -1\n"
                              "-1 +1e0\n"
                              "3\n"
                              "0 1 2\n";

} // namespace

TEST_CASE("A mesh file gives bounds, topology, attributes, vertices and indices") {
    Diagnostics diagnostics;
    const auto mesh = parse(kTriangle, diagnostics);
    REQUIRE(mesh);
    CHECK(mesh->boundsMin == glm::dvec3(-1, -1, 0));
    CHECK(mesh->boundsMax == glm::dvec3(1, 1, 0));
    CHECK(mesh->mode == PrimitiveMode::triangles);
    CHECK(mesh->attributes == std::vector<VertexAttribute>{{0, 2, VertexType::f32, false}});
    CHECK(mesh->vertexCount == 3);
    CHECK(mesh->stride() == 8);
    CHECK(floatAt(*mesh, 2) == 1);
    CHECK(floatAt(*mesh, 5) == 1);
    CHECK(mesh->indices == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(diagnostics.all().empty());
}

TEST_CASE("A mesh file may go on with remarks, and be written on one line") {
    struct Row {
        const char* name;
        std::string text;
    };
    std::string oneLine = kTriangle;
    for (char& c : oneLine) {
        if (c == '\n') c = '\t';
    }
    const std::vector<Row> rows{
        {"remark", kTriangle + "// attributes: 0 = position"},
        {"rubbish", kTriangle + "\n\n%%%% 1 2 3"},
        {"one line", oneLine},
        {"no line break at the end", kTriangle.substr(0, kTriangle.size() - 1)},
        {"carriage returns", "0 1 0 1 0 1\r\npoints\r\n1\r\n0 1 float false\r\n1\r\n5\r\n0\r\n"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        Diagnostics diagnostics;
        CHECK(parse(row.text, diagnostics));
        CHECK(diagnostics.all().empty());
    }
}

TEST_CASE("Attributes of all types are packed without padding") {
    Diagnostics diagnostics;
    const auto mesh = parse("0 0 0 0 0 0 points 8\n"
                            "0 1 byte true 1 1 ubyte false 2 1 short false 3 1 ushort false\n"
                            "4 1 int false 5 1 uint false 6 1 float false 7 1 double false\n"
                            "1\n-1 255 -2 65535 -3 4294967295 0.5 0.25\n0",
                            diagnostics);
    REQUIRE(mesh);
    CHECK(mesh->stride() == 1 + 1 + 2 + 2 + 4 + 4 + 4 + 8);
    const auto* bytes = reinterpret_cast<const unsigned char*>(mesh->vertices.data());
    CHECK(bytes[0] == 0xFF);
    CHECK(bytes[1] == 0xFF);
    CHECK(bytes[2] == 0xFE);
    CHECK(bytes[6] == 0xFD);
    CHECK(bytes[10] == 0xFF);
    double last = 0;
    std::memcpy(&last, bytes + 18, 8);
    CHECK(last == 0.25);
    CHECK(mesh->attributes[0].normalized);
    CHECK(mesh->indices.empty());
}

TEST_CASE("Each topology has its word") {
    const std::vector<std::pair<const char*, PrimitiveMode>> rows{
        {"points", PrimitiveMode::points},
        {"lines", PrimitiveMode::lines},
        {"linesadjacency", PrimitiveMode::linesAdjacency},
        {"linestrip", PrimitiveMode::lineStrip},
        {"linestripadjacency", PrimitiveMode::lineStripAdjacency},
        {"triangles", PrimitiveMode::triangles},
        {"trianglesadjacency", PrimitiveMode::trianglesAdjacency},
        {"trianglestrip", PrimitiveMode::triangleStrip},
        {"trianglestripadjacency", PrimitiveMode::triangleStripAdjacency},
        {"trianglefan", PrimitiveMode::triangleFan},
    };
    for (const auto& [word, mode] : rows) {
        CAPTURE(word);
        Diagnostics diagnostics;
        const auto mesh =
            parse(std::string("0 0 0 0 0 0 ") + word + " 1 0 1 float false 1 0 0", diagnostics);
        REQUIRE(mesh);
        CHECK(mesh->mode == mode);
    }
}

TEST_CASE("What is wrong in a mesh file is told with its place") {
    struct Row {
        const char* name;
        std::string text;
        LineColumn place;
        const char* message;
    };
    const std::string head = "0 0 0 0 0 0\ntriangles\n1\n0 1 float false\n";
    const std::vector<Row> rows{
        {"empty", "", {1, 1}, "ends too early"},
        {"bad bound", "0 0 x 0 0 0", {1, 5}, "bad number 'x'"},
        {"infinite bound", "0 0 inf 0 0 0", {1, 5}, "bad number 'inf'"},
        {"half a number", "0 0 1.5.2 0 0 0", {1, 5}, "bad number '1.5.2'"},
        {"topology", "0 0 0 0 0 0\ntriangle", {2, 1}, "unknown topology 'triangle'"},
        {"many attributes", "0 0 0 0 0 0 points 17", {1, 20}, "out of range"},
        {"negative attributes", "0 0 0 0 0 0 points -1", {1, 20}, "out of range"},
        {"old word for a location", "0 0 0 0 0 0 points 1 pos 3 float false", {1, 22}, "'pos'"},
        {"five components", "0 0 0 0 0 0 points 1 0 5 float false", {1, 24}, "out of range"},
        {"type", "0 0 0 0 0 0 points 1 0 3 half false", {1, 26}, "unknown type 'half'"},
        {"norm", "0 0 0 0 0 0 points 1 0 3 float no", {1, 32}, "unknown normalization 'no'"},
        {"same location",
         "0 0 0 0 0 0 points 2 0 1 float true 0 1 float true",
         {1, 37},
         "two attributes"},
        {"no vertices", head, {5, 1}, "ends too early"},
        {"lying vertex count", head + "2000000000 1 2 3", {5, 1}, "too short for 2000000000"},
        {"vertex count past 31 bits", head + "99999999999", {5, 1}, "out of range"},
        {"vertex count past 64 bits", head + "99999999999999999999", {5, 1}, "bad number"},
        {"truncated vertices", head + "3\n1.000 2.000", {6, 12}, "ends too early"},
        {"bad vertex", head + "1\nnan\n0", {6, 1}, "bad number 'nan'"},
        {"huge vertex", head + "1\n1e300\n0", {6, 1}, "out of range"},
        {"real for an integer",
         "0 0 0 0 0 0 points 1 0 1 int false 1\n1.5 0",
         {2, 1},
         "bad number '1.5'"},
        {"no index count", head + "1\n1", {6, 2}, "ends too early"},
        {"lying index count", head + "1\n1\n1000000", {7, 1}, "too short for 1000000"},
        {"index without a vertex", head + "2\n1 2\n3\n0 1 2", {8, 5}, "out of range"},
        {"negative index", head + "2\n1 2\n3\n0 1 -1", {8, 5}, "out of range"},
        {"index of nothing", "0 0 0 0 0 0 points 0 0 1 0", {1, 26}, "out of range"},
        {"binary", std::string("\0\1\2\3", 4), {1, 1}, "bad number"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.name);
        Diagnostics diagnostics;
        CHECK_FALSE(parse(row.text, diagnostics));
        REQUIRE(diagnostics.all().size() == 1);
        const auto diagnostic = diagnostics.all()[0];
        CHECK(diagnostic.code == "mesh-syntax");
        CHECK(diagnostic.message.find(row.message) != std::string::npos);
        CAPTURE(diagnostic.message);
        CHECK(diagnostic.place.position().line == row.place.line);
        CHECK(diagnostic.place.position().column == row.place.column);
    }
}

TEST_CASE("Vertices without attributes are bounded by number") {
    Diagnostics diagnostics;
    const auto parse = [&](const std::string& text) {
        return parseMesh(std::make_shared<SourceFile>("m.mesh", text), diagnostics);
    };
    const auto mesh = parse("0 1 0 1 0 1 points 0 1048576 0");
    REQUIRE(mesh);
    CHECK(mesh->vertexCount == 1048576);
    CHECK_FALSE(parse("0 1 0 1 0 1 points 0 2147483647 0"));
    REQUIRE(diagnostics.all().size() == 1);
    CHECK(diagnostics.all()[0].place.position().column == 22);
}

TEST_CASE("A misspelt word in a mesh file gets a suggestion") {
    Diagnostics diagnostics;
    CHECK_FALSE(parse("0 0 0 0 0 0 trianglstrip", diagnostics));
    CHECK(diagnostics.all().at(0).suggestion == "trianglestrip");
}

TEST_CASE("A mesh file cut off anywhere is refused, or is whole") {
    const std::size_t lastIndex = kTriangle.rfind('2');
    for (std::size_t length = 0; length < kTriangle.size(); ++length) {
        CAPTURE(length);
        Diagnostics diagnostics;
        const auto mesh = parse(kTriangle.substr(0, length), diagnostics);
        CHECK(mesh.has_value() == (length > lastIndex));
        CHECK(diagnostics.errors() == (length > lastIndex ? 0 : 1));
    }
}

TEST_CASE("Damaged mesh files are refused or read, never trusted") {
    std::mt19937 random(1);
    const std::string alphabet = "0123456789+-.eE \n\t\0xinfatrue";
    for (int run = 0; run < 20000; ++run) {
        std::string text = kTriangle;
        for (int edits = 1 + int(random() % 4); edits > 0; --edits) {
            const std::size_t at = random() % text.size();
            switch (random() % 3) {
            case 0:
                text[at] = alphabet[random() % alphabet.size()];
                break;
            case 1:
                text.insert(at, 1, alphabet[random() % alphabet.size()]);
                break;
            default:
                text.erase(at, 1 + random() % 5);
                break;
            }
            if (text.empty()) text = " ";
        }
        Diagnostics diagnostics;
        const auto mesh = parse(text, diagnostics);
        CAPTURE(text);
        REQUIRE(mesh.has_value() == (diagnostics.errors() == 0));
        if (!mesh) continue;
        REQUIRE(mesh->vertices.size() == mesh->vertexCount * mesh->stride());
        for (const auto index : mesh->indices)
            REQUIRE(index < mesh->vertexCount);
    }
}

} // namespace terrane
