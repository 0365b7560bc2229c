// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace terrane {

// The names that GLSL lost or took for itself, for the rewriting of old sources (glsl_legacy.h).

inline constexpr std::string_view kRenamedPrefix = "terrane_";
/// The core profile lost its deprecated names with GLSL 4.20.
inline constexpr int kRemovalVersion = 420;

/// An output of fragment shaders that was built in (GLSL specification 3.30, section 7.2).
struct OldOutput {
    std::string_view old;
    std::string_view name;
    std::string_view declaration;
};
inline constexpr OldOutput kFragColor{"gl_FragColor", "terrane_FragColor",
                                      "layout(location = 0) out vec4 terrane_FragColor;"};
inline constexpr OldOutput kFragData{
    "gl_FragData", "terrane_FragData",
    "layout(location = 0) out vec4 terrane_FragData[gl_MaxDrawBuffers];"};

struct ReservedWord {
    std::string_view word;
    int since;              // GLSL version
    bool qualifier = false; // a keyword with a meaning, not only kept for later
};

/// A word that is reserved in some version; null for any other.
const ReservedWord* findReservedWord(std::string_view word);

/// Whether core GLSL 3.30 has the contents of an extension, under the names that texture functions
/// and geometry inputs are rewritten to; drivers that don't know it refuse `require`.
bool isAbsorbedExtension(std::string_view name);

/// What an old function is called now.
struct NewName {
    std::string name;
    bool wrapped = false; // the call becomes vec4(...): old shadow functions gave four components
};

/// What a texture function is called in core GLSL, when it has to be renamed.
std::optional<NewName> newTextureFunction(std::string_view name, int version);

} // namespace terrane
