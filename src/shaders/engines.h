// shaders/engines.h - shaders as an engine takes them: its language, its file ending, its names for maps.
#pragma once

#include "shaders/dialect.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

struct ShaderEngine {
  std::string_view name;     // "unity", as after --engine
  std::string_view purpose;  // "Unity (HLSL)"
  Dialect dialect;
  std::string_view ending;  // of files: ".cginc"
  std::string_view glue;    // file of shaders/engines/ with what only this engine needs; may be empty
  bool in_struct = false;   // functions within a struct: where code may stand in a function's body alone
};

[[nodiscard]] std::span<const ShaderEngine> shader_engines();

/// Throws Error(usage) with the nearest name where there is none.
[[nodiscard]] const ShaderEngine& engine_named(const std::string& name);

/// Names of the shaders that the engine's language has.
[[nodiscard]] std::vector<std::string> shaders_of(const ShaderEngine& engine);

/// One text of these shaders and all that they need, ready to be included. No names: all that the language
/// has. Throws Error(unsupported) where it has not all that were asked for.
[[nodiscard]] std::string shader_text(const ShaderEngine& engine, const std::vector<std::string>& names);

}  // namespace rnmbake
