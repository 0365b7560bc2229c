// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/buffer.h"
#include "render/mesh_data.h"
#include "render/vertex_array.h"
#include "resource/resource.h"

#include <memory>
#include <optional>
#include <span>

namespace terrane {

class TransformFeedback;

/// A mesh on the GPU. Drawing takes the program, framebuffer and state that are current. Move-only;
/// GL thread only, with its context current.
///
///     Mesh quad(context, makeQuadMesh());
///     framebuffer.use();
///     program.use();
///     quad.draw();
class Mesh : public Resource {
public:
    /// A piece of the indices, or of the vertices of a mesh without indices.
    struct Range {
        int first = 0;
        int count = 0;
        int baseVertex = 0; ///< added to each index; meshes with indices only
    };

    /// 8-bit indices below 256 vertices, 16-bit below 65536, else 32-bit.
    Mesh(const GlContext& context, const MeshData& data);
    /// Vertices that something else writes, such as a TransformFeedback: as many as fit into the
    /// buffer, without indices and bounds.
    Mesh(const GlContext& context, PrimitiveMode mode, std::shared_ptr<Buffer> vertices,
         std::span<const VertexAttribute> attributes);
    Mesh(Mesh&& other) = default;
    Mesh& operator=(Mesh&& other) = default;

    PrimitiveMode mode() const { return mode_; }
    std::size_t vertexCount() const { return vertexCount_; }
    std::size_t indexCount() const { return indexCount_; }
    bool indexed() const { return indexCount_ > 0; }
    const glm::dvec3& boundsMin() const { return boundsMin_; }
    const glm::dvec3& boundsMax() const { return boundsMax_; }

    void draw(int instances = 1) const;
    void draw(const Range& range, int instances = 1) const;
    /// Several ranges in one call.
    void draw(std::span<const Range> ranges) const;
    /// Commands as OpenGL lays them out (DrawElementsIndirectCommand, or DrawArrays... without
    /// indices), tightly packed.
    void drawIndirect(const Buffer& commands, int count, std::size_t offset = 0) const;

    /// As many vertices as a feedback captured last, without asking how many that are.
    void drawFeedback(const TransformFeedback& feedback, int instances = 1) const;

    /// More attributes, one element an instance, from a buffer that the caller keeps.
    void setInstanceAttributes(const Buffer& buffer, std::span<const VertexAttribute> attributes,
                               unsigned divisor = 1);
    /// Writes vertices from `first` on, in the layout of the data that the mesh was made from.
    void writeVertices(std::size_t first, std::span<const std::byte> bytes);
    void writeIndices(std::size_t first, std::span<const std::uint32_t> indices);

    /// Strips start again at this index; none by default.
    void setRestartIndex(std::optional<std::uint32_t> index) { restartIndex_ = index; }
    /// Vertices of a patch, for `patches`; 3 by default.
    void setPatchSize(int vertices) { patchSize_ = vertices; }

private:
    std::vector<std::byte> packIndices(std::span<const std::uint32_t> indices) const;
    const void* indexPointer(int first) const;
    /// Binds and sets what the draw calls need, runs one, and puts back what others don't expect.
    template <class Call>
    void drawWith(Call call) const;

    const GlContext* context_;
    PrimitiveMode mode_;
    std::size_t stride_;
    std::size_t vertexCount_;
    std::size_t indexCount_;
    std::size_t indexSize_; ///< in bytes
    glm::dvec3 boundsMin_, boundsMax_;
    std::optional<std::uint32_t> restartIndex_;
    int patchSize_ = 3;
    std::shared_ptr<Buffer> vertices_;
    std::optional<Buffer> indices_;
    VertexArray array_;
};

} // namespace terrane
