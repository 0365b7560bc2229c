// SPDX-License-Identifier: BSD-3-Clause
#include "render/program.h"

#include "core/text.h"
#include "render/glsl_log.h"
#include "render/state_tracker.h"
#include "render/uniform_transfer.h"
#include "resource/entry.h"

#include <glad/gl.h>

#include <algorithm>
#include <utility>

namespace terrane {

Program::Program(ProgramBindings& bindings, ProgramSource source)
    : bindings_(bindings)
    , source_(std::move(source))
    , name_(bindings.context.gl().CreateProgram()) {
    bindings_.context.countObject(1);
    for (const auto& module : source_.modules)
        module->programs_.push_back(this);
}

Program::~Program() {
    for (const auto& module : source_.modules)
        std::erase(module->programs_, this);
    if (name_ == 0) return;
    bindings_.context.state().forgetProgram(name_);
    bindings_.context.gl().DeleteProgram(name_);
    bindings_.context.countObject(-1);
}

std::shared_ptr<Program> Program::start(ProgramBindings& bindings, ProgramSource source,
                                        Diagnostics& diagnostics) {
    std::shared_ptr<Program> program(new Program(bindings, std::move(source)));
    if (program->loadBinary(diagnostics)) return program;
    if (!program->attach(diagnostics) || !program->collectFeedback(diagnostics)) return nullptr;
    bindings.context.gl().LinkProgram(program->name_);
    return program;
}

std::shared_ptr<Program> Program::link(ProgramBindings& bindings, ProgramSource source,
                                       Diagnostics& diagnostics) {
    auto program = start(bindings, std::move(source), diagnostics);
    return program && program->finish(diagnostics) ? program : nullptr;
}

bool Program::loadBinary(Diagnostics& diagnostics) {
    if (!source_.binary) return false;
    const ProgramBinary& binary = *source_.binary;
    const auto& gl = bindings_.context.gl();
    GLint count = 0;
    gl.GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &count);
    std::vector<GLint> formats(static_cast<std::size_t>(std::max(count, 0)));
    if (count > 0) gl.GetIntegerv(GL_PROGRAM_BINARY_FORMATS, formats.data());
    GLint good = 0;
    // Another format would be an error of OpenGL's.
    if (std::find(formats.begin(), formats.end(), GLint(binary.format)) != formats.end()) {
        gl.ProgramBinary(name_, binary.format, binary.bytes.data(), GLsizei(binary.bytes.size()));
        gl.GetProgramiv(name_, GL_LINK_STATUS, &good);
    }
    fromBinary_ = good != 0;
    if (!fromBinary_) {
        diagnostics.warning("program-binary", source_.place,
                            "the driver does not take the binary of program '" + source_.name +
                                "'; its modules are linked instead",
                            "a binary that this driver made, or none");
    }
    return fromBinary_;
}

std::optional<ProgramBinary> Program::binary() const {
    const auto& gl = bindings_.context.gl();
    GLint length = 0;
    gl.GetProgramiv(name_, GL_PROGRAM_BINARY_LENGTH, &length);
    if (length <= 0) return std::nullopt;
    ProgramBinary result{.format = 0, .bytes = std::string(std::size_t(length), '\0')};
    GLsizei written = 0;
    gl.GetProgramBinary(name_, length, &written, &result.format, result.bytes.data());
    if (written <= 0) return std::nullopt;
    result.bytes.resize(std::size_t(written));
    return result;
}

bool Program::hasStage(ShaderStage stage) const {
    return std::any_of(source_.modules.begin(), source_.modules.end(),
                       [&](const auto& module) { return module->hasStage(stage); });
}

bool Program::attach(Diagnostics& diagnostics) {
    const auto& gl = bindings_.context.gl();
    bool empty = true;
    bool vertex = false;
    for (const auto& module : source_.modules) {
        for (const ShaderObject& shader : module->shaders()) {
            gl.AttachShader(name_, shader.name());
            empty = false;
            vertex = vertex || shader.stage() == ShaderStage::vertex;
        }
    }
    if (empty) {
        diagnostics.error("glsl-link", source_.place,
                          "program '" + source_.name + "' has no stage at all");
        return false;
    }
    if (source_.separable) gl.ProgramParameteri(name_, GL_PROGRAM_SEPARABLE, GL_TRUE);
    if (!vertex && !source_.separable) gl.AttachShader(name_, bindings_.passThroughVertex().name());
    return true;
}

bool Program::collectFeedback(Diagnostics& diagnostics) {
    std::vector<const char*> varyings;
    const Feedback* first = nullptr;
    for (const auto& module : source_.modules) {
        const auto& feedback = module->feedback();
        if (!feedback) continue;
        if (first && first->mode != feedback->mode) {
            diagnostics.error("feedback-modes", feedback->place,
                              "the modules of program '" + source_.name +
                                  "' do not agree on the feedback mode",
                              "all interleaved, or all separate");
            return false;
        }
        if (!first) first = &*feedback;
        for (const std::string& varying : feedback->varyings)
            varyings.push_back(varying.c_str());
    }
    if (!first) return true;
    bindings_.context.gl().TransformFeedbackVaryings(
        name_, static_cast<GLsizei>(varyings.size()), varyings.data(),
        first->mode == FeedbackMode::interleaved ? GL_INTERLEAVED_ATTRIBS : GL_SEPARATE_ATTRIBS);
    return true;
}

bool Program::finish(Diagnostics& diagnostics) {
    if (finished_) return good_;
    finished_ = true;
    good_ = true;
    for (const auto& module : source_.modules)
        good_ = module->finish(diagnostics) && good_;
    // A module that failed has said why; the linker's complaint adds nothing.
    if (!good_ || !readStatus(diagnostics)) return good_ = false;
    readInterface();
    applyInitialValues(diagnostics);
    return true;
}

std::vector<const GlslText*> Program::texts() const {
    std::vector<const GlslText*> result;
    for (const auto& module : source_.modules) {
        for (const ShaderObject& shader : module->shaders()) {
            if (const GlslText* text = module->text(shader.stage())) result.push_back(text);
        }
    }
    return result;
}

bool Program::readStatus(Diagnostics& diagnostics) {
    const auto& gl = bindings_.context.gl();
    GLint good = 0;
    GLint length = 0;
    gl.GetProgramiv(name_, GL_LINK_STATUS, &good);
    gl.GetProgramiv(name_, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    gl.GetProgramInfoLog(name_, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    if (fromBinary_) return good != 0;
    reportLinkLog(log, good == 0, source_.place, source_.name, texts(), diagnostics);
    for (const auto& module : source_.modules) {
        for (const ShaderObject& shader : module->shaders())
            gl.DetachShader(name_, shader.name());
    }
    return good != 0;
}

bool Program::canDraw(PrimitiveMode mode) const {
    if (fromBinary_) return true; // whose stages only the driver knows
    if (!restrictsInput_) return mode != PrimitiveMode::patches;
    switch (mode) {
    case PrimitiveMode::lines:
    case PrimitiveMode::lineLoop:
    case PrimitiveMode::lineStrip:
        return inputPrimitives_ == GL_LINES;
    case PrimitiveMode::triangles:
    case PrimitiveMode::triangleStrip:
    case PrimitiveMode::triangleFan:
        return inputPrimitives_ == GL_TRIANGLES;
    case PrimitiveMode::linesAdjacency:
    case PrimitiveMode::lineStripAdjacency:
        return inputPrimitives_ == GL_LINES_ADJACENCY;
    case PrimitiveMode::trianglesAdjacency:
    case PrimitiveMode::triangleStripAdjacency:
        return inputPrimitives_ == GL_TRIANGLES_ADJACENCY;
    case PrimitiveMode::points:
    case PrimitiveMode::patches:
        break;
    }
    return inputPrimitives_ == unsigned(mode);
}

// What the stages take, once they are linked.
void Program::readInput() {
    const auto& gl = bindings_.context.gl();
    const bool tessellates = hasStage(ShaderStage::tessEvaluation);
    restrictsInput_ = !fromBinary_ && (tessellates || hasStage(ShaderStage::geometry));
    inputPrimitives_ = GL_PATCHES;
    if (tessellates || !restrictsInput_) return;
    GLint type = 0;
    gl.GetProgramiv(name_, GL_GEOMETRY_INPUT_TYPE, &type);
    inputPrimitives_ = unsigned(type);
}

void Program::readInterface() {
    readInput();
    ProgramInterface interface = readProgramInterface(bindings_.context, name_);
    for (ActiveBlock& block : interface.blocks) {
        auto [storage, created] = bindings_.blocks.acquire(block.name, block.size, block.members);
        blocks_.push_back({.name = std::move(block.name),
                           .index = block.index,
                           .storage = std::move(storage),
                           .created = created});
    }
    slots_.reserve(interface.uniforms.size());
    for (ActiveUniform& uniform : interface.uniforms) {
        const int index = addSlot(uniform.name);
        if (uniform.type->isSampler()) samplers_.push_back(index);
        slots_[index].uniform = std::move(uniform);
    }
    subroutines_ = SubroutineTable(bindings_.context, name_);
}

void Program::applyInitialValues(Diagnostics& diagnostics) {
    for (const auto& module : source_.modules) {
        for (const InitialUniform& initial : module->uniforms())
            applyInitialValue(initial, diagnostics);
        for (const InitialSubroutine& initial : module->subroutines())
            applyInitialSubroutine(initial, diagnostics);
    }
}

void Program::applyInitialSubroutine(const InitialSubroutine& initial, Diagnostics& diagnostics) {
    const auto result =
        subroutines_.chooseInitially(initial.stage, initial.uniform, initial.function);
    if (result != SubroutineTable::Result::noFunction) return;
    const auto names = subroutines_.functions(initial.stage, initial.uniform);
    diagnostics.report({.severity = Severity::warning,
                        .code = "unmatched-uniform",
                        .place = initial.place,
                        .message = inQuotes(initial.function) + " is no function for '" +
                                   initial.uniform + "' of program '" + source_.name + "'",
                        .expected = listOfNames(names),
                        .suggestion = nearestName(initial.function, names)});
}

void Program::applyInitialValue(const InitialUniform& initial, Diagnostics& diagnostics) {
    const int index = findSlot(initial.name);
    if (index < 0) return;
    Slot& slot = slots_[index];
    const UniformType& type = *slot.uniform.type;
    const bool sampler = initial.texture.given();
    if (sampler ? !type.isSampler() : !(initial.value.type() == type)) {
        const std::string given(sampler ? "a texture" : initial.value.type().name);
        diagnostics.warning("unmatched-uniform", initial.place,
                            "the initial value of '" + initial.name + "' is " + given +
                                ", but in program '" + source_.name + "' it is " +
                                withArticle(type.name),
                            std::string(type.name));
        return;
    }
    if (sampler) {
        slot.textureEntry = initial.texture.entry();
        slot.texture = nullptr;
        return checkTexture(slot, textureOf(slot));
    }
    if (slot.uniform.block >= 0 && !blocks_[slot.uniform.block].created) return;
    slot.initial = initial.value;
    setValue(slot, initial.value);
}

int Program::findSlot(std::string_view name) const {
    const auto find = [&](std::string_view exact) {
        const auto found = slotsByName_.find(exact);
        const bool active = found != slotsByName_.end() && slots_[found->second].active();
        return active ? found->second : -1;
    };
    if (const int slot = find(name); slot >= 0) return slot;
    const std::string text(name);
    if (const int slot = find(text + "[0]"); slot >= 0) return slot;
    for (const Block& block : blocks_) {
        if (const int slot = find(block.name + "." + text); slot >= 0) return slot;
        if (!name.starts_with(block.name + ".")) continue;
        const int slot = find(name.substr(block.name.size() + 1));
        if (slot >= 0 && slots_[slot].uniform.block >= 0) return slot;
    }
    return -1;
}

int Program::addSlot(std::string name) {
    const auto index = static_cast<int>(slots_.size());
    slots_.push_back({.name = name});
    slotsByName_.emplace(std::move(name), index);
    return index;
}

const Program::Slot& Program::resolved(int slot) const {
    const int alias = slots_[slot].aliasOf;
    return slots_[alias >= 0 ? alias : slot];
}

Program::Slot& Program::resolved(int slot) {
    return const_cast<Slot&>(std::as_const(*this).resolved(slot));
}

UniformHandle Program::find(std::string_view name) {
    int slot = findSlot(name);
    if (slot < 0) {
        const auto known = slotsByName_.find(name);
        slot = known != slotsByName_.end() ? known->second : addSlot(std::string(name));
    }
    return {*this, slot};
}

std::vector<std::string> Program::uniformNames() const {
    std::vector<std::string> names;
    for (const Slot& slot : slots_) {
        if (slot.active()) names.push_back(slot.name);
    }
    return names;
}

void Program::inheritValues(const Program& previous) {
    subroutines_.inherit(previous.subroutines_);
    for (const Slot& old : previous.slots_) {
        const bool owned = old.texture && old.texture.use_count() > 0;
        const UniformValue value = old.active() ? previous.read(old) : old.value;
        const bool set = old.active() && old.uniform.block >= 0 ? true : old.known;
        const bool edited = set && !(value == old.initial);
        if (!owned && !edited && !old.sampler) continue;
        const int found = findSlot(old.name);
        if (found < 0) {
            Slot& remembered = resolved(find(old.name).slot_);
            remembered.value = value;
            remembered.known = edited;
            remembered.texture = old.texture;
            remembered.sampler = old.sampler;
            continue;
        }
        Slot& slot = slots_[found];
        const bool shared = slot.uniform.block >= 0 && !blocks_[slot.uniform.block].created;
        if (owned && slot.uniform.type->isSampler()) setTexture(slot, old.texture);
        slot.sampler = old.sampler;
        if (edited && !shared && value.type() == *slot.uniform.type) setValue(slot, value);
    }
}

} // namespace terrane
