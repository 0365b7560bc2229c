// SPDX-License-Identifier: BSD-3-Clause
#include "render/buffer.h"

#include "render/state_tracker.h"

#include <glad/gl.h>

#include <cassert>
#include <utility>

namespace terrane {

Buffer::Buffer(const GlContext& context)
    : context_(&context) {
    assert(context.isCurrent() && "Buffer: its context is not current");
    context.gl().CreateBuffers(1, &name_);
    context.countObject(1);
}

Buffer::Buffer(const GlContext& context, std::span<const std::byte> bytes, BufferUsage usage)
    : Buffer(context) {
    assign(bytes, usage);
}

Buffer::~Buffer() {
    if (!name_) return;
    assert(context_->isCurrent() && "Buffer: its context is not current");
    context_->state().forgetBuffer(name_);
    context_->gl().DeleteBuffers(1, &name_);
    context_->countObject(-1);
}

Buffer::Buffer(Buffer&& other) noexcept
    : context_(other.context_)
    , name_(std::exchange(other.name_, 0))
    , size_(std::exchange(other.size_, 0)) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(context_, other.context_);
    std::swap(name_, other.name_);
    std::swap(size_, other.size_);
    return *this;
}

void Buffer::assign(std::span<const std::byte> bytes, BufferUsage usage) {
    context_->gl().NamedBufferData(name_, GLsizeiptr(bytes.size()), bytes.data(), unsigned(usage));
    size_ = bytes.size();
}

void Buffer::allocate(std::size_t size, BufferUsage usage) {
    context_->gl().NamedBufferData(name_, GLsizeiptr(size), nullptr, unsigned(usage));
    size_ = size;
}

void Buffer::write(std::size_t offset, std::span<const std::byte> bytes) {
    assert(offset + bytes.size() <= size_ && "Buffer::write(): out of range");
    context_->gl().NamedBufferSubData(name_, GLintptr(offset), GLsizeiptr(bytes.size()),
                                      bytes.data());
}

void Buffer::read(std::size_t offset, std::span<std::byte> bytes) const {
    assert(offset + bytes.size() <= size_ && "Buffer::read(): out of range");
    context_->gl().GetNamedBufferSubData(name_, GLintptr(offset), GLsizeiptr(bytes.size()),
                                         bytes.data());
}

} // namespace terrane
