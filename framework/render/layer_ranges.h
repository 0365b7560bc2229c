// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/framebuffer.h"
#include "render/mesh.h"
#include "render/program.h"

#include <array>
#include <memory>
#include <optional>
#include <span>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace terrane {

/// Finds the least and the greatest elevation of layers of array textures on the GPU, some at a
/// time: each fragment reduces a row of a layer. What is left, a pair of numbers a row, is so
/// little that it is quicker to read back than another pass (terrain reference 3.7 goes on to one
/// pair).
///
/// Texels are (zf, zc, zm). A surface is drawn between zc and zm, so that both count. What is no
/// number doesn't.
class LayerRanges {
public:
    static constexpr int kMost = 16; ///< requests of one draw

    struct Request {
        const Texture* texture = nullptr; ///< a 2D array, as large as the others; 3 channels
        int layer = 0;
        /// Instead of the range: zm at a point, between the centres of texels. In texels, (0,0) is
        /// the centre of the lower left one.
        std::optional<glm::vec2> point;
    };
    /// Of a row, or of a layer; zmin > zmax when there are no numbers.
    struct Range {
        float zmin = 0, zmax = 0;
    };

    /// Null, with diagnostics, if OpenGL can't.
    /// @param size edge of the layers; @param border texels along the edges that don't count
    static std::unique_ptr<LayerRanges> make(ProgramBindings& bindings, int size, int border,
                                             Diagnostics& diagnostics);

    /// Draws the ranges of request i into row i of the framebuffer: rows() texels of
    /// {zmin, zmax}; for a point, both are zm in all of them.
    void draw(std::span<const Request> requests);
    Framebuffer& framebuffer() { return framebuffer_; }
    int rows() const { return rows_; }
    static constexpr TransferLayout kLayout{TransferFormat::rg, TransferType::f32};

    /// The range of all rows together.
    static Range combined(std::span<const Range> rows);

private:
    LayerRanges(std::shared_ptr<Program> program, const GlContext& context, int size, int border);

    const int rows_;
    std::shared_ptr<Program> program_;
    std::shared_ptr<Texture> target_;
    Framebuffer framebuffer_;
    Mesh quad_;
    Uniform<Texture> layers_;
    Uniform<int> current_;
    Uniform<glm::ivec2> inside_;
    int border_;
    std::array<Uniform<glm::vec4>, kMost> requests_;
};

} // namespace terrane
