// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/buffer.h"
#include "render/font.h"
#include "render/program.h"
#include "render/vertex_array.h"

#include <string_view>
#include <vector>

#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace terrane {

class Framebuffer;

/// Lines of text, gathered and then drawn at once, two triangles a character. The program reads at
/// location 0 a vec4: x and y in clip space, u and v of the font's texture; at location 1 the
/// colour (ork reference 2.8). GL thread only. Once it has seen as much text as it is going to, it
/// allocates nothing.
///
///     text.begin({width, height});
///     text.add(font, "60 fps", {4, 4}, 16, {255, 0, 0, 255});
///     program.use();
///     text.draw();
class TextBatch {
public:
    explicit TextBatch(const GlContext& context);

    /// Forgets the text; what follows is placed on a target of this size.
    void begin(const glm::ivec2& targetSize);
    /// @param position of the lower left corner of the line, in pixels from that of the target
    /// @param size height of the line in pixels
    void add(const Font& font, std::string_view text, const glm::vec2& position, float size,
             const glm::u8vec4& colour);
    bool empty() const { return vertices_.empty(); }
    /// With the program and the framebuffer that are current.
    void draw();
    /// Over the picture in a framebuffer, with the program's sampler for the letters. Blending is
    /// switched off afterwards, as archives of the original expect.
    void blend(Framebuffer& framebuffer, Program& program, const UniformHandle& sampler,
               const Font& font);

private:
    struct Vertex {
        glm::vec4 position;
        glm::u8vec4 colour;
    };

    const GlContext& context_;
    glm::vec2 toClip_{0};
    std::vector<Vertex> vertices_;
    Buffer buffer_;
    VertexArray array_;
};

} // namespace terrane
