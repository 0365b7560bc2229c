// SPDX-License-Identifier: BSD-3-Clause
#include "render/mesh_data.h"

#include <cassert>
#include <cstring>

namespace terrane {

namespace {

std::vector<std::byte> toBytes(const std::vector<float>& values) {
    std::vector<std::byte> bytes(values.size() * sizeof(float));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

/// Triangles over a grid of `side` x `side` vertices: each quad is split from north-west to
/// south-east.
std::vector<std::uint32_t> gridTriangles(std::uint32_t side) {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t y = 0; y + 1 < side; ++y) {
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t southWest = y * side + x, southEast = southWest + 1;
            const std::uint32_t northWest = southWest + side, northEast = northWest + 1;
            indices.insert(indices.end(),
                           {southWest, southEast, northWest, northWest, southEast, northEast});
        }
    }
    return indices;
}

std::vector<std::uint32_t> gridLines(std::uint32_t side) {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t y = 0; y + 1 < side; ++y) {
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t southWest = y * side + x, northWest = southWest + side;
            indices.insert(indices.end(), {southWest, southWest + 1, northWest + 1, northWest});
        }
    }
    return indices;
}

} // namespace

std::size_t byteSize(VertexType type) {
    switch (type) {
    case VertexType::i8:
    case VertexType::u8:
        return 1;
    case VertexType::i16:
    case VertexType::u16:
    case VertexType::f16:
        return 2;
    case VertexType::i32:
    case VertexType::u32:
    case VertexType::f32:
        return 4;
    case VertexType::f64:
        return 8;
    }
    return 0;
}

std::size_t MeshData::stride() const {
    std::size_t size = 0;
    for (const auto& attribute : attributes)
        size += attribute.size();
    return size;
}

MeshData makeQuadMesh() {
    MeshData mesh;
    mesh.mode = PrimitiveMode::triangleStrip;
    mesh.attributes = {{.location = 0, .components = 4}};
    mesh.vertices = toBytes({-1, -1, 0, 1, 1, -1, 0, 1, -1, 1, 0, 1, 1, 1, 0, 1});
    mesh.vertexCount = 4;
    mesh.boundsMin = {-1, -1, 0};
    mesh.boundsMax = {1, 1, 0};
    return mesh;
}

MeshData makeGridMesh(int n, PrimitiveMode mode) {
    assert(n >= 1 && "makeGridMesh(): at least one quad");
    assert((mode == PrimitiveMode::triangles || mode == PrimitiveMode::linesAdjacency) &&
           "makeGridMesh(): triangles or linesAdjacency");
    MeshData mesh;
    mesh.mode = mode;
    mesh.attributes = {{.location = 0, .components = 3}};
    const auto side = std::uint32_t(n) + 1;
    std::vector<float> positions;
    positions.reserve(std::size_t(side) * side * 3);
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x) {
            positions.insert(positions.end(), {float(x) / float(n), float(y) / float(n), 1.0F});
        }
    }
    mesh.vertices = toBytes(positions);
    mesh.vertexCount = std::size_t(side) * side;
    mesh.indices = mode == PrimitiveMode::triangles ? gridTriangles(side) : gridLines(side);
    mesh.boundsMin = {0, 0, 1};
    mesh.boundsMax = {1, 1, 1};
    return mesh;
}

MeshData makeSkirtedGridMesh(int n) {
    assert(n >= 1 && "makeSkirtedGridMesh(): at least one quad");
    // In edges of the grid. Rounding moves vertices by some 1/256 of a pixel, and an edge is seldom
    // wider than the picture. What lacks its tile is off by the detail of a level or two: tuned on
    // the mountains with caches of a tenth of what they need.
    constexpr float kOutwards = 1.0F / 2048, kDown = 1.0F / 32;
    MeshData mesh;
    mesh.attributes = {{.location = 0, .components = 3}};
    const auto position = [n](int i) {
        return i == 0 ? -kOutwards : i == n + 2 ? 1 + kOutwards : float(i - 1) / float(n);
    };
    const auto outside = [n](int i) { return i == 0 || i == n + 2; };
    std::vector<float> positions;
    for (int y = 0; y <= n + 2; ++y) {
        for (int x = 0; x <= n + 2; ++x) {
            const float z = outside(x) || outside(y) ? 1 - kDown : 1;
            positions.insert(positions.end(), {position(x), position(y), z});
        }
    }
    mesh.vertices = toBytes(positions);
    const auto side = std::uint32_t(n) + 3;
    mesh.vertexCount = std::size_t(side) * side;
    mesh.indices = gridTriangles(side);
    mesh.boundsMin = {-kOutwards, -kOutwards, 1 - kDown};
    mesh.boundsMax = {1 + kOutwards, 1 + kOutwards, 1};
    return mesh;
}

} // namespace terrane
