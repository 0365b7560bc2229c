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
    for (std::uint32_t y = 0; y + 1 < side; ++y) {
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t southWest = y * side + x, southEast = southWest + 1;
            const std::uint32_t northWest = southWest + side, northEast = northWest + 1;
            if (mode == PrimitiveMode::triangles) {
                mesh.indices.insert(mesh.indices.end(), {southWest, southEast, northWest, northWest,
                                                         southEast, northEast});
            } else {
                mesh.indices.insert(mesh.indices.end(),
                                    {southWest, southEast, northEast, northWest});
            }
        }
    }
    mesh.boundsMin = {0, 0, 1};
    mesh.boundsMax = {1, 1, 1};
    return mesh;
}

} // namespace terrane
