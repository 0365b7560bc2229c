// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/gl_fixture.h"
#include "render/mesh_resource.h"
#include "render/module_resource.h"
#include "render/program_bindings.h"
#include "render/program_resource.h"
#include "render/render_target.h"
#include "render/texture_resource.h"
#include "resource/manager.h"
#include "scene/control_tasks.h"
#include "scene/draw_mesh.h"
#include "scene/scene_manager.h"
#include "scene/scene_node.h"
#include "scene/set_program.h"
#include "scene/set_state.h"
#include "scene/set_target.h"
#include "scene/set_transforms.h"
#include "task/multithread_scheduler.h"
#include "temporary_folder.h"

#include <array>
#include <memory>
#include <string>

namespace terrane {

/// A scene loaded from the text of an archive and drawn into a small picture.
struct SceneFixture {
    static constexpr int kSize = 16;

    Diagnostics diagnostics;
    std::unique_ptr<GlContext> context = createHeadlessContext(diagnostics, {.debug = true});
    Registry registry;
    test::TemporaryFolder folder;
    std::unique_ptr<Library> library;
    std::unique_ptr<ProgramBindings> bindings;
    std::unique_ptr<RenderTarget> target;
    std::unique_ptr<ResourceManager> resources;
    std::unique_ptr<SceneManager> scene;
    std::unique_ptr<Scheduler> scheduler;

    SceneFixture() {
        REQUIRE(context);
        context->makeCurrent();
        declareTextures(registry);
        declareMesh(registry);
        declareModule(registry);
        declareProgram(registry);
        declareSceneNode(registry);
        declareControlTasks(registry);
        declareDrawMesh(registry);
        declareSetProgram(registry);
        declareSetState(registry);
        declareSetTarget(registry);
        declareSetTransforms(registry);
    }
    ~SceneFixture() {
        scene.reset();
        resources.reset();
    }

    void write(const std::string& name, const std::string& text) const { folder.file(name, text); }

    /// Loads the entries of an archive and makes its node "scene" the root.
    void load(const std::string& entries) {
        write("archive.xml", "<archive>\n" + entries + "\n</archive>\n");
        SearchPath path;
        path.add(folder.path());
        library = std::make_unique<Library>(path, diagnostics);
        REQUIRE(library->addArchive(folder / "archive.xml"));
        resources = std::make_unique<ResourceManager>(registry, *library, diagnostics);
        bindings = std::make_unique<ProgramBindings>(*context);
        resources->services().provide(*context);
        resources->services().provide(*bindings);
        target = std::make_unique<RenderTarget>(*context, kSize, kSize);
        target->framebuffer().state.depth.enabled = true;
        scene = std::make_unique<SceneManager>(*resources, *context, target->framebuffer());
        scheduler = std::make_unique<MultithreadScheduler>(MultithreadScheduler::Options{});
        scene->setScheduler(*scheduler);
        scene->setRoot(resources->get<SceneNode>("scene"));
    }

    /// Draws one frame on black.
    bool draw() {
        target->framebuffer().state.clear.colour = {0, 0, 0, 1};
        target->framebuffer().clear(Planes::all);
        scene->update(1000, 10);
        return scene->draw();
    }

    using Colour = std::array<int, 3>;
    Colour pixel(int x = kSize / 2, int y = kSize / 2) const {
        const Image image = target->capture();
        const auto* p = image.bytes.data() + 4 * (y * image.width + x);
        return {int(p[0]), int(p[1]), int(p[2])};
    }

    /// The diagnostics as "code line:column", in order.
    std::vector<std::string> codes() const {
        std::vector<std::string> result;
        for (const Diagnostic& d : diagnostics.all()) {
            const LineColumn at = d.place.position();
            result.push_back(d.code + " " + std::to_string(at.line) + ":" +
                             std::to_string(at.column));
        }
        return result;
    }
    void checkNoDiagnostics() const {
        for (const Diagnostic& d : diagnostics.all())
            FAIL_CHECK(toString(d));
    }
};

} // namespace terrane
