#include "pipeline/deliver/engines/godot_names.h"

#include "base/error.h"

#include <algorithm>
#include <iterator>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {

std::string godot_name(std::string_view name) {
  std::string valid(name);
  std::ranges::replace_if(
      valid, [](char c) { return std::string_view(".:@/\"%").find(c) != std::string_view::npos; }, '_');
  return valid;
}

GodotNames::GodotNames(const GlbNodes& nodes) : nodes_(nodes) {
  const std::string scene = godot_name(nodes.scene_name());
  taken_.emplace(scene, fmt::format("the scene '{}'", nodes.scene_name()));
  for (const std::string& mesh : nodes.mesh_names())
    taken_.emplace(godot_name(scene + "_" + mesh), fmt::format("the mesh '{}'", mesh));
  for (std::size_t node = 0; node < nodes.size(); ++node)
    taken_.emplace(godot_name(nodes.name(node)), fmt::format("the object '{}'", nodes.name(node)));
}

std::string GodotNames::path(std::size_t node) const {
  std::string path;
  for (const std::size_t step : nodes_.path(node)) {
    const std::string name = godot_name(nodes_.name(step));
    const auto [first, end] = taken_.equal_range(name);
    if (std::distance(first, end) > 1)
      fail(ExitCode::unsupported,
           "Godot calls {} and {} the same, '{}', and gives one of them another name; rename one",
           first->second, std::next(first)->second, name);
    path += path.empty() ? name : "/" + name;
  }
  return path;
}

}  // namespace rnmbake
