// SPDX-License-Identifier: BSD-3-Clause
#include "scene/state_elements.h"

namespace terrane {

namespace {

struct ViewportElement : StateElement {
    Attr<int> x = 0, y = 0, width = 0, height = 0;
    void apply(PipelineState& s) const override { s.viewport = {x, y, width, height}; }
    static const ElementDeclaration& declare(Registry& registry) {
        using D = ViewportElement;
        return registry.element<D>("viewport", "The part of the framebuffer that is drawn into.")
            .attribute("x", &D::x, "left side")
            .required()
            .unit("pixels")
            .attribute("y", &D::y, "bottom")
            .required()
            .unit("pixels")
            .attribute("width", &D::width, "width")
            .required()
            .atLeast(0)
            .unit("pixels")
            .attribute("height", &D::height, "height")
            .required()
            .atLeast(0)
            .unit("pixels")
            .declaration();
    }
};

struct DepthRangeElement : StateElement {
    Attr<double> near = 0, far = 1;
    void apply(PipelineState& s) const override { s.depthRange = {near, far}; }
    static const ElementDeclaration& declare(Registry& registry) {
        using D = DepthRangeElement;
        return registry.element<D>("depthRange", "Depth of the near and of the far plane.")
            .attribute("near", &D::near, "depth of the near plane")
            .atLeast(0)
            .atMost(1)
            .clamped()
            .attribute("far", &D::far, "depth of the far plane")
            .atLeast(0)
            .atMost(1)
            .clamped()
            .declaration();
    }
};

struct ClipDistancesElement : StateElement {
    static constexpr int kAll = 63;
    Attr<int> value = 0;
    void apply(PipelineState& s) const override { s.clipDistances = *value & kAll; }
    static void check(const ClipDistancesElement& d, Diagnostics& diagnostics) {
        if ((*d.value & ~kAll) == 0) return;
        diagnostics.warning("out-of-range", d.value.place, "only bits 0 to 5 count",
                            "0 to " + std::to_string(kAll));
    }
    static const ElementDeclaration& declare(Registry& registry) {
        using D = ClipDistancesElement;
        return registry.element<D>("clipDistances", "Which gl_ClipDistance count.")
            .attribute("value", &D::value, "bit i enables gl_ClipDistance[i]")
            .required()
            .bits()
            .check(check)
            .declaration();
    }
};

struct ClearElement : StateElement {
    Attr<float> r = 0, g = 0, b = 0, a = 0;
    Attr<int> stencil = 0;
    Attr<double> depth = 1;
    void apply(PipelineState& s) const override {
        if (r.given) s.clear.colour = {*r, *g, *b, *a};
        if (stencil.given) s.clear.stencil = stencil;
        if (depth.given) s.clear.depth = depth;
    }
    static const ElementDeclaration& declare(Registry& registry) {
        using D = ClearElement;
        return registry.element<D>("clear", "What the planes are cleared to.")
            .attribute("r", &D::r, "red; the colour is set only if it is given")
            .attribute("g", &D::g, "green")
            .attribute("b", &D::b, "blue")
            .attribute("a", &D::a, "alpha")
            .attribute("stencil", &D::stencil, "stencil value")
            .attribute("depth", &D::depth, "depth")
            .atLeast(0)
            .atMost(1)
            .clamped()
            .declaration();
    }
};

struct PointElement : StateElement {
    Attr<float> size = 1, threshold = 1;
    Attr<bool> lowerLeftOrigin = false;
    void apply(PipelineState& s) const override {
        if (size.given) s.point.size = size;
        if (threshold.given) s.point.threshold = threshold;
        if (lowerLeftOrigin.given) s.point.lowerLeftOrigin = lowerLeftOrigin;
    }
    static const ElementDeclaration& declare(Registry& registry) {
        using D = PointElement;
        return registry.element<D>("point", "How points are drawn.")
            .attribute("size", &D::size, "diameter; 0 or less: set by the shader")
            .unit("pixels")
            .attribute("threshold", &D::threshold, "size below which points fade out")
            .attribute("lowerleftorigin", &D::lowerLeftOrigin,
                       "point coordinates start at the bottom")
            .declaration();
    }
};

struct LineElement : StateElement {
    Attr<float> width = 1;
    Attr<bool> smooth = false;
    void apply(PipelineState& s) const override {
        if (width.given) s.line.width = width;
        if (smooth.given) s.line.smooth = smooth;
    }
    static const ElementDeclaration& declare(Registry& registry) {
        using D = LineElement;
        return registry.element<D>("line", "How lines are drawn.")
            .attribute("width", &D::width, "width")
            .above(0)
            .unit("pixels")
            .attribute("smooth", &D::smooth, "antialiased")
            .declaration();
    }
};

enum class FaceMode { point, line, fill, cull };
const Words<FaceMode> kFaceWords{{"FILL", FaceMode::fill},
                                 {"LINE", FaceMode::line},
                                 {"POINT", FaceMode::point},
                                 {"CULL", FaceMode::cull}};

struct PolygonElement : StateElement {
    Attr<FaceMode> front = FaceMode::fill, back = FaceMode::fill;
    Attr<bool> frontCW = false, smooth = false;
    Attr<float> offsetFactor = 0, offsetUnits = 0;
    Attr<bool> pointOffset = false, lineOffset = false, polygonOffset = false;

    void apply(PipelineState& s) const override {
        if (front.given) applyFaces(s.polygon);
        if (frontCW.given) s.polygon.frontIsClockwise = frontCW;
        if (smooth.given) s.polygon.smooth = smooth;
        if (offsetFactor.given) s.polygon.offsetFactor = offsetFactor;
        if (offsetUnits.given) s.polygon.offsetUnits = offsetUnits;
        if (!pointOffset.given) return;
        s.polygon.pointOffset = pointOffset;
        s.polygon.lineOffset = lineOffset;
        s.polygon.polygonOffset = polygonOffset;
    }

    // One raster mode for both faces: the front's, unless that is culled.
    void applyFaces(PipelineState::Polygon& polygon) const {
        const bool culled[] = {*front == FaceMode::cull, *back == FaceMode::cull};
        polygon.cull = culled[0] && culled[1] ? CullFace::both
                       : culled[0]            ? CullFace::front
                       : culled[1]            ? CullFace::back
                                              : CullFace::none;
        const FaceMode mode = culled[0] ? *back : *front;
        if (mode == FaceMode::point) polygon.mode = RasterMode::point;
        if (mode == FaceMode::line) polygon.mode = RasterMode::line;
        if (mode == FaceMode::fill || mode == FaceMode::cull) polygon.mode = RasterMode::fill;
    }

    static void check(const PolygonElement& d, Diagnostics& diagnostics) {
        together(d, d.front, "front", d.back, "back", diagnostics);
        together(d, d.pointOffset, "pointOffset", d.lineOffset, "lineOffset", diagnostics);
        together(d, d.pointOffset, "pointOffset", d.polygonOffset, "polygonOffset", diagnostics);
    }

    // `cull` is an older spelling of the same element.
    static const ElementDeclaration& declare(Registry& registry, const char* tag) {
        using D = PolygonElement;
        return registry.element<D>(tag, "How faces are drawn, and which are not.")
            .attribute("front", &D::front, "front faces", kFaceWords)
            .attribute("back", &D::back, "back faces", kFaceWords)
            .attribute("frontCW", &D::frontCW, "front faces are clockwise")
            .attribute("smooth", &D::smooth, "antialiased")
            .attribute("offsetFactor", &D::offsetFactor, "depth offset per slope")
            .attribute("offsetUnits", &D::offsetUnits, "constant depth offset")
            .attribute("pointOffset", &D::pointOffset, "offset faces drawn as points")
            .attribute("lineOffset", &D::lineOffset, "offset faces drawn as lines")
            .attribute("polygonOffset", &D::polygonOffset, "offset filled faces")
            .check(check)
            .declaration();
    }
};

} // namespace

StateDeclarations declareRasterStateElements(Registry& registry) {
    return {&ViewportElement::declare(registry),
            &DepthRangeElement::declare(registry),
            &ClipDistancesElement::declare(registry),
            &ClearElement::declare(registry),
            &PointElement::declare(registry),
            &LineElement::declare(registry),
            &PolygonElement::declare(registry, "polygon"),
            &PolygonElement::declare(registry, "cull")};
}

} // namespace terrane
