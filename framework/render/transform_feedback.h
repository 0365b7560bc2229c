// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/buffer.h"
#include "render/mesh_data.h"

#include <array>
#include <memory>

namespace terrane {

/// Captures the outputs of vertices, as the modules of the current program say (`feedback`,
/// `varyings`), into buffers, while draws go on. It keeps its buffers alive. GL thread only.
///
///     const auto captured = std::make_shared<Buffer>(context);
///     captured->allocate(size);
///     TransformFeedback feedback(context);
///     feedback.setBuffer(0, captured);
///     program->use(); // its program must stay the same until end()
///     feedback.begin(PrimitiveMode::points, false);
///     points.draw();
///     feedback.end();
class TransformFeedback {
public:
    static constexpr int kMaxBuffers = 4; // guaranteed by OpenGL 4.5

    explicit TransformFeedback(const GlContext& context);
    ~TransformFeedback();
    TransformFeedback(const TransformFeedback&) = delete;
    TransformFeedback& operator=(const TransformFeedback&) = delete;

    /// Where output `index` goes if outputs are separate; all go to buffer 0 if interleaved.
    void setBuffer(unsigned index, std::shared_ptr<Buffer> buffer);

    /// From now on primitives are captured: `points`, `lines` or `triangles`, which is what the
    /// primitives drawn must come down to.
    /// @param rasterize whether they are drawn, too
    void begin(PrimitiveMode primitives, bool rasterize);
    /// Captures nothing until resume(); other programs may be used in between.
    void pause();
    void resume();
    void end();

    unsigned name() const { return name_; }

private:
    const GlContext& context_;
    unsigned name_ = 0;
    bool rasterizes_ = true;
    std::array<std::shared_ptr<Buffer>, kMaxBuffers> buffers_;
};

} // namespace terrane
