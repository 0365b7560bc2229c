// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/context.h"

#include <cstddef>
#include <span>

namespace terrane {

/// How often a buffer's contents change; a hint for where the driver keeps it.
enum class BufferUsage : unsigned {
    fixed = 0x88E4,   ///< written once
    dynamic = 0x88E8, ///< written now and then
    stream = 0x88E0   ///< written for each draw
};

/// A buffer of bytes on the GPU. Move-only; GL thread only, with its context current.
class Buffer {
public:
    explicit Buffer(const GlContext& context);
    Buffer(const GlContext& context, std::span<const std::byte> bytes,
           BufferUsage usage = BufferUsage::fixed);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    unsigned name() const { return name_; }
    std::size_t size() const { return size_; } ///< in bytes

    /// Replaces the contents and the size; earlier draws keep what they had.
    void assign(std::span<const std::byte> bytes, BufferUsage usage = BufferUsage::dynamic);
    /// New undefined contents of that size.
    void allocate(std::size_t size, BufferUsage usage = BufferUsage::dynamic);
    void write(std::size_t offset, std::span<const std::byte> bytes);
    void read(std::size_t offset, std::span<std::byte> bytes) const;

private:
    const GlContext* context_;
    unsigned name_ = 0;
    std::size_t size_ = 0;
};

} // namespace terrane
