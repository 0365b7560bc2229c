// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/pipeline_state.h"
#include "resource/description.h"
#include "resource/registry.h"

#include <vector>

namespace terrane {

/// A child of <setState>: what it says, applied to a state. What is not written stays as it is.
struct StateElement : ElementDescription {
    virtual void apply(PipelineState& state) const = 0;
};

/// The declarations, in the order of the manual.
std::vector<const ElementDeclaration*> declareStateElements(Registry& registry);

} // namespace terrane
