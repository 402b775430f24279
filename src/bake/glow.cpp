#include "bake/glow.h"

#include <algorithm>

namespace rnmbake {

void note_glow(GlowHeights& heights, const SceneSurvey& survey, std::size_t object, const Surface& surface) {
  const SceneObject& it = survey.objects[object];
  const Mesh& mesh = survey.mesh_of(it);
  if (it.slots.empty()) return;
  for (const SurfaceTriangle& triangle : surface.triangles) {
    const std::size_t slot = mesh.polygon_slot[mesh.triangle_polygon[triangle.source]];
    const std::string& name = it.slots[std::min(slot, it.slots.size() - 1)];
    const auto material = survey.materials.find(name);
    if (material == survey.materials.end() || !material->second.emissive) continue;
    float& highest = heights[name];
    highest = std::max(highest, triangle.height);
  }
}

}  // namespace rnmbake
