// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/pipeline_state.h"
#include "resource/description.h"
#include "resource/registry.h"

#include <vector>

namespace terrane {

/// A child of <setState>: what it says, applied to a state. What is not written stays as it is (ork
/// reference 2.16).
struct StateElement : ElementDescription {
    virtual void apply(PipelineState& state) const = 0;
};

using StateDeclarations = std::vector<const ElementDeclaration*>;

/// viewport, depthRange, clipDistances, clear, point, line, polygon: where and how faces are drawn.
StateDeclarations declareRasterStateElements(Registry& registry);
/// depth, stencil, blend, logic, scissor, write, multisampling, occlusion: what becomes of a
/// fragment.
StateDeclarations declareFragmentStateElements(Registry& registry);

/// A rule for checks: with the first attribute the second has to be given.
template <class A, class B>
void together(const ElementDescription& d, const Attr<A>& first, const char* firstName,
              const Attr<B>& second, const char* secondName, Diagnostics& diagnostics) {
    if (!first.given || second.given) return;
    diagnostics.error("missing-attribute", d.place,
                      "<" + d.tag + "> with '" + firstName + "' needs '" + secondName + "'");
}

/// The same for a number that the original did not insist on; it counts as 0.
template <class A, class B>
void alsoGiven(const ElementDescription& d, const Attr<A>& first, const char* firstName,
               const Attr<B>& second, const char* secondName, Diagnostics& diagnostics) {
    if (!first.given || second.given) return;
    diagnostics.warning("missing-attribute", d.place,
                        "<" + d.tag + "> with '" + firstName + "' has no '" + secondName +
                            "', which counts as 0",
                        "both");
}

} // namespace terrane
