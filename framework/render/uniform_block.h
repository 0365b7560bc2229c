// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/context.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace terrane {

/// The buffer behind a uniform block, with a copy of its contents on the CPU: values are written to
/// the copy and sent together, once before a draw. Starts with zeros. GL thread only.
class UniformBlock {
public:
    UniformBlock(const GlContext& context, std::size_t size);
    ~UniformBlock();
    UniformBlock(const UniformBlock&) = delete;
    UniformBlock& operator=(const UniformBlock&) = delete;

    std::size_t size() const { return bytes_.size(); }
    const std::byte* bytes() const { return bytes_.data(); }
    /// Changes bytes; they are sent by the next flush() if they differ. The range must be inside.
    void write(std::size_t offset, const std::byte* data, std::size_t size);
    /// Sends what has changed since the last flush.
    void flush();

    unsigned buffer() const { return buffer_; }
    std::uint64_t serial() const { return serial_; }
    /// How often something was sent, for tests.
    int uploads() const { return uploads_; }

private:
    const GlContext& context_;
    std::vector<std::byte> bytes_;
    std::size_t dirtyBegin_ = 0;
    std::size_t dirtyEnd_ = 0;
    unsigned buffer_ = 0;
    std::uint64_t serial_ = 0;
    int uploads_ = 0;
};

/// The uniform blocks of all programs of a context. Blocks with the same name, byte size and number
/// of members (array elements count one by one) are one (ork reference 2.5): a value set through
/// one program is seen by all, which is how archives hand camera and sun from module to module.
class UniformBlockPool {
public:
    explicit UniformBlockPool(const GlContext& context)
        : context_(context) {}

    struct Acquired {
        std::shared_ptr<UniformBlock> block;
        bool created = false; ///< nobody had it, so initial values apply
    };
    /// The block lives as long as somebody holds it.
    Acquired acquire(const std::string& name, std::size_t size, int members);

private:
    using Key = std::tuple<std::string, std::size_t, int>;

    const GlContext& context_;
    std::map<Key, std::weak_ptr<UniformBlock>> blocks_;
};

} // namespace terrane
