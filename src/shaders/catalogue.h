// shaders/catalogue.h - the shader files of shaders/, which travel inside the binary, and what each needs.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

/// One file of decoders: "rnm" is shaders/rnm.glsl, in the GLSL that rnmbake_types.glsl makes HLSL of.
struct ShaderFile {
  std::string name;
  std::string purpose;             // of its first line
  std::vector<std::string> needs;  // names of what it includes, but for rnmbake_types
  std::string text;                // without #include lines
};

/// In alphabetical order.
[[nodiscard]] const std::vector<ShaderFile>& shader_files();

/// The text of a file below shaders/, by its path there; nothing where there is no such file.
[[nodiscard]] std::optional<std::string_view> embedded_shader(std::string_view path);

/// The file of a name, or of an encoding's name where several share a file ("h6": hbasis). Throws
/// Error(usage) with the nearest name where there is none.
[[nodiscard]] const ShaderFile& shader_named(const std::string& name);

/// The files of these names and all that they need, each once and after what it needs. No names: all files.
[[nodiscard]] std::vector<const ShaderFile*> with_needs(const std::vector<std::string>& names);

}  // namespace rnmbake
