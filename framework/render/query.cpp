// SPDX-License-Identifier: BSD-3-Clause
#include "render/query.h"

#include <glad/gl.h>

namespace terrane {

static_assert(unsigned(QueryKind::samplesPassed) == GL_SAMPLES_PASSED);
static_assert(unsigned(QueryKind::anySamplesPassed) == GL_ANY_SAMPLES_PASSED);
static_assert(unsigned(QueryKind::primitivesGenerated) == GL_PRIMITIVES_GENERATED);
static_assert(unsigned(QueryKind::feedbackPrimitivesWritten) ==
              GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
static_assert(unsigned(QueryKind::timeElapsed) == GL_TIME_ELAPSED);

Query::Query(const GlContext& context, QueryKind kind)
    : context_(context)
    , kind_(kind) {
    context.gl().CreateQueries(unsigned(kind), 1, &name_);
    context.countObject(1);
}

Query::~Query() {
    context_.gl().DeleteQueries(1, &name_);
    context_.countObject(-1);
}

void Query::begin() {
    context_.gl().BeginQuery(unsigned(kind_), name_);
}

void Query::end() {
    context_.gl().EndQuery(unsigned(kind_));
}

std::uint64_t Query::result() const {
    GLuint64 value = 0;
    context_.gl().GetQueryObjectui64v(name_, GL_QUERY_RESULT, &value);
    return value;
}

std::optional<std::uint64_t> Query::resultIfAvailable() const {
    GLuint available = 0;
    context_.gl().GetQueryObjectuiv(name_, GL_QUERY_RESULT_AVAILABLE, &available);
    if (available == 0) return std::nullopt;
    return result();
}

} // namespace terrane
