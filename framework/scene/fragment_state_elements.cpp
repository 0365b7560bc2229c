// SPDX-License-Identifier: BSD-3-Clause
#include "scene/state_elements.h"

#include "scene/state_words.h"

#include <algorithm>

namespace terrane {

namespace {

struct DepthElement : StateElement {
    Attr<bool> enable = false;
    Attr<CompareFunction> value = CompareFunction::less;
    void apply(PipelineState& s) const override {
        s.depth.enabled = enable;
        if (value.given) s.depth.function = value;
    }
    static const ElementDeclaration& declare(Registry& registry) {
        using D = DepthElement;
        return registry.element<D>("depth", "The depth test.")
            .attribute("enable", &D::enable, "whether there is a depth test")
            .attribute("value", &D::value, "what passes", kCompareWords)
            .declaration();
    }
};

struct StencilElement : StateElement {
    Attr<bool> enable = false;
    Attr<CompareFunction> ffunction = CompareFunction::always;
    Attr<int> fref = 0, fmask = -1;
    Attr<StencilOperation> ffail = StencilOperation::keep, fdpfail = StencilOperation::keep,
                           fdppass = StencilOperation::keep;
    Attr<CompareFunction> bfunction = CompareFunction::always;
    Attr<int> bref = 0, bmask = -1;
    Attr<StencilOperation> bfail = StencilOperation::keep, bdpfail = StencilOperation::keep,
                           bdppass = StencilOperation::keep;

    void apply(PipelineState& s) const override {
        s.stencil.enabled = enable;
        if (!ffunction.given) return;
        s.stencil.front = {ffunction, fref, static_cast<unsigned>(*fmask), ffail, fdpfail, fdppass};
        s.stencil.back = s.stencil.front;
        if (bfunction.given)
            s.stencil.back = {bfunction, bref,    static_cast<unsigned>(*bmask),
                              bfail,     bdpfail, bdppass};
    }

    static void check(const StencilElement& d, Diagnostics& diagnostics) {
        together(d, d.ffunction, "ffunction", d.fref, "fref", diagnostics);
        together(d, d.ffunction, "ffunction", d.fmask, "fmask", diagnostics);
        together(d, d.ffunction, "ffunction", d.ffail, "ffail", diagnostics);
        together(d, d.ffunction, "ffunction", d.fdpfail, "fdpfail", diagnostics);
        together(d, d.ffunction, "ffunction", d.fdppass, "fdppass", diagnostics);
        together(d, d.bfunction, "bfunction", d.ffunction, "ffunction", diagnostics);
        together(d, d.bfunction, "bfunction", d.bref, "bref", diagnostics);
        together(d, d.bfunction, "bfunction", d.bmask, "bmask", diagnostics);
        together(d, d.bfunction, "bfunction", d.bfail, "bfail", diagnostics);
        together(d, d.bfunction, "bfunction", d.bdpfail, "bdpfail", diagnostics);
        together(d, d.bfunction, "bfunction", d.bdppass, "bdppass", diagnostics);
    }

    static const ElementDeclaration& declare(Registry& registry) {
        using D = StencilElement;
        const auto& operation = kStencilOperationWords;
        return registry.element<D>("stencil", "The stencil test. Without a back group, both faces.")
            .attribute("enable", &D::enable, "whether there is a stencil test")
            .attribute("ffunction", &D::ffunction, "front: what passes", kCompareWords)
            .attribute("fref", &D::fref, "front: reference value")
            .attribute("fmask", &D::fmask, "front: bits that are compared")
            .bits()
            .attribute("ffail", &D::ffail, "front: when the stencil test fails", operation)
            .attribute("fdpfail", &D::fdpfail, "front: when the depth test fails", operation)
            .attribute("fdppass", &D::fdppass, "front: when both pass", operation)
            .attribute("bfunction", &D::bfunction, "back: what passes", kCompareWords)
            .attribute("bref", &D::bref, "back: reference value")
            .attribute("bmask", &D::bmask, "back: bits that are compared")
            .bits()
            .attribute("bfail", &D::bfail, "back: when the stencil test fails", operation)
            .attribute("bdpfail", &D::bdpfail, "back: when the depth test fails", operation)
            .attribute("bdppass", &D::bdppass, "back: when both pass", operation)
            .check(check)
            .declaration();
    }
};

// Which colour buffers a child concerns; all of them without an attribute `buffer`.
enum class ColourBuffer { colour0, colour1, colour2, colour3, colour4, colour5, colour6, colour7 };
const Words<ColourBuffer> kColourBufferWords{
    {"COLOR0", ColourBuffer::colour0}, {"COLOR1", ColourBuffer::colour1},
    {"COLOR2", ColourBuffer::colour2}, {"COLOR3", ColourBuffer::colour3},
    {"COLOR4", ColourBuffer::colour4}, {"COLOR5", ColourBuffer::colour5},
    {"COLOR6", ColourBuffer::colour6}, {"COLOR7", ColourBuffer::colour7}};

bool concerns(const Attr<std::vector<ColourBuffer>>& buffers, int index) {
    const auto buffer = static_cast<ColourBuffer>(index);
    return !buffers.given || std::find(buffers->begin(), buffers->end(), buffer) != buffers->end();
}

struct BlendElement : StateElement {
    Attr<std::vector<ColourBuffer>> buffer;
    Attr<bool> enable = false;
    Attr<BlendEquation> eq = BlendEquation::add, alphaeq = BlendEquation::add;
    Attr<BlendFactor> src = BlendFactor::one, dst = BlendFactor::zero;
    Attr<BlendFactor> alphasrc = BlendFactor::one, alphadst = BlendFactor::zero;
    Attr<float> r = 0, g = 0, b = 0, a = 0;

    void apply(PipelineState& s) const override {
        for (int i = 0; i < kMaxColourBuffers; ++i) {
            if (concerns(buffer, i)) applyTo(s.blend[i]);
        }
        if (r.given) s.blendColour = {*r, *g, *b, *a};
    }

    // Without any attribute blending is off.
    void applyTo(PipelineState::Blend& blend) const {
        blend.enabled = enable;
        if (!eq.given) return;
        blend.equation = blend.alphaEquation = eq;
        blend.source = blend.alphaSource = src;
        blend.destination = blend.alphaDestination = dst;
        if (!alphaeq.given) return;
        blend.alphaEquation = alphaeq;
        blend.alphaSource = alphasrc;
        blend.alphaDestination = alphadst;
    }

    static void check(const BlendElement& d, Diagnostics& diagnostics) {
        together(d, d.eq, "eq", d.src, "src", diagnostics);
        together(d, d.eq, "eq", d.dst, "dst", diagnostics);
        together(d, d.alphaeq, "alphaeq", d.alphasrc, "alphasrc", diagnostics);
        together(d, d.alphaeq, "alphaeq", d.alphadst, "alphadst", diagnostics);
        alsoGiven(d, d.r, "r", d.g, "g", diagnostics);
        alsoGiven(d, d.r, "r", d.b, "b", diagnostics);
        alsoGiven(d, d.r, "r", d.a, "a", diagnostics);
    }

    static const ElementDeclaration& declare(Registry& registry) {
        using D = BlendElement;
        return registry.element<D>("blend", "Blending; off without attributes.")
            .attribute("buffer", &D::buffer, "the buffers meant; all by default",
                       kColourBufferWords)
            .attribute("enable", &D::enable, "whether colours are blended")
            .attribute("eq", &D::eq, "how the two terms are combined", kBlendEquationWords)
            .attribute("src", &D::src, "factor of the new colour", kBlendFactorWords)
            .attribute("dst", &D::dst, "factor of the old colour", kBlendFactorWords)
            .attribute("alphaeq", &D::alphaeq, "the same for alpha", kBlendEquationWords)
            .attribute("alphasrc", &D::alphasrc, "factor of the new alpha", kBlendFactorWords)
            .attribute("alphadst", &D::alphadst, "factor of the old alpha", kBlendFactorWords)
            .attribute("r", &D::r, "blend colour: red")
            .attribute("g", &D::g, "blend colour: green")
            .attribute("b", &D::b, "blend colour: blue")
            .attribute("a", &D::a, "blend colour: alpha")
            .check(check)
            .declaration();
    }
};

struct LogicElement : StateElement {
    Attr<bool> enable = false;
    Attr<LogicOperation> value = LogicOperation::copy;
    void apply(PipelineState& s) const override {
        s.logic.enabled = enable;
        if (value.given) s.logic.operation = value;
    }
    static const ElementDeclaration& declare(Registry& registry) {
        using D = LogicElement;
        return registry.element<D>("logic", "Logical operation between new and old colours.")
            .attribute("enable", &D::enable, "whether there is a logical operation")
            .attribute("value", &D::value, "the operation", kLogicWords)
            .declaration();
    }
};

struct ScissorElement : StateElement {
    Attr<bool> enable = false;
    Attr<int> x = 0, y = 0, width = 0, height = 0;
    void apply(PipelineState& s) const override {
        s.scissor.enabled = enable;
        if (x.given) s.scissor.rectangle = {x, y, width, height};
    }
    static void check(const ScissorElement& d, Diagnostics& diagnostics) {
        together(d, d.x, "x", d.y, "y", diagnostics);
        together(d, d.x, "x", d.width, "width", diagnostics);
        together(d, d.x, "x", d.height, "height", diagnostics);
    }
    static const ElementDeclaration& declare(Registry& registry) {
        using D = ScissorElement;
        return registry.element<D>("scissor", "The scissor test.")
            .attribute("enable", &D::enable,
                       "whether there is a scissor test: only what is in the rectangle is drawn")
            .attribute("x", &D::x, "left side")
            .unit("pixels")
            .attribute("y", &D::y, "bottom")
            .unit("pixels")
            .attribute("width", &D::width, "width")
            .atLeast(0)
            .unit("pixels")
            .attribute("height", &D::height, "height")
            .atLeast(0)
            .unit("pixels")
            .check(check)
            .declaration();
    }
};

struct WriteElement : StateElement {
    Attr<std::vector<ColourBuffer>> buffer;
    Attr<bool> r = true, g = true, b = true, a = true;
    Attr<bool> d = true;
    Attr<int> fs = -1, bs = -1;

    void apply(PipelineState& s) const override {
        if (r.given) {
            for (int i = 0; i < kMaxColourBuffers; ++i) {
                if (concerns(buffer, i)) s.write.colour[i] = {r, g, b, a};
            }
        }
        if (d.given) s.write.depth = d;
        if (!fs.given) return;
        s.write.stencilFront = static_cast<unsigned>(*fs);
        s.write.stencilBack = static_cast<unsigned>(*bs);
    }
    static void check(const WriteElement& e, Diagnostics& diagnostics) {
        together(e, e.r, "r", e.g, "g", diagnostics);
        together(e, e.r, "r", e.b, "b", diagnostics);
        together(e, e.r, "r", e.a, "a", diagnostics);
        together(e, e.fs, "fs", e.bs, "bs", diagnostics);
    }
    static const ElementDeclaration& declare(Registry& registry) {
        using D = WriteElement;
        return registry.element<D>("write", "What may be written.")
            .attribute("buffer", &D::buffer, "the buffers meant; all by default",
                       kColourBufferWords)
            .attribute("r", &D::r, "red")
            .attribute("g", &D::g, "green")
            .attribute("b", &D::b, "blue")
            .attribute("a", &D::a, "alpha")
            .attribute("d", &D::d, "depth")
            .attribute("fs", &D::fs, "stencil bits of front faces")
            .bits()
            .attribute("bs", &D::bs, "stencil bits of back faces")
            .bits()
            .check(check)
            .declaration();
    }
};

struct MultisamplingElement : StateElement {
    Attr<bool> enable = true, alphaToCoverage = false, alphaToOne = false;
    Attr<float> coverage = 1;
    Attr<int> mask = -1;
    Attr<bool> shading = false;
    Attr<float> min = 0;

    void apply(PipelineState& s) const override {
        s.multisampling.enabled = enable;
        if (alphaToCoverage.given) {
            s.multisampling.alphaToCoverage = alphaToCoverage;
            s.multisampling.alphaToOne = alphaToOne;
        }
        if (coverage.given) s.multisampling.coverage = coverage;
        if (mask.given) s.multisampling.mask = static_cast<unsigned>(*mask);
        if (!shading.given) return;
        s.multisampling.sampleShading = shading;
        s.multisampling.minimumShading = min;
    }
    static void check(const MultisamplingElement& d, Diagnostics& diagnostics) {
        together(d, d.alphaToCoverage, "alphaToCoverage", d.alphaToOne, "alphaToOne", diagnostics);
        alsoGiven(d, d.shading, "shading", d.min, "min", diagnostics);
    }
    static const ElementDeclaration& declare(Registry& registry) {
        using D = MultisamplingElement;
        return registry.element<D>("multisampling", "Multisampling.")
            .attribute("enable", &D::enable, "whether samples differ")
            .attribute("alphaToCoverage", &D::alphaToCoverage, "alpha masks samples")
            .attribute("alphaToOne", &D::alphaToOne, "alpha is then set to 1")
            .attribute("coverage", &D::coverage, "share of samples kept; negative: the complement")
            .atLeast(-1)
            .atMost(1)
            .clamped()
            .attribute("mask", &D::mask, "bits of the samples kept")
            .bits()
            .attribute("shading", &D::shading, "shade samples, not pixels")
            .attribute("min", &D::min, "least share of samples shaded")
            .atLeast(0)
            .atMost(1)
            .clamped()
            .check(check)
            .declaration();
    }
};

/// Conditional rendering on a query that nothing ran: accepted, without effect.
struct OcclusionElement : StateElement {
    enum class Query { primitives, feedback, samples, anySamples, time };
    enum class Mode { wait, noWait, regionWait, regionNoWait };
    inline static const Words<Query> queryWords{
        {"SAMPLES_PASSED", Query::samples},
        {"ANY_SAMPLES_PASSED", Query::anySamples},
        {"PRIMITIVES_GENERATED", Query::primitives},
        {"TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN", Query::feedback},
        {"TIME_STAMP", Query::time}};
    inline static const Words<Mode> modeWords{{"WAIT", Mode::wait},
                                              {"NO_WAIT", Mode::noWait},
                                              {"REGION_WAIT", Mode::regionWait},
                                              {"REGION_NO_WAIT", Mode::regionNoWait}};

    Attr<Query> query = Query::samples;
    Attr<Mode> mode = Mode::wait;
    void apply(PipelineState&) const override {}
    static void check(const OcclusionElement& d, Diagnostics& diagnostics) {
        if (*d.query == Query::samples || *d.query == Query::anySamples) return;
        diagnostics.warning("unused-attribute", d.query.place,
                            "no drawing can depend on such a query",
                            "'SAMPLES_PASSED' or 'ANY_SAMPLES_PASSED'");
    }
    static const ElementDeclaration& declare(Registry& registry) {
        using D = OcclusionElement;
        return registry.element<D>("occlusion", "Accepted; an archive has no queries to wait for.")
            .attribute("query", &D::query, "kind of query", queryWords)
            .required()
            .attribute("mode", &D::mode, "whether to wait", modeWords)
            .required()
            .check(check)
            .declaration();
    }
};

} // namespace

StateDeclarations declareFragmentStateElements(Registry& registry) {
    return {&DepthElement::declare(registry),         &StencilElement::declare(registry),
            &BlendElement::declare(registry),         &LogicElement::declare(registry),
            &ScissorElement::declare(registry),       &WriteElement::declare(registry),
            &MultisamplingElement::declare(registry), &OcclusionElement::declare(registry)};
}

} // namespace terrane
