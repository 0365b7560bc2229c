// SPDX-License-Identifier: BSD-3-Clause
#include "render/mesh_resource.h"

#include "core/text.h"
#include "render/mesh.h"
#include "render/mesh_file.h"
#include "resource/build_context.h"
#include "resource/manager.h"
#include "resource/prepared_data.h"
#include "resource/registry.h"

#include <algorithm>

namespace terrane {

namespace {

// One more than the default `gridSize` of elevation producers (terrain reference 1.7).
constexpr int kUsualVertices = 25;
constexpr int kMostVertices = 1025;

struct MeshElement : ElementDescription {
    Attr<DataFile> source;
};

// A misspelt name may be that of a file, or of a mesh that needs none, with as many vertices.
void reportMissing(const std::string& name, const Place& place, const SearchPath& path,
                   Diagnostics& diagnostics) {
    const std::size_t begin = std::min(name.find_first_of("0123456789"), name.size());
    const std::size_t end = name.find_first_not_of("0123456789", begin);
    const std::string vertices = name.substr(begin, end - begin);
    std::vector<std::string> known = path.namesNear(name);
    known.emplace_back("quad.mesh");
    for (const char* kind : {"", "skirt", "adjacency"})
        known.push_back("grid" + vertices + kind + ".mesh");
    diagnostics.report({.code = "file-missing",
                        .place = place,
                        .message = "there is no file " + inQuotes(name),
                        .expected = "a file in the archive's folder or in a --path, or a mesh of "
                                    "ours such as 'grid.mesh'",
                        .suggestion = nearestName(name, known)});
}

std::optional<MeshData> load(const MeshElement& d, BuildContext& context) {
    const std::string& name = d.source->name;
    const SearchPath& path = context.manager().library().searchPath();
    if (!path.find(name)) {
        if (auto mesh = builtInMesh(name)) {
            context.addMissingFile(name);
            return mesh;
        }
        if (!SearchPath::leavesFolders(name) && !preparingScript(path, name)) {
            reportMissing(name, d.source.place, path, context.diagnostics());
            return std::nullopt;
        }
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
    constexpr std::string_view prefix = "grid", suffix = ".mesh", lines = "adjacency",
                               skirt = "skirt";
    if (!name.starts_with(prefix) || !name.ends_with(suffix)) return std::nullopt;
    name.remove_prefix(prefix.size());
    name.remove_suffix(suffix.size());
    const bool skirted = name.ends_with(skirt);
    if (skirted) name.remove_suffix(skirt.size());
    const bool adjacency = !skirted && name.ends_with(lines);
    if (adjacency) name.remove_suffix(lines.size());
    int side = kUsualVertices;
    if (!name.empty()) {
        if (name.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
        const auto vertices = parseInt(name);
        if (!vertices || vertices->value < 2 || vertices->value > kMostVertices)
            return std::nullopt;
        side = vertices->value;
    }
    if (skirted) return makeSkirtedGridMesh(side - 1);
    return makeGridMesh(side - 1,
                        adjacency ? PrimitiveMode::linesAdjacency : PrimitiveMode::triangles);
}

void declareMesh(Registry& registry) {
    using D = MeshElement;
    registry
        .resource<Mesh, D>(
            "mesh",
            "Vertices, and how they are drawn. A file is one by its name alone: 'rock.mesh'.")
        .example(R"(<mesh name="ground" source="grid40skirt.mesh"/>)")
        .attribute(
            "source", &D::source,
            "the .mesh file; 'quad.mesh' is built in, and so are 'grid.mesh' of 25 x 25 vertices, "
            "others such as 'grid40.mesh', and 'gridskirt.mesh', which hides cracks")
        .required()
        .lenient()
        .build(build);
    registry.nameInterface<Mesh>("mesh");
}

} // namespace terrane
