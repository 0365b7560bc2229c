// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/value.h"

namespace terrane {

class BindContext;
class Mesh;
class Registry;

/// The mesh of a name: `this.grid` is a mesh of the node, a plain `quad` is the resource
/// `quad.mesh`. Null, with a diagnostic, when there is none.
Mesh* findMesh(const Attr<Target>& name, BindContext& context);

/// <drawMesh> (ork reference 2.12).
void declareDrawMesh(Registry& registry);

} // namespace terrane
