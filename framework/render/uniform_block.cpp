// SPDX-License-Identifier: BSD-3-Clause
#include "render/uniform_block.h"

#include "render/state_tracker.h"

#include <glad/gl.h>

#include <algorithm>
#include <cassert>
#include <cstring>

namespace terrane {

UniformBlock::UniformBlock(const GlContext& context, std::size_t size)
    : context_(context)
    , bytes_(size)
    , serial_(context.nextSerial()) {
    const auto& gl = context.gl();
    gl.CreateBuffers(1, &buffer_);
    gl.NamedBufferStorage(buffer_, static_cast<GLsizeiptr>(size), bytes_.data(),
                          GL_DYNAMIC_STORAGE_BIT);
    context.countObject(1);
}

UniformBlock::~UniformBlock() {
    context_.state().forgetBuffer(buffer_);
    context_.gl().DeleteBuffers(1, &buffer_);
    context_.countObject(-1);
}

void UniformBlock::write(std::size_t offset, const std::byte* data, std::size_t size) {
    assert(offset + size <= bytes_.size() && "UniformBlock::write(): outside the block");
    if (std::memcmp(bytes_.data() + offset, data, size) == 0) return;
    std::memcpy(bytes_.data() + offset, data, size);
    const bool clean = dirtyBegin_ == dirtyEnd_;
    dirtyBegin_ = clean ? offset : std::min(dirtyBegin_, offset);
    dirtyEnd_ = clean ? offset + size : std::max(dirtyEnd_, offset + size);
}

void UniformBlock::flush() {
    if (dirtyBegin_ == dirtyEnd_) return;
    context_.gl().NamedBufferSubData(buffer_, static_cast<GLintptr>(dirtyBegin_),
                                     static_cast<GLsizeiptr>(dirtyEnd_ - dirtyBegin_),
                                     bytes_.data() + dirtyBegin_);
    dirtyBegin_ = dirtyEnd_ = 0;
    ++uploads_;
}

UniformBlockPool::Acquired UniformBlockPool::acquire(const std::string& name, std::size_t size,
                                                     int members) {
    std::weak_ptr<UniformBlock>& known = blocks_[Key{name, size, members}];
    if (auto block = known.lock()) return {std::move(block), false};
    auto block = std::make_shared<UniformBlock>(context_, size);
    known = block;
    return {std::move(block), true};
}

} // namespace terrane
