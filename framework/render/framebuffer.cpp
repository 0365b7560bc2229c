// SPDX-License-Identifier: BSD-3-Clause
#include "render/framebuffer.h"

#include "render/state_tracker.h"

#include <glad/gl.h>

#include <algorithm>
#include <cassert>
#include <glm/common.hpp>
#include <utility>

namespace terrane {

namespace {

constexpr std::array<const char*, kAttachmentPoints> kPointNames{
    "COLOR0", "COLOR1", "COLOR2", "COLOR3", "COLOR4",
    "COLOR5", "COLOR6", "COLOR7", "DEPTH",  "STENCIL"};

bool isColour(AttachmentPoint point) {
    return point < AttachmentPoint::depth;
}

/// GL_NONE for what is no colour.
unsigned colourBuffer(AttachmentPoint point) {
    return isColour(point) ? GL_COLOR_ATTACHMENT0 + unsigned(point) : unsigned(GL_NONE);
}

unsigned attachmentName(std::size_t point) {
    if (point == std::size_t(AttachmentPoint::depth)) return GL_DEPTH_ATTACHMENT;
    if (point == std::size_t(AttachmentPoint::stencil)) return GL_STENCIL_ATTACHMENT;
    return GL_COLOR_ATTACHMENT0 + unsigned(point);
}

bool hasLayers(TextureTarget target) {
    return target != TextureTarget::texture1D && target != TextureTarget::texture2D &&
           target != TextureTarget::rectangle && target != TextureTarget::multisample2D;
}

const char* statusText(unsigned status) {
    switch (status) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
        return "an attachment can't be drawn into";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
        return "nothing is attached";
    case GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER:
        return "a draw buffer has no attachment";
    case GL_FRAMEBUFFER_INCOMPLETE_READ_BUFFER:
        return "the read buffer has no attachment";
    case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
        return "the attachments differ in their samples";
    case GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS:
        return "some attachments have layers, some not";
    case GL_FRAMEBUFFER_UNSUPPORTED:
        return "the driver can't draw into these formats together";
    default:
        return "the attachments do not fit together";
    }
}

} // namespace

int Attachment::width() const {
    return texture->region(level).width;
}

int Attachment::height() const {
    return texture->region(level).height;
}

Framebuffer::Framebuffer(const GlContext& context)
    : context_(&context) {
    assert(context.isCurrent() && "Framebuffer: its context is not current");
    context.gl().CreateFramebuffers(1, &name_);
    context.countObject(1);
    context.gl().NamedFramebufferDrawBuffer(name_, GL_NONE);
    context.gl().NamedFramebufferReadBuffer(name_, GL_NONE);
}

Framebuffer::~Framebuffer() {
    if (!name_) return;
    assert(context_->isCurrent() && "Framebuffer: its context is not current");
    context_->state().forgetFramebuffer(name_);
    context_->gl().DeleteFramebuffers(1, &name_);
    context_->countObject(-1);
}

Framebuffer::Framebuffer(Framebuffer&& other) noexcept
    : state(other.state)
    , context_(other.context_)
    , name_(std::exchange(other.name_, 0))
    , attached_(std::move(other.attached_))
    , drawBuffers_(std::move(other.drawBuffers_))
    , readBuffer_(other.readBuffer_)
    , buffersFixed_(other.buffersFixed_) {}

Framebuffer& Framebuffer::operator=(Framebuffer&& other) noexcept {
    std::swap(state, other.state);
    std::swap(context_, other.context_);
    std::swap(name_, other.name_);
    std::swap(attached_, other.attached_);
    std::swap(drawBuffers_, other.drawBuffers_);
    std::swap(readBuffer_, other.readBuffer_);
    std::swap(buffersFixed_, other.buffersFixed_);
    return *this;
}

std::string Framebuffer::problem(AttachmentPoint point, const Attachment& attachment) {
    if (point == AttachmentPoint::none) return "nothing can be attached to NONE";
    if (!attachment.texture) return "there is no texture";
    const Texture& texture = *attachment.texture;
    const auto& format = texture.format();
    if (attachment.level < 0 || attachment.level >= texture.levels()) {
        return "level " + std::to_string(attachment.level) + " of a texture with " +
               std::to_string(texture.levels());
    }
    const int layers = texture.zCount(attachment.level);
    if (attachment.layer < kAllLayers || attachment.layer >= layers) {
        return "layer " + std::to_string(attachment.layer) + " of a texture with " +
               std::to_string(layers);
    }
    if (!texture.allocated()) return "there was no memory for the texture";
    if (texture.description().target == TextureTarget::buffer)
        return "a buffer texture can't be drawn into";
    if (format.compressed)
        return "a compressed texture (" + std::string(format.name) + ") can't be drawn into";
    const bool fits = point == AttachmentPoint::depth ? format.hasDepth()
                      : point == AttachmentPoint::stencil
                          ? format.hasStencil()
                          : !format.hasDepth() && !format.hasStencil();
    if (!fits)
        return "format " + std::string(format.name) + " can't be " +
               kPointNames[std::size_t(point)];
    return {};
}

void Framebuffer::attach(AttachmentPoint point, const Attachment& attachment) {
    assert(problem(point, attachment).empty() && "Framebuffer::attach(): impossible attachment");
    auto& attached = attached_[std::size_t(point)];
    if (attached.attachment == attachment && attached.serial == attachment.texture->serial()) {
        return;
    }
    attached.attachment = attachment;
    send(std::size_t(point));
}

void Framebuffer::detach(AttachmentPoint point) {
    auto& attached = attached_[std::size_t(point)];
    if (!attached.attachment.texture) return;
    attached = {};
    context_->gl().NamedFramebufferTexture(name_, attachmentName(std::size_t(point)), 0, 0);
}

void Framebuffer::detachAll() {
    for (std::size_t point = 0; point < attached_.size(); ++point) {
        detach(AttachmentPoint(point));
    }
}

const Attachment& Framebuffer::attachment(AttachmentPoint point) const {
    assert(point != AttachmentPoint::none && "Framebuffer::attachment(): nothing is at NONE");
    return attached_[std::size_t(point)].attachment;
}

void Framebuffer::send(std::size_t point) const {
    auto& [attachment, serial] = attached_[point];
    const auto& texture = *attachment.texture;
    const auto& gl = context_->gl();
    if (attachment.layer == kAllLayers || !hasLayers(texture.description().target)) {
        gl.NamedFramebufferTexture(name_, attachmentName(point), texture.name(), attachment.level);
    } else {
        gl.NamedFramebufferTextureLayer(name_, attachmentName(point), texture.name(),
                                        attachment.level, attachment.layer);
    }
    serial = texture.serial();
}

void Framebuffer::refresh() const {
    for (std::size_t point = 0; point < attached_.size(); ++point) {
        const auto& texture = attached_[point].attachment.texture;
        if (texture && texture->serial() != attached_[point].serial) send(point);
    }
}

void Framebuffer::setDrawBuffers(std::span<const AttachmentPoint> points) {
    if (buffersFixed_ ||
        std::equal(points.begin(), points.end(), drawBuffers_.begin(), drawBuffers_.end())) {
        return;
    }
    drawBuffers_.assign(points.begin(), points.end());
    std::array<GLenum, kMaxColourBuffers> buffers{};
    const std::size_t count = std::min(points.size(), buffers.size());
    std::transform(points.begin(), points.begin() + std::ptrdiff_t(count), buffers.begin(),
                   colourBuffer);
    context_->gl().NamedFramebufferDrawBuffers(name_, GLsizei(count), buffers.data());
}

void Framebuffer::setReadBuffer(AttachmentPoint point) {
    if (buffersFixed_ || point == readBuffer_) return;
    readBuffer_ = point;
    context_->gl().NamedFramebufferReadBuffer(name_, colourBuffer(point));
}

void Framebuffer::setSizeWithoutAttachments(int width, int height) {
    const auto& gl = context_->gl();
    gl.NamedFramebufferParameteri(name_, GL_FRAMEBUFFER_DEFAULT_WIDTH, width);
    gl.NamedFramebufferParameteri(name_, GL_FRAMEBUFFER_DEFAULT_HEIGHT, height);
    state.viewport = {0, 0, width, height};
}

bool Framebuffer::isComplete(Diagnostics& diagnostics, const Place& place) const {
    refresh();
    const unsigned status = context_->gl().CheckNamedFramebufferStatus(name_, GL_DRAW_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return true;
    std::string detail;
    for (std::size_t point = 0; point < attached_.size(); ++point) {
        const auto& attachment = attached_[point].attachment;
        if (!attachment.texture) continue;
        detail += std::string(detail.empty() ? "" : "\n") + kPointNames[point] + ": " +
                  std::string(attachment.texture->format().name) + ", " +
                  std::to_string(attachment.width()) + " x " + std::to_string(attachment.height()) +
                  ", level " + std::to_string(attachment.level) + ", layer " +
                  std::to_string(attachment.layer);
    }
    diagnostics.report(
        {.code = "incomplete-framebuffer",
         .place = place,
         .message = std::string("can't draw into these targets: ") + statusText(status),
         .detail = std::move(detail)});
    return false;
}

void Framebuffer::use() const {
    refresh();
    auto& tracker = context_->state();
    tracker.bindDrawFramebuffer(name_);
    tracker.bindReadFramebuffer(name_);
    tracker.apply(state);
}

void Framebuffer::clear(Planes planes) const {
    use();
    unsigned mask = 0;
    if (contains(planes, Planes::depth)) mask |= GL_DEPTH_BUFFER_BIT;
    if (contains(planes, Planes::stencil)) mask |= GL_STENCIL_BUFFER_BIT;
    if (contains(planes, Planes::colour) && !clearIntegers()) mask |= GL_COLOR_BUFFER_BIT;
    if (mask) context_->gl().Clear(mask);
}

/// glClear leaves integer colours undefined: if there are some, clears every colour on its own.
bool Framebuffer::clearIntegers() const {
    const auto kindOf = [this](AttachmentPoint point) {
        const auto* texture = isColour(point) ? attachment(point).texture.get() : nullptr;
        return texture ? texture->format().kind : ChannelKind::normalized;
    };
    const auto isInteger = [&](AttachmentPoint point) {
        const auto kind = kindOf(point);
        return kind == ChannelKind::signedInteger || kind == ChannelKind::unsignedInteger;
    };
    if (std::none_of(drawBuffers_.begin(), drawBuffers_.end(), isInteger)) return false;
    const auto& gl = context_->gl();
    const glm::vec4 colour = state.clear.colour;
    for (std::size_t i = 0; i < drawBuffers_.size(); ++i) {
        const auto kind = kindOf(drawBuffers_[i]);
        if (kind == ChannelKind::signedInteger) {
            const GLint values[4] = {GLint(colour.r), GLint(colour.g), GLint(colour.b),
                                     GLint(colour.a)};
            gl.ClearBufferiv(GL_COLOR, GLint(i), values);
        } else if (kind == ChannelKind::unsignedInteger) {
            const glm::vec4 positive = glm::max(colour, 0.0F);
            const GLuint values[4] = {GLuint(positive.r), GLuint(positive.g), GLuint(positive.b),
                                      GLuint(positive.a)};
            gl.ClearBufferuiv(GL_COLOR, GLint(i), values);
        } else {
            gl.ClearBufferfv(GL_COLOR, GLint(i), &colour.x);
        }
    }
    return true;
}

std::vector<std::byte> Framebuffer::readPixels(int x, int y, int width, int height,
                                               TransferLayout layout) const {
    refresh();
    context_->state().bindReadFramebuffer(name_);
    std::vector<std::byte> pixels(std::size_t(width) * std::size_t(height) * layout.pixelSize());
    context_->gl().ReadPixels(x, y, width, height, unsigned(layout.format), unsigned(layout.type),
                              pixels.data());
    return pixels;
}

void Framebuffer::copyTo(Texture& texture, const TextureRegion& region, int x, int y) const {
    assert(region.depth == 1 && "Framebuffer::copyTo(): one layer at a time");
    refresh();
    context_->state().bindReadFramebuffer(name_);
    const auto& gl = context_->gl();
    switch (texture.description().target) {
    case TextureTarget::texture1D:
        gl.CopyTextureSubImage1D(texture.name(), region.level, region.x, x, y, region.width);
        break;
    case TextureTarget::texture1DArray:
        gl.CopyTextureSubImage2D(texture.name(), region.level, region.x, region.z, x, y,
                                 region.width, 1);
        break;
    case TextureTarget::texture2D:
    case TextureTarget::rectangle:
        gl.CopyTextureSubImage2D(texture.name(), region.level, region.x, region.y, x, y,
                                 region.width, region.height);
        break;
    default:
        gl.CopyTextureSubImage3D(texture.name(), region.level, region.x, region.y, region.z, x, y,
                                 region.width, region.height);
        break;
    }
}

void Framebuffer::blit(const Framebuffer& to, const PipelineState::Rectangle& source,
                       const PipelineState::Rectangle& destination, Planes planes,
                       MagFilter filter) const {
    to.refresh();
    blitTo(to.name_, source, destination, planes, filter);
}

void Framebuffer::blitToWindow(const PipelineState::Rectangle& source,
                               const PipelineState::Rectangle& destination,
                               MagFilter filter) const {
    blitTo(0, source, destination, Planes::colour, filter);
}

void Framebuffer::blitTo(unsigned framebuffer, const PipelineState::Rectangle& source,
                         const PipelineState::Rectangle& destination, Planes planes,
                         MagFilter filter) const {
    refresh();
    // Scissor and write masks of whoever drew last would cut the blit.
    context_->state().apply(PipelineState{});
    unsigned mask = 0;
    if (contains(planes, Planes::colour)) mask |= GL_COLOR_BUFFER_BIT;
    if (contains(planes, Planes::depth)) mask |= GL_DEPTH_BUFFER_BIT;
    if (contains(planes, Planes::stencil)) mask |= GL_STENCIL_BUFFER_BIT;
    context_->gl().BlitNamedFramebuffer(
        name_, framebuffer, source.x, source.y, source.x + source.width, source.y + source.height,
        destination.x, destination.y, destination.x + destination.width,
        destination.y + destination.height, mask, unsigned(filter));
}

void Framebuffer::generateMipmaps() const {
    for (const auto& attached : attached_) {
        const auto& texture = attached.attachment.texture;
        if (texture && texture->sampling().mipmapped()) texture->generateMipmaps();
    }
}

} // namespace terrane
