// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "render/mesh_data.h"
#include "render/module.h"
#include "render/program_bindings.h"
#include "render/program_interface.h"
#include "render/program_subroutines.h"
#include "render/sampler.h"
#include "render/texture.h"
#include "render/uniform_type.h"
#include "resource/resource.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace terrane {

class Program;

/// A uniform of a program, found by name once. Small, copied freely, valid as long as the program
/// object. Setting a uniform that the program does not have does nothing. GL thread only.
class UniformHandle {
public:
    UniformHandle() = default;

    /// Whether the program has such a uniform.
    bool active() const;
    /// Of kind `none` when it is not active.
    const UniformType& type() const;

    /// Sets a scalar, vector or matrix (see UniformTraits). Floats and doubles convert into one
    /// another; any other difference of types is reported once ("uniform-type") and changes
    /// nothing. A value that the uniform has already is not sent again.
    template <class T>
    void set(const T& value) const {
        using Traits = UniformTraits<T>;
        if (!active()) return;
        // The usual case, without a detour through doubles. Booleans have another size here.
        if (Traits::kind != UniformKind::boolean &&
            setBytes(Traits::kind, Traits::columns, Traits::rows, &value, sizeof value))
            return;
        setComponents(uniformComponents(value));
    }
    /// Sets any value as it was read.
    void set(const UniformValue& value) const;
    /// Sets a sampler, and keeps the texture alive. Null takes the texture away.
    void set(const std::shared_ptr<const Texture>& texture) const;
    /// Sets a sampler to a texture that lives at least as long as it is used with this program.
    void set(const Texture& texture) const;

    /// Reads a sampler's texture another way than its own; null for its own way again.
    void setSampler(std::shared_ptr<const Sampler> sampler) const;

    /// The current value; of kind `none` for samplers and uniforms that are not active.
    UniformValue value() const;
    /// Of samplers; null without one.
    const Texture* texture() const;
    /// The same, to draw into; null also for one that somebody else keeps (set(const Texture&)).
    std::shared_ptr<Texture> sharedTexture() const;

private:
    friend class Program;
    UniformHandle(Program& program, int slot)
        : program_(&program)
        , slot_(slot) {}
    void setComponents(const UniformComponents& components) const;
    bool setBytes(UniformKind kind, int columns, int rows, const void* bytes,
                  std::size_t size) const;

    Program* program_ = nullptr;
    int slot_ = -1;
};

/// A handle for values of one C++ type.
template <class T>
class Uniform : public UniformHandle {
public:
    Uniform() = default;
    explicit Uniform(UniformHandle handle)
        : UniformHandle(handle) {}
    void set(const T& value) const { UniformHandle::set(value); }
};

/// A handle for a sampler.
template <>
class Uniform<Texture> : public UniformHandle {
public:
    Uniform() = default;
    explicit Uniform(UniformHandle handle)
        : UniformHandle(handle) {}
    void set(const std::shared_ptr<const Texture>& texture) const { UniformHandle::set(texture); }
    void set(const Texture& texture) const { UniformHandle::set(texture); }
};

/// A linked program as a driver keeps it for itself; no other driver takes it.
struct ProgramBinary {
    unsigned format = 0;
    std::string bytes;
};

struct ProgramSource {
    std::string name; ///< "globals;terrain;", for messages
    Place place;
    std::vector<std::shared_ptr<Module>> modules; ///< linked in this order
    /// Taken instead of linking; if the driver does not, the modules are linked, with a warning
    /// ("program-binary").
    std::optional<ProgramBinary> binary = {};
    bool separable = false; ///< for a ProgramPipeline
};

/// Modules linked into something to draw with, and the values of its uniforms. Without a vertex
/// stage it gets one that passes attribute 0 through as the position. GL thread only.
///
///     const auto program = Program::link(bindings, {.name = "sky;", .modules = {sky}},
///     diagnostics); const auto sun = program->uniform<glm::vec3>("sun.direction");
///     ...
///     sun.set(direction);
///     program->use(); // last, right before the draw
///     quad.draw();
class Program : public Resource {
public:
    /// Starts linking and asks for nothing, so that the driver may do it in the background;
    /// finish() must follow. Null, with diagnostics, when the modules can't go together.
    static std::shared_ptr<Program> start(ProgramBindings& bindings, ProgramSource source,
                                          Diagnostics& diagnostics);
    /// start() and finish(): null, with diagnostics, when it does not link.
    static std::shared_ptr<Program> link(ProgramBindings& bindings, ProgramSource source,
                                         Diagnostics& diagnostics);
    ~Program() override;

    /// Waits for compilers and linker, reports what they say, finds the uniforms and applies the
    /// modules' initial values: each to the uniform of its name and exactly its type; members of
    /// blocks only when nobody had the block before. A uniform of the name with another type is a
    /// warning ("unmatched-uniform"). False when it did not link.
    bool finish(Diagnostics& diagnostics);

    const std::string& name() const { return source_.name; }
    const std::vector<std::shared_ptr<Module>>& modules() const { return source_.modules; }
    bool hasStage(ShaderStage stage) const;
    /// Whether OpenGL draws primitives of this mode with it: tessellation takes patches only, and
    /// geometry stages say what they take.
    bool canDraw(PrimitiveMode mode) const;
    /// For ProgramSource::binary; nothing when the driver has no such thing.
    std::optional<ProgramBinary> binary() const;

    /// A handle by name: `u`, `u[2]`, `s.m`, `u[1].m`; `u` of an array is its first element.
    /// Members of uniform blocks have their plain name, or `Block.member` if the block has an
    /// instance name; the other form is understood too. Never fails: the handle of an unknown name
    /// is not active.
    UniformHandle find(std::string_view name);
    /// The same for values of a type.
    template <class T>
    Uniform<T> uniform(std::string_view name) {
        return Uniform<T>(find(name));
    }
    /// The subroutine uniforms.
    SubroutineTable& subroutines() { return subroutines_; }
    /// Names of all active uniforms, in the order of OpenGL's list.
    std::vector<std::string> uniformNames() const;

    /// Makes it the current program, with its values in uniform blocks sent and its textures and
    /// buffers at units of their own. To be called right before each draw, after all values are
    /// set. A sampler without texture is reported once ("sampler-unset").
    void use();

    /// Takes the values that were set in another version of this program: by name and type, block
    /// members only where the block is new. A value that still was the module's initial one is not
    /// taken, so that an edited initial value shows. What this version has no uniform for is
    /// remembered for a later one.
    void inheritValues(const Program& previous);

private:
    friend class UniformHandle;
    friend class ProgramPipeline;

    struct Slot {
        std::string name;
        ActiveUniform uniform; // type null: not active
        int aliasOf = -1;      // another slot, when the name is the other form of its name
        UniformValue value;    // as sent, or remembered from a version that had it
        bool known = false;    // value is one that was set
        UniformValue initial;  // from a module; of kind none without one
        std::shared_ptr<const Texture> texture;
        const ResourceEntry* textureEntry = nullptr; // followed across reloads
        std::shared_ptr<const Sampler> sampler;
        unsigned unit = 0;
        int sentUnit = -1;
        bool reported = false; // a wrong type
        bool reportedUnset = false;

        bool active() const { return uniform.type != nullptr; }
    };
    struct Block {
        std::string name;
        unsigned index = 0;
        std::shared_ptr<UniformBlock> storage;
        bool created = false;
        unsigned binding = 0;
        int sentBinding = -1;
    };

    Program(ProgramBindings& bindings, ProgramSource source);
    bool loadBinary(Diagnostics& diagnostics);
    bool attach(Diagnostics& diagnostics);
    bool collectFeedback(Diagnostics& diagnostics);
    std::vector<const GlslText*> texts() const;
    bool readStatus(Diagnostics& diagnostics);
    void readInput();
    void readInterface();
    void applyInitialValues(Diagnostics& diagnostics);
    void applyInitialValue(const InitialUniform& initial, Diagnostics& diagnostics);
    void applyInitialSubroutine(const InitialSubroutine& initial, Diagnostics& diagnostics);

    int findSlot(std::string_view name) const;
    int addSlot(std::string name);
    const Slot& resolved(int slot) const;
    Slot& resolved(int slot);

    void setComponents(int slot, const UniformComponents& components);
    void setValue(Slot& slot, const UniformValue& value);
    UniformValue read(const Slot& slot) const;
    void setTexture(Slot& slot, std::shared_ptr<const Texture> texture);
    void checkTexture(Slot& slot, const Texture* texture);
    static const Texture* textureOf(const Slot& slot);
    static std::shared_ptr<Texture> sharedTextureOf(const Slot& slot);
    void reportMismatch(Slot& slot, std::string_view given);

    void bindValues();
    void bindTextures();
    void bindBlocks();

    ProgramBindings& bindings_;
    ProgramSource source_;
    unsigned name_ = 0;
    unsigned inputPrimitives_ = 0; ///< GL_TRIANGLES and so on, of the first stage that cares
    bool restrictsInput_ = false;
    bool fromBinary_ = false;
    bool finished_ = false;
    bool good_ = false;
    std::vector<Slot> slots_;
    std::map<std::string, int, std::less<>> slotsByName_;
    std::vector<Block> blocks_;
    std::vector<int> samplers_; // slots
    SubroutineTable subroutines_;
};

} // namespace terrane
