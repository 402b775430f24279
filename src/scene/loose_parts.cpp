#include "scene/loose_parts.h"

#include "scene/disjoint_sets.h"

namespace rnmbake {

std::vector<std::uint32_t> loose_parts(const Mesh& mesh) {
  DisjointSets vertices(mesh.positions.size());
  for (std::size_t triangle = 0; triangle < mesh.triangles(); ++triangle) {
    vertices.join(mesh.corner_vertex(3 * triangle), mesh.corner_vertex(3 * triangle + 1));
    vertices.join(mesh.corner_vertex(3 * triangle), mesh.corner_vertex(3 * triangle + 2));
  }
  constexpr std::uint32_t unseen = ~std::uint32_t{0};
  std::vector<std::uint32_t> number(mesh.positions.size(), unseen);
  std::uint32_t count = 0;
  std::vector<std::uint32_t> parts;
  parts.reserve(mesh.triangles());
  for (std::size_t triangle = 0; triangle < mesh.triangles(); ++triangle) {
    std::uint32_t& part = number[vertices.find(mesh.corner_vertex(3 * triangle))];
    if (part == unseen) {
      part = count++;
    }
    parts.push_back(part);
  }
  return parts;
}

}  // namespace rnmbake
