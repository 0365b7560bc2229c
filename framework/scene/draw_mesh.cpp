// SPDX-License-Identifier: BSD-3-Clause
#include "scene/draw_mesh.h"

#include "render/framebuffer.h"
#include "render/mesh.h"
#include "render/program.h"
#include "resource/registry.h"
#include "scene/bind_context.h"
#include "scene/scene_manager.h"

#include <algorithm>
#include <cstdint>

namespace terrane {

namespace {

// A hundred times what a frame can have: more would never end.
constexpr std::uint64_t kMostVertices = 1U << 30;

struct DrawMeshDescription : ElementDescription {
    Attr<Target> mesh;
    Attr<int> count = 1;
};

class DrawMeshTask : public FrameTask {
public:
    DrawMeshTask(Mesh& mesh, int count, const Place& place, SceneManager& scene)
        : FrameTask("DrawMesh")
        , mesh_(mesh)
        , count_(count)
        , place_(place)
        , scene_(scene) {}

    bool run() override {
        Program* const program = scene_.currentProgram(mesh_, place_);
        if (!program) return false;
        scene_.drawState().framebuffer->use();
        program->use();
        mesh_.draw(count_);
        return true;
    }

private:
    Mesh& mesh_;
    int count_;
    Place place_;
    SceneManager& scene_;
};

class DrawMesh : public SceneTask {
public:
    explicit DrawMesh(const DrawMeshDescription& d)
        : mesh_(d.mesh)
        , count_(d.count) {}
    std::unique_ptr<BoundTask> bind(BindContext& context) const override {
        Mesh* const mesh = findMesh(mesh_, context);
        if (!mesh || tooMuch(*mesh, context)) return nullptr;
        return makeStep<DrawMeshTask>(*mesh, count_, mesh_.place, context.scene());
    }

private:
    bool tooMuch(const Mesh& mesh, BindContext& context) const {
        const std::uint64_t vertices = mesh.indexed() ? mesh.indexCount() : mesh.vertexCount();
        if (vertices * std::uint64_t(std::max(0, *count_)) <= kMostVertices) return false;
        context.diagnostics().error(
            "too-many", count_.given ? count_.place : mesh_.place,
            std::to_string(*count_) + " times " + std::to_string(vertices) + " vertices",
            "at most " + std::to_string(kMostVertices) + " vertices a draw");
        return true;
    }

    Attr<Target> mesh_;
    Attr<int> count_;
};

} // namespace

Mesh* findMesh(const Attr<Target>& name, BindContext& context) {
    SceneNode* const node = context.nodeOf(name, ".mesh");
    if (!node) return context.resource<Mesh>(name->name + ".mesh", name.place).get();
    const auto mesh = node->meshes.find(name->name);
    if (mesh != node->meshes.end()) return mesh->second.get();
    context.reportMissing(name, *node, "mesh", node->meshes);
    return nullptr;
}

void declareDrawMesh(Registry& registry) {
    using D = DrawMeshDescription;
    registry.resource<DrawMesh, D, SceneTask>("drawMesh", "Draws a mesh with the current program.")
        .example(R"(<drawMesh name="this.rock" count="100"/>)")
        .attribute(
            "name", &D::mesh,
            "the mesh: by its key at a node, such as 'this.grid', or 'm' for the resource 'm.mesh'")
        .required()
        .attribute("count", &D::count, "number of instances")
        .atLeast(0)
        .atMost(1 << 20)
        .clamped()
        .build([](const D& d, BuildContext&) { return std::make_shared<DrawMesh>(d); });
}

} // namespace terrane
