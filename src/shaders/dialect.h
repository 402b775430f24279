// shaders/dialect.h - the text of a shader in the words of one language, without the macros of
// rnmbake_types.glsl.
#pragma once

#include <string>
#include <string_view>

namespace rnmbake {

/// hlsl9: Direct3D 9's, whose samplers are one thing with their textures. wgsl is no such dialect: its texts
/// are files of their own, shaders/wgsl/.
enum class Dialect { glsl, hlsl, hlsl9, wgsl };

/// What the preprocessor would make of the text's macros in that language, which is not wgsl; comments stay
/// as they are.
[[nodiscard]] std::string in_dialect(std::string_view text, Dialect dialect);

}  // namespace rnmbake
