// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/buffer.h"
#include "render/mesh_data.h"

#include <span>

namespace terrane {

/// Which buffers the attributes and indices of a draw come from. It refers to buffers but does not
/// own them. Move-only; GL thread only, with its context current.
class VertexArray {
public:
    explicit VertexArray(const GlContext& context);
    ~VertexArray();
    VertexArray(VertexArray&& other) noexcept;
    VertexArray& operator=(VertexArray&& other) noexcept;

    /// Reads `attributes` from `buffer`, interleaved and tightly packed.
    /// @param slot which of the vertex array's buffers (0 to 15) this is; set again, it is replaced
    /// @param divisor 0: one element a vertex; n: one element every n instances
    void setAttributes(unsigned slot, const Buffer& buffer,
                       std::span<const VertexAttribute> attributes, unsigned divisor = 0);
    void setIndices(const Buffer& buffer);
    void bind() const;

    unsigned name() const { return name_; }

private:
    const GlContext* context_;
    unsigned name_ = 0;
};

} // namespace terrane
