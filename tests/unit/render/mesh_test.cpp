// SPDX-License-Identifier: BSD-3-Clause
#include "gl_fixture.h"
#include "gl_program.h"
#include "render/mesh.h"
#include "render/render_target.h"

#include <array>
#include <cstring>

namespace terrane {

namespace {

std::span<const std::byte> asBytes(const std::vector<float>& values) {
    return std::as_bytes(std::span(values));
}

/// One point in the middle of each of n pixels of an n x 1 picture.
MeshData pointsMesh(int n) {
    MeshData mesh;
    mesh.mode = PrimitiveMode::points;
    mesh.attributes = {{.location = 0, .components = 2}};
    mesh.vertexCount = std::size_t(n);
    mesh.vertices.resize(std::size_t(n) * 8);
    for (int i = 0; i < n; ++i) {
        const float position[2] = {(float(2 * i) + 1) / float(n) - 1, 0};
        std::memcpy(&mesh.vertices[std::size_t(i) * 8], position, 8);
    }
    return mesh;
}

struct DrawFixture : GlFixture {
    static constexpr int kWidth = 8;
    std::unique_ptr<RenderTarget> target;
    std::unique_ptr<GlProgram> program;

    DrawFixture() {
        target = std::make_unique<RenderTarget>(*context, kWidth, 1);
        // Each instance moves two pixels to the right.
        program = std::make_unique<GlProgram>(
            *context,
            std::initializer_list<std::pair<unsigned, const char*>>{
                {GL_VERTEX_SHADER, "layout(location=0) in vec2 p;"
                                   "void main() { gl_Position = vec4(p.x + 0.5 * gl_InstanceID,"
                                   " p.y, 0, 1); }"},
                {GL_FRAGMENT_SHADER, kColourFragment}});
        program->set("colour", 1, 1, 1, 1);
        program->use();
        begin();
    }
    ~DrawFixture() {
        target.reset();
        program.reset();
    }
    void begin() {
        target->framebuffer().clear(Planes::all);
        target->framebuffer().use();
    }
    /// The picture as `#` for drawn and `.` for empty pixels.
    std::string picture() {
        const Image image = target->capture();
        std::string text;
        for (int x = 0; x < kWidth; ++x)
            text += image.value(x, 0, 0) > 0.5F ? '#' : '.';
        begin();
        return text;
    }
};

} // namespace

TEST_CASE_FIXTURE(DrawFixture, "A mesh without indices is drawn whole, in part and in ranges") {
    const Mesh mesh(*context, pointsMesh(8));
    CHECK_FALSE(mesh.indexed());
    mesh.draw();
    CHECK(picture() == "########");
    mesh.draw(Mesh::Range{2, 3});
    CHECK(picture() == "..###...");
    mesh.draw(Mesh::Range{0, 1}, 3);
    CHECK(picture() == "#.#.#...");
    const Mesh::Range ranges[] = {{0, 1}, {3, 2}, {7, 1}};
    mesh.draw(ranges);
    CHECK(picture() == "#..##..#");
    mesh.draw(0);
    CHECK(picture() == "........");
}

TEST_CASE_FIXTURE(DrawFixture, "A mesh with indices is drawn whole, in part, with a base") {
    MeshData data = pointsMesh(8);
    data.indices = {1, 3, 5};
    Mesh mesh(*context, data);
    mesh.draw();
    CHECK(picture() == ".#.#.#..");
    mesh.draw(Mesh::Range{1, 2});
    CHECK(picture() == "...#.#..");
    mesh.draw(Mesh::Range{1, 1, 3});
    CHECK(picture() == "......#.");
    mesh.draw(Mesh::Range{0, 1}, 2);
    CHECK(picture() == ".#.#....");
    mesh.draw(Mesh::Range{0, 1, 3}, 2);
    CHECK(picture() == "....#.#.");
    const Mesh::Range ranges[] = {{0, 1, 0}, {2, 1, 2}};
    mesh.draw(ranges);
    CHECK(picture() == ".#.....#");
    const std::uint32_t changed[] = {6};
    mesh.writeIndices(1, changed);
    mesh.draw();
    CHECK(picture() == ".#...##.");
}

TEST_CASE_FIXTURE(DrawFixture, "Draw commands can come from a buffer") {
    const std::uint32_t arrays[] = {2, 1, 4, 0, 1, 2, 0, 0}; // count, instances, first, base
    const Buffer commands(*context, std::as_bytes(std::span(arrays)));
    const Mesh mesh(*context, pointsMesh(8));
    mesh.drawIndirect(commands, 2);
    CHECK(picture() == "#.#.##..");

    MeshData data = pointsMesh(8);
    data.indices = {1, 3, 5};
    const Mesh indexed(*context, data);
    // count, instances, first, base vertex, base instance
    const std::uint32_t elements[] = {1, 1, 2, 2, 0, 1, 2, 0, 1, 0};
    const Buffer elementCommands(*context, std::as_bytes(std::span(elements)));
    indexed.drawIndirect(elementCommands, 1);
    CHECK(picture() == ".......#");
    indexed.drawIndirect(elementCommands, 2); // the second one twice
    CHECK(picture() == "..#.#..#");
}

TEST_CASE_FIXTURE(DrawFixture, "Indices of 8, 16 and 32 bits reach the last vertex") {
    for (const std::size_t count : {255U, 256U, 65535U, 65536U, 70000U}) {
        CAPTURE(count);
        MeshData data = pointsMesh(8);
        // The last of many vertices stands in the middle of pixel 5.
        std::vector<std::byte> last(data.vertices.begin() + 40, data.vertices.begin() + 48);
        data.vertices.resize((count - 1) * 8);
        data.vertices.insert(data.vertices.end(), last.begin(), last.end());
        data.vertexCount = count;
        data.indices = {std::uint32_t(count - 1)};
        const Mesh mesh(*context, data);
        mesh.draw();
        CHECK(picture() == ".....#..");
    }
}

TEST_CASE_FIXTURE(DrawFixture, "Vertices can be written after the mesh was made") {
    Mesh mesh(*context, pointsMesh(8));
    const std::vector<float> outside{5, 5, 5, 5};
    mesh.writeVertices(2, asBytes(outside));
    mesh.draw();
    CHECK(picture() == "##..####");
}

TEST_CASE_FIXTURE(DrawFixture, "A restart index splits strips") {
    MeshData data = pointsMesh(8);
    data.mode = PrimitiveMode::lineStrip;
    data.indices = {0, 2, 255, 4, 6};
    Mesh mesh(*context, data);
    mesh.setRestartIndex(255);
    mesh.draw();
    CHECK(picture() == "##..##..");
}

TEST_CASE_FIXTURE(GlFixture, "Attributes of instances come from another buffer") {
    RenderTarget target(*context, 8, 1);
    const GlProgram program(*context,
                            {{GL_VERTEX_SHADER, "layout(location=0) in vec2 p;"
                                                "layout(location=1) in float offset;"
                                                "void main() { gl_Position = vec4(p.x + offset, 0,"
                                                " 0, 1); }"},
                             {GL_FRAGMENT_SHADER, kColourFragment}});
    program.set("colour", 1, 1, 1, 1);
    program.use();
    MeshData data = pointsMesh(8);
    Mesh mesh(*context, data);
    const std::vector<float> offsets{0.25F, 1.25F};
    const Buffer buffer(*context, asBytes(offsets));
    const VertexAttribute attribute{.location = 1, .components = 1};
    mesh.setInstanceAttributes(buffer, {&attribute, 1});
    target.framebuffer().clear(Planes::all);
    mesh.draw(Mesh::Range{0, 1}, 2);
    const Image image = target.capture();
    CHECK(image.value(0, 0, 0) == 0);
    CHECK(image.value(1, 0, 0) == 1);
    CHECK(image.value(5, 0, 0) == 1);
}

TEST_CASE_FIXTURE(GlFixture, "The quad covers the picture") {
    RenderTarget target(*context, 5, 3);
    const GlProgram program(
        *context, {{GL_VERTEX_SHADER, kPlainVertex}, {GL_FRAGMENT_SHADER, kColourFragment}});
    program.set("colour", 0, 1, 0, 1);
    program.use();
    const Mesh quad(*context, makeQuadMesh());
    target.framebuffer().clear(Planes::all);
    target.framebuffer().use();
    quad.draw();
    const Image image = target.capture();
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 5; ++x)
            CHECK(image.value(x, y, 1) == 1);
    }
}

TEST_CASE("Grid meshes have the documented vertices and triangles") {
    const MeshData grid = makeGridMesh(24);
    CHECK(grid.vertexCount == 625);
    CHECK(grid.indices.size() == 24 * 24 * 6);
    const std::vector<std::uint32_t> first(grid.indices.begin(), grid.indices.begin() + 6);
    CHECK(first == std::vector<std::uint32_t>{0, 1, 25, 25, 1, 26});
    float corner[3];
    std::memcpy(corner, &grid.vertices[24 * 12], 12);
    CHECK(corner[0] == 1);
    CHECK(corner[1] == 0);
    CHECK(corner[2] == 1);

    const MeshData lines = makeGridMesh(24, PrimitiveMode::linesAdjacency);
    CHECK(lines.indices.size() == 24 * 24 * 4);
    const std::vector<std::uint32_t> corners(lines.indices.begin(), lines.indices.begin() + 4);
    CHECK(corners == std::vector<std::uint32_t>{0, 1, 26, 25});
}

TEST_CASE("A skirted grid is a grid with one more ring, outside and below") {
    const int n = 4, side = n + 3;
    const MeshData mesh = makeSkirtedGridMesh(n);
    const MeshData grid = makeGridMesh(n);
    REQUIRE(mesh.vertexCount == side * side);
    CHECK(mesh.indices == makeGridMesh(n + 2).indices);
    const auto vertex = [](const MeshData& data, int index) {
        std::array<float, 3> v{};
        std::memcpy(v.data(), &data.vertices[std::size_t(index) * 12], 12);
        return v;
    };
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            CAPTURE(x);
            CAPTURE(y);
            const auto v = vertex(mesh, y * side + x);
            const bool skirt = x == 0 || y == 0 || x == side - 1 || y == side - 1;
            if (skirt) {
                CHECK(v[2] < 1);
                CHECK((v[0] < 0 || v[0] > 1 || v[1] < 0 || v[1] > 1));
            } else {
                CHECK(v == vertex(grid, (y - 1) * (n + 1) + x - 1));
            }
            for (int i = 0; i < 3; ++i) {
                CHECK(v[i] >= static_cast<float>(mesh.boundsMin[i]));
                CHECK(v[i] <= static_cast<float>(mesh.boundsMax[i]));
            }
        }
    }
}

} // namespace terrane
