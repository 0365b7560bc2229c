// SPDX-License-Identifier: BSD-3-Clause
#include "render/mesh_resource.h"

#include "gl_archive.h"
#include "render/mesh.h"

namespace terrane {

namespace {

struct MeshFixture : GlArchive {
    MeshFixture() { declareMesh(registry); }
};

const std::string kPoint = "0 1 0 1 0 1 points 1 0 3 float false 1 0 0 0 0";

} // namespace

TEST_CASE_FIXTURE(MeshFixture, "A mesh is loaded by its element or by the name of its file") {
    writeFile(folder / "point.mesh", kPoint);
    const Mesh* mesh = load<Mesh>("<mesh name='p' source='point.mesh'/>", "p");
    REQUIRE(mesh);
    CHECK(mesh->mode() == PrimitiveMode::points);
    mesh = get<Mesh>("point.mesh");
    REQUIRE(mesh);
    CHECK(mesh->vertexCount() == 1);
    CHECK(mesh->boundsMax() == glm::dvec3(1));
    CHECK(told() == "");
}

TEST_CASE_FIXTURE(MeshFixture, "Built-in meshes are shadowed by files") {
    read("");
    const Mesh* mesh = get<Mesh>("quad.mesh");
    REQUIRE(mesh);
    CHECK(mesh->vertexCount() == 4);
    mesh = get<Mesh>("grid.mesh");
    REQUIRE(mesh);
    CHECK(mesh->vertexCount() == 625);

    writeFile(folder / "quad.mesh", kPoint);
    read("");
    mesh = get<Mesh>("quad.mesh");
    REQUIRE(mesh);
    CHECK(mesh->vertexCount() == 1);
}

TEST_CASE("Built-in meshes have their names") {
    CHECK(builtInMesh("grid25.mesh")->indices.size() == 24 * 24 * 6);
    CHECK(builtInMesh("grid2.mesh")->indices.size() == 6);
    CHECK(builtInMesh("grid25adjacency.mesh")->mode == PrimitiveMode::linesAdjacency);
    CHECK(builtInMesh("gridadjacency.mesh")->indices.size() == 24 * 24 * 4);
    CHECK(builtInMesh("gridskirt.mesh")->vertexCount == 27 * 27);
    CHECK(builtInMesh("grid3skirt.mesh")->vertexCount == 25);
    for (const char* name :
         {"grid1.mesh", "grid-3.mesh", "grid99999999999.mesh", "grids.mesh", "quad", "quads.mesh",
          ".mesh", "grid", "gri.mesh", "gridskirtadjacency.mesh", "gridadjacencyskirt.mesh",
          "grid1skirt.mesh"}) {
        CAPTURE(name);
        CHECK_FALSE(builtInMesh(name));
    }
}

TEST_CASE_FIXTURE(MeshFixture, "A damaged mesh file is told in the file") {
    writeFile(folder / "bad.mesh", "0 1 0 1 0 1\nsquares");
    read("");
    CHECK_FALSE(get<Mesh>("bad.mesh"));
    REQUIRE(diagnostics.all().size() == 1);
    const auto diagnostic = diagnostics.all()[0];
    CHECK(diagnostic.code == "mesh-syntax");
    CHECK(diagnostic.place.toString().find("bad.mesh:2:1") != std::string::npos);
    CHECK_FALSE(get<Mesh>("none.mesh"));
    CHECK(told() == "mesh-syntax 1, file-missing 15");
}

} // namespace terrane
