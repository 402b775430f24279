#include "shaders/catalogue.h"

#include "base/error.h"
#include "base/names.h"

#include <algorithm>
#include <array>
#include <functional>
#include <sstream>
#include <utility>

namespace rnmbake {

const std::vector<std::pair<const char*, const char*>>& embedded_shaders();  // generated: path and text

namespace {

constexpr std::string_view ending = ".glsl", prelude = "rnmbake_types";

/// Encodings, as `convert --to` names them, whose decoders share a file.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> shared_files{{
    {"rnm-vrad", "rnm"},
    {"rnm-signed", "rnm"},
    {"rnm-bakery", "rnm"},
    {"ahd", "directions"},
    {"dominant", "directions"},
    {"h4", "hbasis"},
    {"h6", "hbasis"},
}};

/// "rnm" of `#include "rnm.glsl"`; empty for other lines.
std::string included_name(const std::string& line) {
  constexpr std::string_view before = "#include \"";
  if (!line.starts_with(before)) return "";
  return line.substr(before.size(), line.find(ending) - before.size());
}

/// "// rnm.glsl - the Half-Life 2 basis." says what the file is for after the dash.
std::string purpose_of(const std::string& first_line) {
  std::string purpose = first_line.substr(first_line.find(" - ") + 3);
  if (purpose.ends_with('.')) purpose.pop_back();
  return purpose;
}

ShaderFile parsed_file(std::string name, std::string_view text) {
  ShaderFile file{std::move(name), purpose_of(std::string(text.substr(0, text.find('\n')))), {}, ""};
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    const std::string needed = included_name(line);
    if (needed.empty())
      file.text += line + "\n";
    else if (needed != prelude)
      file.needs.push_back(needed);
  }
  return file;
}

std::vector<ShaderFile> parsed_files() {
  std::vector<ShaderFile> files;
  for (const auto& [path, text] : embedded_shaders()) {
    const std::string_view name(path);
    if (!name.ends_with(ending) || name.find('/') != std::string_view::npos) continue;
    std::string stem(name.substr(0, name.size() - ending.size()));
    if (stem != prelude) files.push_back(parsed_file(std::move(stem), text));
  }
  return files;
}

}  // namespace

const std::vector<ShaderFile>& shader_files() {
  static const std::vector<ShaderFile> files = parsed_files();
  return files;
}

std::optional<std::string_view> embedded_shader(std::string_view path) {
  const auto& all = embedded_shaders();
  const auto found = std::ranges::find_if(all, [&](const auto& file) { return file.first == path; });
  if (found == all.end()) return std::nullopt;
  return found->second;
}

const ShaderFile& shader_named(const std::string& name) {
  const auto shared = std::ranges::find(shared_files, name, [](const auto& pair) { return pair.first; });
  const std::string_view wanted = shared == shared_files.end() ? std::string_view(name) : shared->second;
  const auto file = std::ranges::find(shader_files(), wanted, &ShaderFile::name);
  if (file != shader_files().end()) return *file;
  std::vector<std::string> known;
  for (const ShaderFile& one : shader_files()) known.push_back(one.name);
  for (const auto& pair : shared_files) known.emplace_back(pair.first);
  const std::string hint = did_you_mean(name, known);
  fail(ExitCode::usage, "no shader is called '{}'{}", name,
       hint.empty() ? "; 'rnmbake shaders --list' names them" : hint);
}

std::vector<const ShaderFile*> with_needs(const std::vector<std::string>& names) {
  std::vector<const ShaderFile*> files;
  const std::function<void(const ShaderFile&)> take = [&](const ShaderFile& file) {
    if (std::ranges::find(files, &file) != files.end()) return;
    for (const std::string& needed : file.needs) take(shader_named(needed));
    files.push_back(&file);
  };
  for (const std::string& name : names) take(shader_named(name));
  if (names.empty())
    for (const ShaderFile& file : shader_files()) take(file);
  return files;
}

}  // namespace rnmbake
