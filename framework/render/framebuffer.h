// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/pipeline_state.h"
#include "render/texture.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace terrane {

/// What a framebuffer draws into: COLOR0 to COLOR7, DEPTH, STENCIL.
enum class AttachmentPoint {
    colour0,
    colour1,
    colour2,
    colour3,
    colour4,
    colour5,
    colour6,
    colour7,
    depth,
    stencil,
    none ///< as a draw or read buffer only
};

inline constexpr int kAttachmentPoints = 10;
/// All layers, slices or faces at once, for geometry shaders that choose gl_Layer.
inline constexpr int kAllLayers = -1;

/// A level, or a layer of one, of a texture that is drawn into.
struct Attachment {
    std::shared_ptr<Texture> texture;
    int level = 0;
    int layer = 0; ///< layer, slice, face (6 * cube + face), or kAllLayers; ignored without layers

    int width() const;  ///< of the level
    int height() const; ///< of the level
    bool operator==(const Attachment&) const = default;
};

enum class Planes : unsigned { none = 0, colour = 1, depth = 2, stencil = 4, all = 7 };
constexpr Planes operator|(Planes a, Planes b) {
    return Planes(unsigned(a) | unsigned(b));
}
constexpr bool contains(Planes planes, Planes plane) {
    return (unsigned(planes) & unsigned(plane)) != 0;
}

/// A framebuffer object with the pipeline state that belongs to it: what is set stays set until it
/// is changed, whatever other framebuffers do. A fresh one has no attachments and draws into and
/// reads from nothing. It shares the textures, and follows them when they are resized. Move-only;
/// GL thread only, with its context current.
///
///     Framebuffer target(context);
///     target.attach(AttachmentPoint::colour0, {texture});
///     target.setDrawBuffers({AttachmentPoint::colour0});
///     target.state.viewport = {0, 0, texture->width(), texture->height()};
///     target.use();
///     quad.draw();
class Framebuffer {
public:
    explicit Framebuffer(const GlContext& context);
    ~Framebuffer();
    Framebuffer(Framebuffer&& other) noexcept;
    Framebuffer& operator=(Framebuffer&& other) noexcept;

    /// Applied by use() and clear(); change it freely.
    PipelineState state;

    /// Why this can't be attached there (no such level or layer, depth as a colour...), for people
    /// to read; empty when it can.
    static std::string problem(AttachmentPoint point, const Attachment& attachment);
    /// `attachment` must be without problem(). Nothing is sent when it is attached already.
    void attach(AttachmentPoint point, const Attachment& attachment);
    void detach(AttachmentPoint point);
    void detachAll();
    /// Its texture is null when there is none.
    const Attachment& attachment(AttachmentPoint point) const;

    /// Where the outputs 0, 1... of fragment shaders go.
    void setDrawBuffers(std::span<const AttachmentPoint> points);
    void setDrawBuffers(std::initializer_list<AttachmentPoint> points) {
        setDrawBuffers(std::span(points.begin(), points.size()));
    }
    /// Which colours readPixels, copyTo and blit read. Depth needs no choice.
    void setReadBuffer(AttachmentPoint point);
    /// What drawing covers while nothing is attached; a fresh framebuffer can't be drawn into then.
    void setSizeWithoutAttachments(int width, int height);
    /// From now on choices of draw and read buffers have no effect, as on a screen.
    void fixBuffers() { buffersFixed_ = true; }

    /// False, with a diagnostic ("incomplete-framebuffer") that lists the attachments, when OpenGL
    /// can't draw into it.
    bool isComplete(Diagnostics& diagnostics, const Place& place) const;

    /// Draws go here from now on, with this state.
    void use() const;
    /// Fills planes with the clear values; write masks and scissor apply.
    void clear(Planes planes) const;

    /// Reads from the read buffer, or depth or stencil if the format says so; first row at the
    /// bottom, tightly packed. Waits for the GPU.
    std::vector<std::byte> readPixels(int x, int y, int width, int height,
                                      TransferLayout layout) const;
    /// Copies the read buffer (depth, for a depth texture), from (x, y) on, into a part of a
    /// texture. `region.depth` must be 1.
    void copyTo(Texture& texture, const TextureRegion& region, int x = 0, int y = 0) const;
    /// Copies planes into the draw buffers of another framebuffer, scaled to its rectangle; colour
    /// may be filtered linearly.
    void blit(const Framebuffer& to, const PipelineState::Rectangle& source,
              const PipelineState::Rectangle& destination, Planes planes = Planes::colour,
              MagFilter filter = MagFilter::nearest) const;
    /// The same into the window that the context belongs to.
    void blitToWindow(const PipelineState::Rectangle& source,
                      const PipelineState::Rectangle& destination,
                      MagFilter filter = MagFilter::nearest) const;

    /// Regenerates the mipmaps of attached textures whose filter uses them.
    void generateMipmaps() const;

    unsigned name() const { return name_; }

private:
    struct Attached {
        Attachment attachment;
        std::uint64_t serial = 0; ///< of the texture's storage that OpenGL was told
    };

    void send(std::size_t point) const;
    void refresh() const;
    void blitTo(unsigned framebuffer, const PipelineState::Rectangle& source,
                const PipelineState::Rectangle& destination, Planes planes, MagFilter filter) const;
    bool clearIntegers() const;

    const GlContext* context_;
    unsigned name_ = 0;
    mutable std::array<Attached, kAttachmentPoints> attached_; // serials follow the textures
    std::vector<AttachmentPoint> drawBuffers_;
    AttachmentPoint readBuffer_ = AttachmentPoint::none;
    bool buffersFixed_ = false;
};

} // namespace terrane
