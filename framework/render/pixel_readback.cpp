// SPDX-License-Identifier: BSD-3-Clause
#include "render/pixel_readback.h"

#include "render/framebuffer.h"
#include "render/state_tracker.h"

#include <glad/gl.h>

#include <cassert>

namespace terrane {

PixelReadback::PixelReadback(const GlContext& context, std::size_t bytes)
    : context_(context)
    , bytes_(bytes) {
    assert(context.isCurrent() && "PixelReadback: its context is not current");
    const auto& gl = context.gl();
    // Coherent: what a signalled fence stands behind may be read without another call.
    constexpr unsigned kAccess = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    const auto size = static_cast<GLsizeiptr>(bytes_ * kLatency);
    gl.CreateBuffers(1, &buffer_);
    context.countObject(1);
    gl.NamedBufferStorage(buffer_, size, nullptr, kAccess | GL_CLIENT_STORAGE_BIT);
    mapped_ = static_cast<const std::byte*>(gl.MapNamedBufferRange(buffer_, 0, size, kAccess));
}

PixelReadback::~PixelReadback() {
    assert(context_.isCurrent() && "PixelReadback: its context is not current");
    const auto& gl = context_.gl();
    for (const Request& request : requests_)
        if (request.fence) gl.DeleteSync(static_cast<GLsync>(request.fence));
    context_.state().forgetBuffer(buffer_);
    gl.DeleteBuffers(1, &buffer_);
    context_.countObject(-1);
}

void PixelReadback::request(std::uint64_t frame, const Framebuffer& framebuffer, int width,
                            int height, TransferLayout layout) {
    assert(usable() && "PixelReadback::request(): there is no memory");
    assert(!full() && "PixelReadback::request(): take the results first");
    const auto bytes =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * layout.pixelSize();
    assert(bytes <= bytes_ && "PixelReadback::request(): too large");
    const int part = (first_ + count_++) % kLatency;
    const auto& gl = context_.gl();
    context_.state().bindReadFramebuffer(framebuffer.name());
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, buffer_);
    const std::size_t offset = static_cast<std::size_t>(part) * bytes_;
    gl.ReadPixels(0, 0, width, height, unsigned(layout.format), unsigned(layout.type),
                  reinterpret_cast<void*>(offset));
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0); // others read into memory
    requests_[part] = {frame, bytes, gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)};
}

std::span<const std::byte> PixelReadback::take(std::uint64_t frame, const ReadbackTiming& timing) {
    if (empty()) return {};
    Request& request = requests_[first_];
    const bool due = frame >= request.frame + kLatency;
    if (!due || !arrived(request, timing.sameFrameInEachRun)) return {};
    const std::span<const std::byte> pixels{mapped_ + static_cast<std::size_t>(first_) * bytes_,
                                            request.bytes};
    request = {};
    first_ = (first_ + 1) % kLatency;
    --count_;
    return pixels;
}

bool PixelReadback::arrived(Request& request, bool wait) const {
    const auto& gl = context_.gl();
    const auto fence = static_cast<GLsync>(request.fence);
    constexpr GLuint64 kLong = 1'000'000'000; // ns; a driver may allow less
    GLenum status = gl.ClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    while (wait && status == GL_TIMEOUT_EXPIRED)
        status = gl.ClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, kLong);
    if (status == GL_TIMEOUT_EXPIRED) return false;
    gl.DeleteSync(fence);
    request.fence = nullptr;
    return true;
}

} // namespace terrane
