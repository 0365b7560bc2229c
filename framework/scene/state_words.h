// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/pipeline_state.h"
#include "resource/value_traits.h"

namespace terrane {

// The words of archives for pipeline state, shared by setState and by layers that blend.

inline const Words<CompareFunction> kCompareWords{
    {"NEVER", CompareFunction::never},   {"ALWAYS", CompareFunction::always},
    {"LESS", CompareFunction::less},     {"LEQUAL", CompareFunction::lequal},
    {"EQUAL", CompareFunction::equal},   {"GREATER", CompareFunction::greater},
    {"GEQUAL", CompareFunction::gequal}, {"NOTEQUAL", CompareFunction::notEqual},
};

inline const Words<StencilOperation> kStencilOperationWords{
    {"KEEP", StencilOperation::keep},
    {"RESET", StencilOperation::zero},
    {"REPLACE", StencilOperation::replace},
    {"INCR", StencilOperation::increment},
    {"DECR", StencilOperation::decrement},
    {"INVERT", StencilOperation::invert},
    {"INCR_WRAP", StencilOperation::incrementWrap},
    {"DECR_WRAP", StencilOperation::decrementWrap},
};

inline const Words<BlendEquation> kBlendEquationWords{
    {"ADD", BlendEquation::add},
    {"SUBTRACT", BlendEquation::subtract},
    {"REVERSE_SUBTRACT", BlendEquation::reverseSubtract},
    {"MIN", BlendEquation::minimum},
    {"MAX", BlendEquation::maximum},
};

inline const Words<BlendFactor> kBlendFactorWords{
    {"ZERO", BlendFactor::zero},
    {"ONE", BlendFactor::one},
    {"SRC_COLOR", BlendFactor::sourceColour},
    {"ONE_MINUS_SRC_COLOR", BlendFactor::oneMinusSourceColour},
    {"DST_COLOR", BlendFactor::destinationColour},
    {"ONE_MINUS_DST_COLOR", BlendFactor::oneMinusDestinationColour},
    {"SRC_ALPHA", BlendFactor::sourceAlpha},
    {"ONE_MINUS_SRC_ALPHA", BlendFactor::oneMinusSourceAlpha},
    {"DST_ALPHA", BlendFactor::destinationAlpha},
    {"ONE_MINUS_DST_ALPHA", BlendFactor::oneMinusDestinationAlpha},
    {"CONSTANT_COLOR", BlendFactor::constantColour},
    {"ONE_MINUS_CONSTANT_COLOR", BlendFactor::oneMinusConstantColour},
    {"CONSTANT_ALPHA", BlendFactor::constantAlpha},
    {"ONE_MINUS_CONSTANT_ALPHA", BlendFactor::oneMinusConstantAlpha},
};

inline const Words<LogicOperation> kLogicWords{
    {"CLEAR", LogicOperation::clear},
    {"AND", LogicOperation::andAll},
    {"AND_REVERSE", LogicOperation::andReverse},
    {"COPY", LogicOperation::copy},
    {"AND_INVERTED", LogicOperation::andInverted},
    {"NOOP", LogicOperation::noop},
    {"XOR", LogicOperation::exclusiveOr},
    {"OR", LogicOperation::orAll},
    {"NOR", LogicOperation::nor},
    {"EQUIV", LogicOperation::equivalent},
    {"NOT", LogicOperation::invert},
    {"OR_REVERSE", LogicOperation::orReverse},
    {"COPY_INVERTED", LogicOperation::copyInverted},
    {"OR_INVERTED", LogicOperation::orInverted},
    {"NAND", LogicOperation::nand},
    {"SET", LogicOperation::set},
};

} // namespace terrane
