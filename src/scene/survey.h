// scene/survey.h - what Blender would render: objects, meshes, lights, materials, as plain data.
// Written by blender_scripts/survey_entry.py as survey.json + survey.bin (docs/survey-format.md).
#pragma once

#include "base/math.h"
#include "scene/mesh.h"
#include "scene/scene_digest.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace rnmbake {

struct MaterialInfo {
  std::string name;
  bool normal_mapped = false;
  bool emissive = false;
  std::vector<std::string> outside_model;  // "glossy", "transmission", ...: not plain diffuse + emission
  bool even =
      false;  // what it reflects is the same to all who see one side of it, and nothing shines through
};

struct LightInfo {
  std::string name, type;  // POINT, SUN, SPOT, AREA
  double energy = 0;       // W, or strength for a sun
  std::array<double, 3> color{1, 1, 1};
  int max_bounces = 1024;                  // it lights paths that bounced off no more surfaces
  std::string shape;                       // of an area light: SQUARE, RECTANGLE, DISK, ELLIPSE
  std::map<std::string, double> sizes;     // Blender's names: shadow_soft_size, angle, spot_size, size, ...
  Mat44 to_world;                          // row-vector convention
  std::vector<std::string> outside_model;  // "node tree", "light linking", ...
};

/// Where a user may want light probes: an empty, or one of Blender's own volumes.
struct ProbePlace {
  std::string name;
  Mat44 to_world;               // row-vector convention; a volume is the cube [-1, 1]^3
  std::array<int, 3> counts{};  // probes along its axes; 0: an empty

  [[nodiscard]] bool is_volume() const { return counts[0] > 0; }
};

/// One thing with faces. Instances appear once each, with the mesh they share.
struct SceneObject {
  std::string key;        // unique in the scene: the object's name, or instancer/name#n for instances
  std::string name;       // the object's name in Blender
  std::string instancer;  // "" unless it comes from a collection or geometry-nodes instance
  std::string type;       // MESH, CURVE, FONT, SURFACE, META
  int mesh = -1;          // index into SceneSurvey::meshes
  Mat44 to_world;         // row-vector convention
  std::vector<std::string> slots;  // material name of each slot, "" for an empty one
  std::string light_group;         // names the light-linking collections; "" when there are none
  bool visible_to_camera = true;
  bool visible_to_bounces = true;  // to diffuse rays, and to those that mirrors send
};

/// What recipe gather must know of a scene, one line for each thing that names it.
struct GatherNotes {
  std::vector<std::string> refused;   // light that mirrors would not see as receivers do
  std::vector<std::string> unshared;  // what a ray may meet and the survey does not hold
  [[nodiscard]] bool shares() const { return unshared.empty(); }
};

struct SceneSurvey {
  std::string scene_file, scene_name;
  std::string blender_version;
  std::vector<Mesh> meshes;
  std::vector<SceneObject> objects;
  std::map<std::string, MaterialInfo> materials;
  std::vector<LightInfo> lights;
  std::vector<ProbePlace> probe_places;
  std::string world;  // "none", "constant", "picture", "nodes"
  double world_strength = 0;
  std::array<double, 3> world_color{1, 1, 1};
  GatherNotes gather;
  std::vector<std::string> warnings;  // what the user should know of the scene, one line each
  SceneDigest digest;                 // of the user's own scene; empty in a scene file for the tracer
  std::vector<InputFile> inputs;      // every file that was read, the scene itself first

  [[nodiscard]] const Mesh& mesh_of(const SceneObject& object) const {
    return meshes[static_cast<std::size_t>(object.mesh)];
  }
};

}  // namespace rnmbake
