// SPDX-License-Identifier: BSD-3-Clause
#include "render/mesh.h"

#include "render/transform_feedback.h"

#include <glad/gl.h>

#include <cassert>
#include <cstring>
#include <utility>

namespace terrane {

namespace {

unsigned indexType(std::size_t size) {
    return size == 1 ? GL_UNSIGNED_BYTE : size == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;
}

} // namespace

Mesh::Mesh(const GlContext& context, const MeshData& data)
    : context_(&context)
    , mode_(data.mode)
    , stride_(data.stride())
    , vertexCount_(data.vertexCount)
    , indexCount_(data.indices.size())
    , indexSize_(data.vertexCount < 256     ? 1
                 : data.vertexCount < 65536 ? 2
                                            : 4)
    , boundsMin_(data.boundsMin)
    , boundsMax_(data.boundsMax)
    , vertices_(std::make_shared<Buffer>(context, data.vertices))
    , array_(context) {
    assert(data.vertices.size() == vertexCount_ * stride_ && "Mesh: vertices of another size");
    array_.setAttributes(0, *vertices_, data.attributes);
    if (indexCount_ > 0) {
        indices_.emplace(context, packIndices(data.indices));
        array_.setIndices(*indices_);
    }
}

Mesh::Mesh(const GlContext& context, PrimitiveMode mode, std::shared_ptr<Buffer> vertices,
           std::span<const VertexAttribute> attributes)
    : context_(&context)
    , mode_(mode)
    , stride_(0)
    , vertexCount_(0)
    , indexCount_(0)
    , indexSize_(4)
    , boundsMin_(0)
    , boundsMax_(0)
    , vertices_(std::move(vertices))
    , array_(context) {
    for (const VertexAttribute& attribute : attributes)
        stride_ += attribute.size();
    assert(stride_ > 0 && "Mesh: vertices without attributes");
    vertexCount_ = vertices_->size() / stride_;
    array_.setAttributes(0, *vertices_, attributes);
}

std::vector<std::byte> Mesh::packIndices(std::span<const std::uint32_t> indices) const {
    std::vector<std::byte> bytes(indices.size() * indexSize_);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const auto small = std::uint16_t(indices[i]);
        const auto tiny = std::uint8_t(indices[i]);
        const void* from = indexSize_ == 1   ? static_cast<const void*>(&tiny)
                           : indexSize_ == 2 ? static_cast<const void*>(&small)
                                             : static_cast<const void*>(&indices[i]);
        std::memcpy(&bytes[i * indexSize_], from, indexSize_);
    }
    return bytes;
}

const void* Mesh::indexPointer(int first) const {
    return reinterpret_cast<const void*>(std::size_t(first) * indexSize_);
}

template <class Call>
void Mesh::drawWith(Call call) const {
    const auto& gl = context_->gl();
    array_.bind();
    if (mode_ == PrimitiveMode::patches) gl.PatchParameteri(GL_PATCH_VERTICES, patchSize_);
    if (restartIndex_) {
        gl.PrimitiveRestartIndex(*restartIndex_);
        gl.Enable(GL_PRIMITIVE_RESTART);
    }
    call(gl);
    if (restartIndex_) gl.Disable(GL_PRIMITIVE_RESTART);
}

void Mesh::draw(int instances) const {
    draw(Range{.count = int(indexed() ? indexCount_ : vertexCount_)}, instances);
}

void Mesh::draw(const Range& range, int instances) const {
    if (range.count <= 0 || instances <= 0) return;
    assert(range.first >= 0 &&
           std::size_t(range.first) + std::size_t(range.count) <=
               (indexed() ? indexCount_ : vertexCount_) &&
           "Mesh::draw(): the range leaves the mesh");
    drawWith([&](const GladGLContext& gl) {
        if (indexed()) {
            gl.DrawElementsInstancedBaseVertex(unsigned(mode_), range.count, indexType(indexSize_),
                                               indexPointer(range.first), instances,
                                               range.baseVertex);
        } else {
            gl.DrawArraysInstanced(unsigned(mode_), range.first, range.count, instances);
        }
    });
}

void Mesh::draw(std::span<const Range> ranges) const {
    if (ranges.empty()) return;
    std::vector<GLint> firsts, bases;
    std::vector<GLsizei> counts;
    std::vector<const void*> pointers;
    for (const Range& range : ranges) {
        firsts.push_back(range.first);
        counts.push_back(range.count);
        bases.push_back(range.baseVertex);
        pointers.push_back(indexPointer(range.first));
    }
    const auto count = GLsizei(ranges.size());
    drawWith([&](const GladGLContext& gl) {
        if (indexed()) {
            gl.MultiDrawElementsBaseVertex(unsigned(mode_), counts.data(), indexType(indexSize_),
                                           pointers.data(), count, bases.data());
        } else {
            gl.MultiDrawArrays(unsigned(mode_), firsts.data(), counts.data(), count);
        }
    });
}

void Mesh::drawIndirect(const Buffer& commands, int count, std::size_t offset) const {
    if (count <= 0) return;
    drawWith([&](const GladGLContext& gl) {
        gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.name());
        const auto* start = reinterpret_cast<const void*>(offset);
        if (indexed()) {
            gl.MultiDrawElementsIndirect(unsigned(mode_), indexType(indexSize_), start, count, 0);
        } else {
            gl.MultiDrawArraysIndirect(unsigned(mode_), start, count, 0);
        }
        gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    });
}

void Mesh::drawFeedback(const TransformFeedback& feedback, int instances) const {
    drawWith([&](const GladGLContext& gl) {
        gl.DrawTransformFeedbackInstanced(unsigned(mode_), feedback.name(), instances);
    });
}

void Mesh::setInstanceAttributes(const Buffer& buffer, std::span<const VertexAttribute> attributes,
                                 unsigned divisor) {
    array_.setAttributes(1, buffer, attributes, divisor);
}

void Mesh::writeVertices(std::size_t first, std::span<const std::byte> bytes) {
    vertices_->write(first * stride_, bytes);
}

void Mesh::writeIndices(std::size_t first, std::span<const std::uint32_t> indices) {
    assert(indices_ && "Mesh::writeIndices(): the mesh has no indices");
    indices_->write(first * indexSize_, packIndices(indices));
}

} // namespace terrane
