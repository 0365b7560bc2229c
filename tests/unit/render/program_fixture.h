// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gl_fixture.h"
#include "render/framebuffer.h"
#include "render/mesh.h"
#include "render/program.h"

#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace terrane {

/// Compiles modules and programs from texts, and draws with them into one pixel.
struct ProgramFixture : GlFixture {
    std::optional<ProgramBindings> bindings{std::in_place, *context};
    std::map<std::string, std::shared_ptr<const SourceFile>> files;

    ~ProgramFixture() { bindings.reset(); }

    std::shared_ptr<const SourceFile> file(const std::string& name, const std::string& text) {
        return files[name] = std::make_shared<const SourceFile>(name, text);
    }

    GlslFiles includes() {
        return {.find = [this](const std::string& name, const Place&) {
            const auto found = files.find(name);
            return found == files.end() ? nullptr : found->second;
        }};
    }

    /// A module of one file `name`.glsl.
    ModuleSource source(const std::string& name, const std::string& text, int version = 330) {
        const auto archive = file("archive.xml", "<archive>\n  <module name='m'/>\n</archive>");
        return {.name = name,
                .place = {archive, 12},
                .version = version,
                .versionPlace = {archive, 12},
                .optionsPlace = {archive, 12},
                .file = file(name + ".glsl", text),
                .includes = includes()};
    }
    /// A module with a fragment stage only.
    ModuleSource fragment(const std::string& text, int version = 330) {
        ModuleSource module = source("fragment", "", version);
        module.file = nullptr;
        module.stageFiles[std::size_t(ShaderStage::fragment)] = file("fragment.glsl", text);
        return module;
    }

    std::shared_ptr<Module> compile(ModuleSource source) {
        return Module::compile(*context, std::move(source), diagnostics);
    }
    std::shared_ptr<Program> link(std::vector<std::shared_ptr<Module>> modules) {
        ProgramSource source{.name = "p;", .modules = std::move(modules)};
        source.place = {files["archive.xml"], 0};
        return Program::link(*bindings, std::move(source), diagnostics);
    }
    std::shared_ptr<Program> link(ModuleSource source) {
        auto module = compile(std::move(source));
        return module ? link(std::vector{std::move(module)}) : nullptr;
    }
    /// A program whose fragment shader has these declarations and writes this vec4.
    std::shared_ptr<Program> shows(const std::string& declarations, const std::string& colour,
                                   int version = 330) {
        return link(fragment(declarations +
                                 "\nlayout(location = 0) out vec4 c;\nvoid main() { c = " + colour +
                                 "; }\n",
                             version));
    }

    /// Draws over one pixel of floats and reads it.
    glm::vec4 draw(Program& program) {
        const auto texture = std::make_shared<Texture>(
            *context, TextureDescription{.format = InternalFormat::rgba32f});
        Framebuffer target(*context);
        target.attach(AttachmentPoint::colour0, {texture});
        target.setDrawBuffers({AttachmentPoint::colour0});
        target.setReadBuffer(AttachmentPoint::colour0);
        target.state.viewport = {0, 0, 1, 1};
        target.use();
        const Mesh quad(*context, makeQuadMesh());
        program.use();
        quad.draw();
        const auto bytes = target.readPixels(0, 0, 1, 1, {TransferFormat::rgba, TransferType::f32});
        glm::vec4 pixel;
        std::memcpy(&pixel, bytes.data(), sizeof pixel);
        return pixel;
    }

    /// One line for each diagnostic; they are taken out.
    std::string told() {
        std::string text;
        for (const Diagnostic& d : diagnostics.all())
            text += d.place.toString() + " " + d.code + "\n";
        diagnostics.clear();
        return text;
    }
};

} // namespace terrane
