// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/context.h"
#include "render/shader_stage.h"

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace terrane {

/// The subroutine uniforms of a linked program, each keyed by its stage and name (`u`, `u[1]`), and
/// the functions chosen for them; the first compatible one until then. GL thread only.
class SubroutineTable {
public:
    enum class Result { done, noUniform, noFunction };

    SubroutineTable() = default;
    SubroutineTable(const GlContext& context, unsigned program);

    bool empty() const { return stages_.empty(); }
    /// Chooses a function. A choice for a uniform that there is not is remembered for a later
    /// version of the program (see inherit).
    Result choose(ShaderStage stage, std::string_view uniform, std::string_view function);
    /// The same, for the value that a module gives: it is not remembered.
    Result chooseInitially(ShaderStage stage, std::string_view uniform, std::string_view function);
    /// The function of a uniform; empty when there is no such uniform.
    std::string_view chosen(ShaderStage stage, std::string_view uniform) const;
    /// Functions that a uniform can be set to.
    std::vector<std::string> functions(ShaderStage stage, std::string_view uniform) const;
    /// Takes over what was chosen, and remembered, in another version of the program.
    void inherit(const SubroutineTable& previous);
    /// OpenGL forgets the choices whenever a program is made current: to be called after that.
    void send(const GlContext& context) const;

private:
    struct Function {
        std::string name;
        unsigned index;
    };
    struct Uniform {
        std::string name; ///< of one element, for arrays
        unsigned location;
        std::vector<Function> compatible;
    };
    struct Stage {
        ShaderStage stage;
        std::vector<Uniform> uniforms;
        std::vector<unsigned> indices; ///< of the functions, by location
    };
    using Key = std::pair<ShaderStage, std::string>;

    static Stage readStage(const GlContext& context, unsigned program, ShaderStage stage);
    const Uniform* find(ShaderStage stage, std::string_view uniform) const;

    std::vector<Stage> stages_; ///< with subroutine uniforms only
    std::map<Key, std::string> choices_;
};

} // namespace terrane
