// SPDX-License-Identifier: BSD-3-Clause
#include "render/vertex_array.h"

#include "render/state_tracker.h"

#include <glad/gl.h>

#include <cassert>
#include <utility>

namespace terrane {

static_assert(unsigned(PrimitiveMode::triangleStripAdjacency) == GL_TRIANGLE_STRIP_ADJACENCY);
static_assert(unsigned(PrimitiveMode::patches) == GL_PATCHES);
static_assert(unsigned(VertexType::f16) == GL_HALF_FLOAT);

VertexArray::VertexArray(const GlContext& context)
    : context_(&context) {
    assert(context.isCurrent() && "VertexArray: its context is not current");
    context.gl().CreateVertexArrays(1, &name_);
    context.countObject(1);
}

VertexArray::~VertexArray() {
    if (!name_) return;
    assert(context_->isCurrent() && "VertexArray: its context is not current");
    context_->state().forgetVertexArray(name_);
    context_->gl().DeleteVertexArrays(1, &name_);
    context_->countObject(-1);
}

VertexArray::VertexArray(VertexArray&& other) noexcept
    : context_(other.context_)
    , name_(std::exchange(other.name_, 0)) {}

VertexArray& VertexArray::operator=(VertexArray&& other) noexcept {
    std::swap(context_, other.context_);
    std::swap(name_, other.name_);
    return *this;
}

void VertexArray::setAttributes(unsigned slot, const Buffer& buffer,
                                std::span<const VertexAttribute> attributes, unsigned divisor) {
    const auto& gl = context_->gl();
    std::size_t offset = 0;
    for (const auto& attribute : attributes) {
        const auto location = GLuint(attribute.location);
        gl.EnableVertexArrayAttrib(name_, location);
        gl.VertexArrayAttribFormat(name_, location, attribute.components, unsigned(attribute.type),
                                   attribute.normalized, GLuint(offset));
        gl.VertexArrayAttribBinding(name_, location, slot);
        offset += attribute.size();
    }
    gl.VertexArrayVertexBuffer(name_, slot, buffer.name(), 0, GLsizei(offset));
    gl.VertexArrayBindingDivisor(name_, slot, divisor);
}

void VertexArray::setIndices(const Buffer& buffer) {
    context_->gl().VertexArrayElementBuffer(name_, buffer.name());
}

void VertexArray::bind() const {
    context_->state().bindVertexArray(name_);
}

} // namespace terrane
