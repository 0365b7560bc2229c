// SPDX-License-Identifier: BSD-3-Clause
#include "render/mesh_resource.h"

#include "core/text.h"
#include "render/mesh.h"
#include "render/mesh_file.h"
#include "resource/build_context.h"
#include "resource/manager.h"
#include "resource/registry.h"

namespace terrane {

namespace {

// One more than the default `gridSize` of elevation producers (terrain reference 1.7).
constexpr int kUsualVertices = 25;
constexpr int kMostVertices = 1025;

struct MeshElement : ElementDescription {
    Attr<DataFile> source;
};

std::optional<MeshData> load(const MeshElement& d, BuildContext& context) {
    const std::string& name = d.source->name;
    if (!context.manager().library().searchPath().find(name)) {
        if (auto mesh = builtInMesh(name)) return mesh;
    }
    auto file = context.readSource(name, d.source.place);
    if (!file) return std::nullopt;
    return parseMesh(std::move(file), context.diagnostics());
}

std::shared_ptr<Mesh> build(const MeshElement& d, BuildContext& context) {
    const auto mesh = load(d, context);
    if (!mesh) return nullptr;
    return std::make_shared<Mesh>(context.service<GlContext>(), *mesh);
}

} // namespace

std::optional<MeshData> builtInMesh(std::string_view name) {
    if (name == "quad.mesh") return makeQuadMesh();
    constexpr std::string_view prefix = "grid", suffix = ".mesh", lines = "adjacency";
    if (!name.starts_with(prefix) || !name.ends_with(suffix)) return std::nullopt;
    name.remove_prefix(prefix.size());
    name.remove_suffix(suffix.size());
    auto mode = PrimitiveMode::triangles;
    if (name.ends_with(lines)) {
        mode = PrimitiveMode::linesAdjacency;
        name.remove_suffix(lines.size());
    }
    if (name.empty()) return makeGridMesh(kUsualVertices - 1, mode);
    if (name.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
    const auto vertices = parseInt(name);
    if (!vertices || vertices->value < 2 || vertices->value > kMostVertices) return std::nullopt;
    return makeGridMesh(vertices->value - 1, mode);
}

void declareMesh(Registry& registry) {
    using D = MeshElement;
    registry.resource<Mesh, D>("mesh", "Vertices, and how they are drawn.")
        .attribute("source", &D::source, "the .mesh file")
        .required()
        .lenient()
        .build(build);
    registry.nameInterface<Mesh>("mesh");
}

} // namespace terrane
