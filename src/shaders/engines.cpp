#include "shaders/engines.h"

#include "base/error.h"
#include "base/names.h"
#include "base/version.h"
#include "shaders/catalogue.h"

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

constexpr std::array<ShaderEngine, 9> engines{{
    {"glsl", "GLSL 3.30 and ESSL 3.00 or newer", Dialect::glsl, ".glsl", ""},
    {"hlsl", "HLSL of Direct3D 11 and newer", Dialect::hlsl, ".hlsl", ""},
    {"unity", "Unity (HLSL), with Bakery's names", Dialect::hlsl, ".cginc", "unity.hlsl"},
    {"godot", "Godot 4", Dialect::glsl, ".gdshaderinc", "godot.gdshaderinc"},
    {"unreal", "Unreal (HLSL), in a custom node", Dialect::hlsl, ".hlsl", "", true},
    {"threejs", "three.js (WebGL 2)", Dialect::glsl, ".glsl", "threejs.glsl"},
    {"playcanvas", "PlayCanvas (WebGL 2)", Dialect::glsl, ".glsl", "playcanvas.glsl"},
    {"bevy", "Bevy (WGSL; a part of the shaders)", Dialect::wgsl, ".wgsl", ""},
    {"source", "Source (HLSL of Direct3D 9)", Dialect::hlsl9, ".h", ""},
}};

/// Without its guard, which would leave a second struct of the same shader empty.
std::string without_guard(const std::string& text) {
  std::istringstream lines(text);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    const bool guards = line.starts_with("#ifndef RNMBAKE_") || line.starts_with("#define RNMBAKE_") ||
                        line.starts_with("#endif");
    if (!guards) kept += line + "\n";
  }
  return kept;
}

constexpr std::string_view struct_about =
    "// The code of a custom node begins with this struct and ends with a line of yours, such as:\n"
    "// return rnmbake.rnm_decode_squared(Rnm0, Rnm1, Rnm2, N);\n";

std::optional<std::string> text_for(const ShaderEngine& engine, const ShaderFile& file) {
  if (engine.dialect == Dialect::wgsl) {
    const auto text = embedded_shader(fmt::format("wgsl/{}.wgsl", file.name));
    return text ? std::optional<std::string>(*text) : std::nullopt;
  }
  return in_dialect(engine.in_struct ? without_guard(file.text) : file.text, engine.dialect);
}

}  // namespace

std::span<const ShaderEngine> shader_engines() {
  return engines;
}

const ShaderEngine& engine_named(const std::string& name) {
  const auto found = std::ranges::find(engines, name, &ShaderEngine::name);
  if (found != engines.end()) return *found;
  std::vector<std::string> known;
  known.reserve(engines.size());
  for (const ShaderEngine& engine : engines) known.emplace_back(engine.name);
  const std::string hint = did_you_mean(name, known);
  fail(ExitCode::usage, "no engine is called '{}'{}", name,
       hint.empty() ? "; 'rnmbake shaders --list' names them" : hint);
}

std::vector<std::string> shaders_of(const ShaderEngine& engine) {
  std::vector<std::string> names;
  for (const ShaderFile& file : shader_files())
    if (text_for(engine, file)) names.push_back(file.name);
  return names;
}

std::string shader_text(const ShaderEngine& engine, const std::vector<std::string>& names) {
  std::string text =
      fmt::format("// Shaders of rnmbake {} for {}. MIT licence.\n\n", version, engine.purpose);
  if (engine.in_struct) text += fmt::format("{}struct RnmBake\n{{\n", struct_about);
  for (const ShaderFile* file : with_needs(names.empty() ? shaders_of(engine) : names)) {
    const auto part = text_for(engine, *file);
    if (!part) {
      fail(ExitCode::unsupported, "shader '{}' is not written for --engine {}; those that are: {}",
           file->name, engine.name, fmt::join(shaders_of(engine), ", "));
    }
    text += *part + "\n";
  }
  if (engine.in_struct) text += "};\nRnmBake rnmbake;\n";
  if (const auto glue = embedded_shader(fmt::format("engines/{}", engine.glue))) text += *glue;
  return text;
}

}  // namespace rnmbake
