// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace terrane {

// The values of the enumerations are OpenGL's own.

enum class PrimitiveMode : unsigned {
    points = 0,
    lines,
    lineLoop,
    lineStrip,
    triangles,
    triangleStrip,
    triangleFan,
    linesAdjacency = 0xA,
    lineStripAdjacency,
    trianglesAdjacency,
    triangleStripAdjacency,
    patches
};

enum class VertexType : unsigned { i8 = 0x1400, u8, i16, u16, i32, u32, f32, f64 = 0x140A, f16 };

std::size_t byteSize(VertexType type);

/// One attribute of the vertices of a mesh. Shaders read floats, whatever the type.
struct VertexAttribute {
    int location = 0;
    int components = 4; ///< 1 to 4
    VertexType type = VertexType::f32;
    bool normalized = false; ///< integers stand for 0 to 1, or -1 to 1

    std::size_t size() const { return std::size_t(components) * byteSize(type); }
    bool operator==(const VertexAttribute&) const = default;
};

/// A mesh in memory: vertices that hold their attributes one after the other, tightly packed.
struct MeshData {
    PrimitiveMode mode = PrimitiveMode::triangles;
    std::vector<VertexAttribute> attributes;
    std::vector<std::byte> vertices; ///< vertexCount times stride() bytes
    std::size_t vertexCount = 0;
    std::vector<std::uint32_t> indices; ///< empty: vertices are drawn in order
    glm::dvec3 boundsMin{0}, boundsMax{0};

    std::size_t stride() const;
};

/// The full-screen strip (-1,-1), (1,-1), (-1,1), (1,1): a vec4 (x, y, 0, 1) at location 0.
MeshData makeQuadMesh();

/// A grid of n x n quads over [0,1] x [0,1], row by row from the south-west; a vec3 at location 0
/// with z = 1 (terrain reference 1.6). As `triangles`, each quad is split from north-west to
/// south-east, counter-clockwise; as `linesAdjacency` it is its four corners counter-clockwise from
/// the south-west, for a geometry shader. No other mode is allowed.
MeshData makeGridMesh(int n, PrimitiveMode mode = PrimitiveMode::triangles);

/// The same triangles with a skirt that hangs from the edges, a little outwards: one more ring of
/// vertices outside of [0,1] x [0,1], with z less than 1. A shader that places vertices at
///     surface at clamp(xy, 0, 1) + (xy - clamp(xy, 0, 1), z - 1) * edge of the grid
/// leaves no gap between neighbours, not even where rounding moves what should be one edge.
MeshData makeSkirtedGridMesh(int n);

} // namespace terrane
