// SPDX-License-Identifier: BSD-3-Clause
// Values of a program's uniforms: setting, reading, binding before a draw.
#include "render/program.h"

#include "core/text.h"
#include "render/state_tracker.h"
#include "render/uniform_transfer.h"
#include "resource/entry.h"

#include <glad/gl.h>

#include <cstring>

namespace terrane {

namespace {

// The target that a sampler type reads, by its name: "isampler2DArray" reads 2D arrays.
std::optional<TextureTarget> targetOf(const UniformType& sampler) {
    std::string_view name = sampler.name.substr(sampler.name.find("sampler") + 7);
    constexpr std::string_view shadow = "Shadow";
    if (name.ends_with(shadow)) name.remove_suffix(shadow.size());
    if (name == "1D") return TextureTarget::texture1D;
    if (name == "1DArray") return TextureTarget::texture1DArray;
    if (name == "2D") return TextureTarget::texture2D;
    if (name == "2DArray") return TextureTarget::texture2DArray;
    if (name == "3D") return TextureTarget::texture3D;
    if (name == "Cube") return TextureTarget::cube;
    if (name == "CubeArray") return TextureTarget::cubeArray;
    if (name == "2DRect") return TextureTarget::rectangle;
    if (name == "2DMS") return TextureTarget::multisample2D;
    if (name == "2DMSArray") return TextureTarget::multisample2DArray;
    if (name == "Buffer") return TextureTarget::buffer;
    return std::nullopt;
}

std::string_view targetName(TextureTarget target) {
    switch (target) {
    case TextureTarget::texture1D:
        return "1D texture";
    case TextureTarget::texture1DArray:
        return "1D array texture";
    case TextureTarget::texture2D:
        return "2D texture";
    case TextureTarget::texture2DArray:
        return "2D array texture";
    case TextureTarget::texture3D:
        return "3D texture";
    case TextureTarget::cube:
        return "cube texture";
    case TextureTarget::cubeArray:
        return "cube array texture";
    case TextureTarget::rectangle:
        return "rectangle texture";
    case TextureTarget::multisample2D:
        return "multisample texture";
    case TextureTarget::multisample2DArray:
        return "multisample array texture";
    case TextureTarget::buffer:
        return "buffer texture";
    }
    return "texture";
}

// Two samplers of different types must not share a unit, even for one texture or for none.
UnitKey unitKey(const Texture* texture, const UniformType& type, const Sampler* sampler) {
    const std::uint64_t serial = texture ? texture->serial() : 0;
    return {serial << 16 | (type.code & 0xFFFF), sampler ? sampler->serial() : 0};
}

} // namespace

bool UniformHandle::active() const {
    return program_ && program_->resolved(slot_).active();
}

const UniformType& UniformHandle::type() const {
    return active() ? *program_->resolved(slot_).uniform.type : uniformType(0);
}

void UniformHandle::setComponents(const UniformComponents& components) const {
    if (program_) program_->setComponents(slot_, components);
}

// Only for uniforms of exactly this type, and not in a block, whose layout differs.
bool UniformHandle::setBytes(UniformKind kind, int columns, int rows, const void* bytes,
                             std::size_t size) const {
    Program::Slot& slot = program_->resolved(slot_);
    const UniformType& type = *slot.uniform.type;
    const bool same = type.kind == kind && type.columns == columns && type.rows == rows;
    if (!same || slot.uniform.block >= 0) return false;
    UniformValue& value = slot.value;
    const bool typed = value.type() == type;
    if (slot.known && typed && std::memcmp(value.data(), bytes, size) == 0) return true;
    if (!typed) value = UniformValue(type);
    std::memcpy(value.data(), bytes, size);
    slot.known = true;
    sendUniform(program_->bindings_.context, program_->name_, slot.uniform.location, value);
    return true;
}

void UniformHandle::set(const UniformValue& value) const {
    if (!active()) return;
    Program::Slot& slot = program_->resolved(slot_);
    if (value.type() == *slot.uniform.type)
        program_->setValue(slot, value);
    else
        program_->reportMismatch(slot, value.type().name);
}

void UniformHandle::set(const std::shared_ptr<const Texture>& texture) const {
    if (active()) program_->setTexture(program_->resolved(slot_), texture);
}

void UniformHandle::set(const Texture& texture) const {
    if (!active()) return;
    // Shares nothing and so owns nothing.
    program_->setTexture(program_->resolved(slot_),
                         std::shared_ptr<const Texture>(std::shared_ptr<void>(), &texture));
}

void UniformHandle::setSampler(std::shared_ptr<const Sampler> sampler) const {
    if (active()) program_->resolved(slot_).sampler = std::move(sampler);
}

UniformValue UniformHandle::value() const {
    return active() ? program_->read(program_->resolved(slot_)) : UniformValue();
}

const Texture* UniformHandle::texture() const {
    return active() ? Program::textureOf(program_->resolved(slot_)) : nullptr;
}

std::shared_ptr<Texture> UniformHandle::sharedTexture() const {
    return active() ? Program::sharedTextureOf(program_->resolved(slot_)) : nullptr;
}

void Program::setComponents(int index, const UniformComponents& components) {
    Slot& slot = resolved(index);
    if (!slot.active()) return;
    UniformValue value(*slot.uniform.type);
    if (assignComponents(components, value)) return setValue(slot, value);
    const UniformType* const given =
        findUniformType(components.kind, components.columns, components.rows);
    reportMismatch(slot, given ? given->name : "value of a type that GLSL does not have");
}

void Program::setValue(Slot& slot, const UniformValue& value) {
    if (slot.uniform.block >= 0)
        return writeToBlock(*blocks_[slot.uniform.block].storage, slot.uniform, value);
    if (slot.known && slot.value == value) return;
    slot.value = value;
    slot.known = true;
    sendUniform(bindings_.context, name_, slot.uniform.location, value);
}

UniformValue Program::read(const Slot& slot) const {
    if (slot.uniform.type->isSampler()) return {};
    if (slot.uniform.block >= 0)
        return readFromBlock(*blocks_[slot.uniform.block].storage, slot.uniform);
    if (slot.known) return slot.value;
    return fetchUniform(bindings_.context, name_, slot.uniform);
}

const Texture* Program::textureOf(const Slot& slot) {
    if (!slot.textureEntry) return slot.texture.get();
    return static_cast<const Texture*>(slot.textureEntry->instance.get());
}

std::shared_ptr<Texture> Program::sharedTextureOf(const Slot& slot) {
    if (slot.textureEntry) return std::static_pointer_cast<Texture>(slot.textureEntry->instance);
    if (slot.texture.use_count() == 0) return nullptr;
    // Reading is all that a program does with it; whoever shared it may draw into it.
    return std::const_pointer_cast<Texture>(slot.texture);
}

void Program::setTexture(Slot& slot, std::shared_ptr<const Texture> texture) {
    if (!slot.uniform.type->isSampler()) return reportMismatch(slot, "sampler");
    // One that nobody shared so far may be shared now.
    const bool asShared = slot.texture.use_count() > 0 || texture.use_count() == 0;
    if (!slot.textureEntry && slot.texture == texture && asShared) return;
    slot.textureEntry = nullptr;
    slot.texture = std::move(texture);
    checkTexture(slot, slot.texture.get());
}

void Program::checkTexture(Slot& slot, const Texture* texture) {
    if (!texture) return;
    const TextureTarget target = texture->description().target;
    if (targetOf(*slot.uniform.type) != target) reportMismatch(slot, targetName(target));
}

void Program::reportMismatch(Slot& slot, std::string_view given) {
    if (std::exchange(slot.reported, true)) return;
    const std::string type(slot.uniform.type->name);
    bindings_.context.diagnostics().warning("uniform-type", source_.place,
                                            "uniform '" + slot.name + "' of program '" +
                                                source_.name + "' is " + withArticle(type) +
                                                " and can't take " + withArticle(given),
                                            type);
}

void Program::use() {
    bindings_.context.state().useProgram(name_);
    bindings_.textureUnits.beginDraw();
    bindings_.uniformBindings.beginDraw();
    bindValues();
}

void Program::bindValues() {
    if (!subroutines_.empty()) subroutines_.send(bindings_.context);
    bindTextures();
    bindBlocks();
}

void Program::bindTextures() {
    StateTracker& state = bindings_.context.state();
    for (const int index : samplers_) {
        Slot& slot = slots_[index];
        const Texture* const texture = textureOf(slot);
        if (!texture && !std::exchange(slot.reportedUnset, true))
            bindings_.context.diagnostics().warning("sampler-unset", source_.place,
                                                    "sampler '" + slot.name + "' of program '" +
                                                        source_.name + "' has no texture");
        const UnitKey key = unitKey(texture, *slot.uniform.type, slot.sampler.get());
        slot.unit = bindings_.textureUnits.unitFor(key, slot.unit);
        state.bindTexture(slot.unit, texture ? texture->name() : 0);
        state.bindSampler(slot.unit, slot.sampler ? slot.sampler->name() : 0);
        if (slot.sentUnit == static_cast<int>(slot.unit)) continue;
        slot.sentUnit = static_cast<int>(slot.unit);
        bindings_.context.gl().ProgramUniform1i(name_, slot.uniform.location, slot.sentUnit);
    }
}

void Program::bindBlocks() {
    StateTracker& state = bindings_.context.state();
    for (Block& block : blocks_) {
        block.storage->flush();
        block.binding = bindings_.uniformBindings.unitFor(block.storage->serial(), block.binding);
        state.bindUniformBuffer(block.binding, block.storage->buffer());
        if (block.sentBinding == static_cast<int>(block.binding)) continue;
        block.sentBinding = static_cast<int>(block.binding);
        bindings_.context.gl().UniformBlockBinding(name_, block.index, block.binding);
    }
}

} // namespace terrane
