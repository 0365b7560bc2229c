// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/shader_object.h"
#include "render/uniform_block.h"
#include "render/unit_table.h"

#include <optional>

namespace terrane {

/// What all programs of a context share: uniform blocks, and who sits at which texture unit and
/// uniform buffer binding. One per context; it outlives the programs and is given to builders as a
/// service.
struct ProgramBindings {
    explicit ProgramBindings(const GlContext& context);
    /// With fewer units than the driver has, for tests.
    ProgramBindings(const GlContext& context, unsigned textureUnits, unsigned uniformBindings);

    const GlContext& context;
    UniformBlockPool blocks;
    UnitTable textureUnits;
    UnitTable uniformBindings;

    /// The vertex stage of programs that have none: the attribute at location 0 is the position.
    const ShaderObject& passThroughVertex();

private:
    std::optional<ShaderObject> passThroughVertex_;
};

} // namespace terrane
