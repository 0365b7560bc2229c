// SPDX-License-Identifier: BSD-3-Clause
#include "render/initial_uniform_elements.h"

#include "core/text.h"
#include "resource/registry.h"

#include <array>
#include <span>
#include <utility>

namespace terrane {

namespace {

struct VectorElement : ElementDescription {
    Attr<std::string> uniform;
    Attr<double> x = 0, y = 0, z = 0, w = 0;

    std::array<const Attr<double>*, 4> components() const { return {&x, &y, &z, &w}; }
};

struct MatrixElement : ElementDescription {
    Attr<std::string> uniform;
    Attr<std::string> value;
};

struct SamplerElement : ElementDescription {
    Attr<std::string> uniform;
    Ref<Texture> texture;
};

struct SubroutineElement : ElementDescription {
    Attr<std::string> uniform;
    Attr<std::string> subroutine;
    Attr<ShaderStage> stage = ShaderStage::fragment;
};

// Spelt as archives of the original do, and correctly.
const Words<ShaderStage> kStageWords{{"VERTEX", ShaderStage::vertex},
                                     {"TESSELATION_CONTROL", ShaderStage::tessControl},
                                     {"TESSELATION_EVALUATION", ShaderStage::tessEvaluation},
                                     {"GEOMETRY", ShaderStage::geometry},
                                     {"FRAGMENT", ShaderStage::fragment},
                                     {"TESSELLATION_CONTROL", ShaderStage::tessControl},
                                     {"TESSELLATION_EVALUATION", ShaderStage::tessEvaluation}};

bool isSize(char c, char least) {
    return c >= least && c <= '4';
}

// A tag's type, and what of the tag stands behind it.
struct TagType {
    const UniformType* type = nullptr;
    std::string_view rest;
};

// `uniform3f` and so on; null for a tag that is none of them. The original did not look at what
// comes after the letter.
TagType vectorTag(std::string_view tag) {
    tag.remove_prefix(std::string_view("uniform").size());
    if (tag.empty() || !isSize(tag[0], '1')) return {};
    const int rows = tag[0] - '0';
    constexpr std::array<std::pair<std::string_view, UniformKind>, 6> suffixes{
        {{"f", UniformKind::float32},
         {"d", UniformKind::float64},
         {"i", UniformKind::int32},
         {"b", UniformKind::boolean},
         {"vi", UniformKind::uint32},
         {"ui", UniformKind::uint32}}};
    for (const auto& [suffix, kind] : suffixes) {
        if (tag.substr(1).starts_with(suffix))
            return {findUniformType(kind, 1, rows), tag.substr(1 + suffix.size())};
    }
    return {};
}

const UniformType* vectorType(std::string_view tag) {
    return vectorTag(tag).type;
}

// `uniformMatrix3f`, `uniformMatrix2x4d`, also without the last letter, which means float, as any
// other ending does.
TagType matrixTag(std::string_view tag) {
    tag.remove_prefix(std::string_view("uniformMatrix").size());
    if (tag.empty() || !isSize(tag[0], '2')) return {};
    const int columns = tag[0] - '0';
    int rows = columns;
    tag.remove_prefix(1);
    if (tag.size() >= 2 && tag[0] == 'x' && isSize(tag[1], '2')) {
        rows = tag[1] - '0';
        tag.remove_prefix(2);
    }
    const bool letter = tag.starts_with('f') || tag.starts_with('d');
    const UniformKind kind = tag.starts_with('d') ? UniformKind::float64 : UniformKind::float32;
    return {findUniformType(kind, columns, rows), tag.substr(letter ? 1 : 0)};
}

const UniformType* matrixType(std::string_view tag) {
    return matrixTag(tag).type;
}

std::vector<std::string> matrixUniformTags() {
    std::vector<std::string> tags;
    for (const char columns : {'2', '3', '4'}) {
        for (const std::string rows : {"", "x2", "x3", "x4"}) {
            if (!rows.empty() && rows[1] == columns) continue; // as without its rows
            for (const char* letter : {"", "f", "d"})
                tags.push_back(std::string("uniformMatrix") + columns + rows + letter);
        }
    }
    return tags;
}

void warnOfRest(const ElementDescription& d, const TagType& tag, Diagnostics& diagnostics) {
    if (tag.rest.empty()) return;
    const std::string plain = d.tag.substr(0, d.tag.size() - tag.rest.size());
    diagnostics.report({.severity = Severity::warning,
                        .code = "unknown-element",
                        .place = d.place,
                        .message = "<" + d.tag + "> counts as <" + plain + ">",
                        .suggestion = plain});
}

void unknownTag(const ElementDescription& d, std::string expected, Diagnostics& diagnostics) {
    diagnostics.error("unknown-element", d.place, "there is no <" + d.tag + ">",
                      std::move(expected));
}

void checkVector(const VectorElement& d, Diagnostics& diagnostics) {
    const UniformType* const type = vectorType(d.tag);
    if (!type)
        return unknownTag(d,
                          "<uniform1f> to <uniform4f>, with 'd', 'i', 'b' or 'ui' for 'f', "
                          "<uniformMatrix...> or <uniformSampler>",
                          diagnostics);
    warnOfRest(d, vectorTag(d.tag), diagnostics);
}

// The numbers of a matrix, which are written row by row. Nothing, with a diagnostic, when they are
// too few.
std::optional<UniformValue> matrixValue(const MatrixElement& d, const UniformType& type,
                                        Diagnostics* diagnostics) {
    const auto fail = [&](std::size_t offset, std::string message, std::string expected) {
        if (diagnostics)
            diagnostics->error("bad-value", {d.value.place.file, d.value.place.offset + offset},
                               std::move(message), std::move(expected));
        return std::nullopt;
    };
    UniformValue value(type);
    const std::string& text = *d.value;
    if (text == "zero") return value;
    if (text == "identity") {
        if (type.columns != type.rows)
            return fail(0, "a " + std::string(type.name) + " has no identity",
                        "'zero', or numbers");
        for (int i = 0; i < type.columns; ++i)
            value.setComponent(i * type.rows + i, 1);
        return value;
    }
    const std::vector<std::string_view> pieces = split(text, ',');
    const auto count = static_cast<std::size_t>(type.components());
    const std::string expected =
        std::to_string(count) + " numbers row by row, 'identity' or 'zero'";
    std::size_t offset = 0;
    for (std::size_t i = 0; i < std::min(count, pieces.size()); ++i) {
        const auto number = parseReal(pieces[i]);
        if (!number || !isBlank(pieces[i].substr(number->length)))
            return fail(offset, "'" + std::string(pieces[i]) + "' is no number", expected);
        const int row = static_cast<int>(i) / type.columns;
        const int column = static_cast<int>(i) % type.columns;
        value.setComponent(column * type.rows + row, number->value);
        offset += pieces[i].size() + 1;
    }
    if (pieces.size() < count)
        return fail(
            0, "a " + std::string(type.name) + " of " + std::to_string(pieces.size()) + " numbers",
            expected);
    if (pieces.size() > count && diagnostics)
        diagnostics->warning("extra-values", {d.value.place.file, d.value.place.offset + offset},
                             "the numbers from here on have no effect", expected);
    return value;
}

void checkMatrix(const MatrixElement& d, Diagnostics& diagnostics) {
    if (const UniformType* const type = matrixType(d.tag)) {
        warnOfRest(d, matrixTag(d.tag), diagnostics);
        matrixValue(d, *type, &diagnostics);
    } else {
        unknownTag(d, "<uniformMatrix2f> to <uniformMatrix4d>, or <uniformMatrix2x3f> and so on",
                   diagnostics);
    }
}

std::optional<UniformValue> vectorValue(const VectorElement& d) {
    const UniformType* const type = vectorType(d.tag);
    if (!type) return std::nullopt;
    UniformValue value(*type);
    for (int i = 0; i < type->rows; ++i)
        value.setComponent(i, *d.components()[i]);
    return value;
}

InitialUniform named(const Attr<std::string>& name, UniformValue value) {
    return {.name = *name, .place = name.place, .value = value, .texture = {}};
}

const char* const kNameSummary =
    "the uniform, such as 'u', 'views[3]', 'fog.tint', or 'Block.member'";

std::vector<std::string> vectorTags(int rows) {
    std::vector<std::string> tags;
    for (const char* letter : {"f", "i", "ui", "vi", "b", "d"})
        tags.push_back("uniform" + std::to_string(rows) + letter);
    return tags;
}

// One declaration for each number of components, so that each has no more attributes than these.
const ElementDeclaration& declareVector(Registry& registry, const std::string& tag,
                                        std::vector<std::string> tags, int rows,
                                        const std::string& what) {
    using D = VectorElement;
    auto element = registry.element<D>(tag, "Initial value of a " + what +
                                                "; the letters say of which type, 'vi' as 'ui'.");
    element.prefix(std::move(tags)).attribute("name", &D::uniform, kNameSummary).required();
    struct Component {
        const char* name;
        Attr<double> D::*member;
        const char* summary;
    };
    const Component components[] = {{"x", &D::x, rows == 1 ? "the number" : "first component"},
                                    {"y", &D::y, "second component"},
                                    {"z", &D::z, "third component"},
                                    {"w", &D::w, "fourth component"}};
    for (const Component& c : std::span(components).first(static_cast<std::size_t>(rows)))
        element.attribute(c.name, c.member, c.summary).orInfinite();
    return element.check(checkVector).declaration();
}

} // namespace

std::vector<std::string> vectorUniformTags() {
    std::vector<std::string> tags;
    for (int rows = 1; rows <= 4; ++rows) {
        const std::vector<std::string> some = vectorTags(rows);
        tags.insert(tags.end(), some.begin(), some.end());
    }
    return tags;
}

std::vector<const ElementDeclaration*> declareInitialUniforms(Registry& registry) {
    const auto& matrix =
        registry
            .element<MatrixElement>("uniformMatrix",
                                    "Initial value of a matrix: uniformMatrixNX or "
                                    "uniformMatrixNxMX with N columns, M rows, and X = f or d.")
            .prefix(matrixUniformTags())
            .attribute("name", &MatrixElement::uniform, kNameSummary)
            .required()
            .attribute("value", &MatrixElement::value,
                       "its numbers row by row, or 'identity' or 'zero'")
            .required()
            .check(checkMatrix)
            .declaration();
    const auto& sampler =
        registry
            .element<SamplerElement>("uniformSampler", "The texture that a sampler starts with.")
            .attribute("name", &SamplerElement::uniform, kNameSummary)
            .required()
            .attribute("texture", &SamplerElement::texture, "the texture, or an image file")
            .live()
            .required()
            .declaration();
    const auto& subroutine =
        registry
            .element<SubroutineElement>("uniformSubroutine",
                                        "The subroutine that a subroutine uniform starts with.")
            .attribute("name", &SubroutineElement::uniform, "the subroutine uniform")
            .required()
            .attribute("subroutine", &SubroutineElement::subroutine, "the function")
            .required()
            .attribute("stage", &SubroutineElement::stage, "where the uniform is", kStageWords)
            .required()
            .declaration();
    std::vector<const ElementDeclaration*> all{&matrix, &sampler, &subroutine};
    all.push_back(&declareVector(registry, "uniform1", vectorTags(1), 1, "number"));
    for (int rows = 2; rows <= 4; ++rows) {
        const std::string count = std::to_string(rows);
        all.push_back(&declareVector(registry, "uniform" + count, vectorTags(rows), rows,
                                     "vector of " + count + " numbers"));
    }
    // What else starts so is told together with the tags that there are.
    all.push_back(&declareVector(registry, "uniform", {}, 4, "vector"));
    return all;
}

std::optional<InitialSubroutine> initialSubroutine(const Child& child) {
    const auto* const d = child.as<SubroutineElement>();
    if (!d) return std::nullopt;
    return InitialSubroutine{.uniform = *d->uniform,
                             .function = *d->subroutine,
                             .stage = d->stage,
                             .place = d->subroutine.place};
}

std::optional<InitialUniform> initialUniform(const Child& child) {
    if (const auto* sampler = child.as<SamplerElement>())
        return InitialUniform{.name = *sampler->uniform,
                              .place = sampler->uniform.place,
                              .value = {},
                              .texture = sampler->texture};
    std::optional<UniformValue> value;
    if (const auto* vector = child.as<VectorElement>()) {
        if ((value = vectorValue(*vector))) return named(vector->uniform, *value);
    }
    if (const auto* matrix = child.as<MatrixElement>()) {
        const UniformType* const type = matrixType(matrix->tag);
        if (type && (value = matrixValue(*matrix, *type, nullptr)))
            return named(matrix->uniform, *value);
    }
    return std::nullopt;
}

} // namespace terrane
