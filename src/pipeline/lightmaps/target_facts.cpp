#include "pipeline/lightmaps/target_facts.h"

#include "base/bytes.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/object_notes.h"
#include "base/text.h"
#include "base/version.h"
#include "scene/tangents.h"

namespace rnmbake {

void LostDirections::add(const Target& target, std::size_t corners) {
  if (corners == 0) return;
  corners_ += corners;
  names_.push_back(fmt::format("{} (UV layer '{}')", target.key, target.tangent_layer));
}

void LostDirections::warn() const {
  if (names_.empty()) return;
  log::warn(
      "{}: {} without a tangent, since their UVs meet in a point or line; the basis is turned at will "
      "there: unwrap these faces, or name another layer with --tangent-uv",
      first_names(names_), counted(corners_, "corner"));
}

Surface surface_of(const SceneSurvey& survey, const Target& target, LostDirections& lost,
                   const Vec3d& origin) {
  const SceneObject& object = survey.objects[target.object];
  const Mesh& mesh = survey.mesh_of(object);
  const TangentFrames frames = tangent_frames(mesh, *target.tangent_uv, object.to_world);
  lost.add(target, frames.degenerate_corners);
  return make_surface(mesh, target.part.triangles, *target.uv, frames,
                      object.to_world * Mat44().setTranslation(-origin));
}

LightmapMetadata target_metadata(const Target& target, const ObjectSettings& object,
                                 const OutputSettings& output) {
  LightmapMetadata metadata;
  metadata.green = target.flip_green ? Green::y_down : Green::y_up;
  metadata.normalize = output.normalize;
  metadata.samples = object.samples;
  metadata.seed = object.seed;
  metadata.rnmbake_version = version;
  metadata.object = target.key;
  metadata.uv_layer = target.uv_layer;
  metadata.tangent_uv_layer = target.tangent_layer;
  return metadata;
}

std::string mesh_hash(const Mesh& mesh) {
  return hash128_hex(hash128_hex(bytes_of(mesh.loop_vertex)) + hash128_hex(bytes_of(mesh.polygon_start)) +
                     hash128_hex(bytes_of(mesh.polygon_slot)));
}

std::string uv_hash(const std::vector<Vec2>& uv) {
  return hash128_hex(bytes_of(uv));
}

}  // namespace rnmbake
