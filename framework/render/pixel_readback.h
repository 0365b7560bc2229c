// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/context.h"
#include "render/texture_format.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace terrane {

class Framebuffer;

/// When what was asked for in one frame may be read in a later one.
struct ReadbackTiming {
    /// Wait for a GPU that is late, so that results come in the same frame in each run. Otherwise
    /// they come in the first frame in which nobody has to wait.
    bool sameFrameInEachRun = true;
};

/// Reads pixels back some frames later, so that no frame waits for the GPU: a ring of pixel pack
/// buffers, each with a fence (terrain reference 3.7). Results come in the order of the requests.
/// GL thread only, with its context current. Allocates nothing after it was made.
///
///     PixelReadback readback(context, mostBytes);
///     each frame: const auto pixels = readback.take(frame, timing); // empty: nothing has arrived
///                 if (!readback.full()) readback.request(frame, framebuffer, 16, 1, layout);
class PixelReadback {
public:
    /// A request of frame n has arrived in frame n + 3.
    static constexpr int kLatency = 3;

    /// @param bytes of the largest request
    PixelReadback(const GlContext& context, std::size_t bytes);
    ~PixelReadback();
    PixelReadback(const PixelReadback&) = delete;
    PixelReadback& operator=(const PixelReadback&) = delete;

    /// False when the driver gave no memory: there is nothing to be had then.
    bool usable() const { return mapped_ != nullptr; }
    /// No more requests until one is taken.
    bool full() const { return count_ == kLatency; }
    /// Nothing is on its way.
    bool empty() const { return count_ == 0; }

    /// Copies the lower left width x height pixels of the framebuffer's read buffer as they will be
    /// when all that was drawn before is done; tightly packed, first row at the bottom.
    void request(std::uint64_t frame, const Framebuffer& framebuffer, int width, int height,
                 TransferLayout layout);

    /// The pixels of the oldest request if it is kLatency frames old and, unless one waits for it,
    /// done; else nothing. They may be read until the next request.
    std::span<const std::byte> take(std::uint64_t frame, const ReadbackTiming& timing);

private:
    struct Request {
        std::uint64_t frame = 0;
        std::size_t bytes = 0;
        void* fence = nullptr; ///< a GLsync
    };

    bool arrived(Request& request, bool wait) const;

    const GlContext& context_;
    const std::size_t bytes_; ///< of each of the kLatency parts of the buffer
    unsigned buffer_ = 0;
    const std::byte* mapped_ = nullptr; ///< for as long as the buffer lives
    std::array<Request, kLatency> requests_;
    int first_ = 0, count_ = 0; ///< in the ring
};

} // namespace terrane
