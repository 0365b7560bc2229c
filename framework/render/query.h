// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/context.h"

#include <cstdint>
#include <optional>

namespace terrane {

enum class QueryKind : unsigned {
    samplesPassed = 0x8914,
    anySamplesPassed = 0x8C2F,
    primitivesGenerated = 0x8C87,
    feedbackPrimitivesWritten = 0x8C88,
    timeElapsed = 0x88BF ///< nanoseconds
};

/// A question about what is drawn between begin() and end(). GL thread only.
class Query {
public:
    Query(const GlContext& context, QueryKind kind);
    ~Query();
    Query(const Query&) = delete;
    Query& operator=(const Query&) = delete;

    /// Queries of one kind don't nest.
    void begin();
    void end();
    /// Waits for the answer.
    std::uint64_t result() const;
    /// Does not wait: nothing while the GPU is not there yet.
    std::optional<std::uint64_t> resultIfAvailable() const;

private:
    const GlContext& context_;
    QueryKind kind_;
    unsigned name_ = 0;
};

} // namespace terrane
