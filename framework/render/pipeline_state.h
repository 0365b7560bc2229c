// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include <glm/vec4.hpp>

namespace terrane {

// The values of the enumerations are OpenGL's own, so that they are passed on as they are.

enum class CompareFunction : unsigned {
    never = 0x0200,
    less,
    equal,
    lequal,
    greater,
    notEqual,
    gequal,
    always
};

enum class StencilOperation : unsigned {
    keep = 0x1E00,
    zero = 0,
    replace = 0x1E01,
    increment = 0x1E02,
    decrement = 0x1E03,
    invert = 0x150A,
    incrementWrap = 0x8507,
    decrementWrap = 0x8508
};

enum class BlendEquation : unsigned {
    add = 0x8006,
    minimum = 0x8007,
    maximum = 0x8008,
    subtract = 0x800A,
    reverseSubtract = 0x800B
};

enum class BlendFactor : unsigned {
    zero = 0,
    one = 1,
    sourceColour = 0x0300,
    oneMinusSourceColour,
    sourceAlpha,
    oneMinusSourceAlpha,
    destinationAlpha,
    oneMinusDestinationAlpha,
    destinationColour,
    oneMinusDestinationColour,
    constantColour = 0x8001,
    oneMinusConstantColour,
    constantAlpha,
    oneMinusConstantAlpha
};

enum class LogicOperation : unsigned {
    clear = 0x1500,
    andAll,
    andReverse,
    copy,
    andInverted,
    noop,
    exclusiveOr,
    orAll,
    nor,
    equivalent,
    invert,
    orReverse,
    copyInverted,
    orInverted,
    nand,
    set
};

enum class RasterMode : unsigned { point = 0x1B00, line, fill };
enum class CullFace : unsigned { none = 0, front = 0x0404, back = 0x0405, both = 0x0408 };

inline constexpr int kMaxColourBuffers = 8;

/// Everything that `setState` can set and that belongs to a framebuffer: plain data with the
/// state of a fresh framebuffer as its defaults (Ork reference 2.16). Framebuffer::use applies it.
struct PipelineState {
    struct Rectangle {
        int x = 0, y = 0, width = 0, height = 0;
        bool operator==(const Rectangle&) const = default;
    };
    struct DepthRange {
        double near = 0, far = 1;
        bool operator==(const DepthRange&) const = default;
    };
    struct Clear {
        glm::vec4 colour{0};
        int stencil = 0;
        double depth = 1;
        bool operator==(const Clear&) const = default;
    };
    struct Point {
        float size = 1; ///< 0 or less: set by the shader
        float threshold = 1;
        bool lowerLeftOrigin = false;
        bool operator==(const Point&) const = default;
    };
    struct Line {
        float width = 1;
        bool smooth = false;
        bool operator==(const Line&) const = default;
    };
    struct Polygon {
        RasterMode mode = RasterMode::fill; ///< of both faces; core profiles have no others
        CullFace cull = CullFace::none;
        bool frontIsClockwise = false;
        bool smooth = false;
        float offsetFactor = 0, offsetUnits = 0;
        bool pointOffset = false, lineOffset = false, polygonOffset = false;
        bool operator==(const Polygon&) const = default;
    };
    struct Depth {
        bool enabled = false;
        CompareFunction function = CompareFunction::less;
        bool operator==(const Depth&) const = default;
    };
    struct StencilFace {
        CompareFunction function = CompareFunction::always;
        int reference = 0;
        unsigned mask = ~0U;
        StencilOperation fail = StencilOperation::keep;
        StencilOperation depthFail = StencilOperation::keep;
        StencilOperation depthPass = StencilOperation::keep;
        bool operator==(const StencilFace&) const = default;
    };
    struct Stencil {
        bool enabled = false;
        StencilFace front, back;
        bool operator==(const Stencil&) const = default;
    };
    struct Blend {
        bool enabled = false;
        BlendEquation equation = BlendEquation::add, alphaEquation = BlendEquation::add;
        BlendFactor source = BlendFactor::one, destination = BlendFactor::zero;
        BlendFactor alphaSource = BlendFactor::one, alphaDestination = BlendFactor::zero;
        bool operator==(const Blend&) const = default;
    };
    struct Logic {
        bool enabled = false;
        LogicOperation operation = LogicOperation::copy;
        bool operator==(const Logic&) const = default;
    };
    struct Scissor {
        bool enabled = false;
        Rectangle rectangle;
        bool operator==(const Scissor&) const = default;
    };
    struct ColourMask {
        bool red = true, green = true, blue = true, alpha = true;
        bool operator==(const ColourMask&) const = default;
    };
    struct Masks {
        std::array<ColourMask, kMaxColourBuffers> colour;
        bool depth = true;
        unsigned stencilFront = ~0U, stencilBack = ~0U;
        bool operator==(const Masks&) const = default;
    };
    struct Multisampling {
        bool enabled = true;
        bool alphaToCoverage = false, alphaToOne = false;
        float coverage = 1; ///< below 1 masks samples; negative: the complement of its absolute
        unsigned mask = ~0U;
        bool sampleShading = false;
        float minimumShading = 0;
        bool operator==(const Multisampling&) const = default;
    };

    Rectangle viewport;
    DepthRange depthRange;
    unsigned clipDistances = 0; ///< bit i enables gl_ClipDistance[i]
    Clear clear;
    Point point;
    Line line;
    Polygon polygon;
    Depth depth;
    Stencil stencil;
    std::array<Blend, kMaxColourBuffers> blend;
    glm::vec4 blendColour{0};
    Logic logic;
    Scissor scissor;
    Masks write;
    Multisampling multisampling;
    bool dither = false;

    bool operator==(const PipelineState&) const = default;
};

} // namespace terrane
