#include "pipeline/ssbump/ssbump_mesh.h"

#include "bake/targets.h"
#include "base/error.h"
#include "base/log.h"
#include "base/names.h"
#include "base/progress.h"
#include "base/text.h"
#include "config/resolve.h"
#include "lightmap/fill.h"
#include "pipeline/lightmaps/target_facts.h"
#include "pipeline/scene/scene_survey.h"
#include "process/stop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

constexpr double noticed_overlap =
    1e-3;  // share of the covered texels; less happens along the seams of charts

bool is_mesh_file(const std::string& name) {
  static constexpr std::array<const char*, 4> endings{".blend", ".glb", ".gltf", ".obj"};
  return std::ranges::find(endings, lower_extension(name)) != endings.end();
}

bool fits(const std::vector<std::string>& patterns, const SceneObject& object) {
  return std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
    return glob_match(pattern, object.name) || glob_match(pattern, object.key);
  });
}

void check_patterns(const std::vector<std::string>& patterns, const SceneSurvey& survey, const fs::path& file,
                    const char* flag) {
  std::vector<std::string> names;
  for (const SceneObject& object : survey.objects) {
    names.push_back(object.name);
    names.push_back(object.key);
  }
  const auto lonely = unmatched(patterns, names);
  if (lonely.empty()) return;
  fail(ExitCode::usage, "{} '{}' matches no object of {}; rnmbake inspect lists them", flag, lonely.front(),
       file.string());
}

SceneSurvey survey_meshes(BlenderSession& session, const fs::path& file) {
  if (!is_mesh_file(file.string()))
    fail(ExitCode::usage, "{}: not a mesh by its ending; give a .blend, .glb, .gltf or .obj file",
         file.string());
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored))
    fail(ExitCode::io, "{}: no such file; check the path", file.string());
  log::info("reading {}", file.string());
  SceneSurvey survey = survey_file(session, file);
  for (const std::string& warning : survey.warnings) log::debug("{}", warning);
  if (!survey.objects.empty()) return survey;
  fail(ExitCode::invalid_input, "{}: holds no mesh that renders: is everything hidden from rendering?",
       file.string());
}

/// UV layer of the map.
std::size_t layer_of(const Mesh& mesh, const SceneObject& object, const std::string& wanted) {
  const auto named = std::find_if(mesh.uv_layers.begin(), mesh.uv_layers.end(),
                                  [&](const UvLayer& layer) { return layer.name == wanted; });
  if (!wanted.empty() && named == mesh.uv_layers.end()) {
    fail(ExitCode::invalid_input, "object '{}' has no UV layer '{}'; name another with --uv, or unwrap it",
         object.key, wanted);
  }
  const auto active = static_cast<std::size_t>(std::max(0, mesh.render_uv));
  const std::size_t layer =
      wanted.empty() ? active : static_cast<std::size_t>(named - mesh.uv_layers.begin());
  const bool usable = !mesh.uv_layers.empty() &&
                      areas(mesh, mesh.all_triangles(), mesh.uv_layers[layer].uv, object.to_world).uv > 1e-12;
  if (usable) return layer;
  fail(ExitCode::invalid_input,
       "object '{}' has no UVs with an area, so there is no picture to put detail on; unwrap it in Blender "
       "(only the --onto mesh needs UVs)",
       object.key);
}

LowSurface low_surface(const SceneSurvey& survey, std::size_t index, const std::string& uv) {
  const SceneObject& object = survey.objects[index];
  const Mesh& mesh = survey.mesh_of(object);
  const UvLayer& layer = mesh.uv_layers[layer_of(mesh, object, uv)];
  Target target;
  target.object = index;
  target.key = object.key;
  target.part.triangles = mesh.all_triangles();
  target.uv = target.tangent_uv = std::make_shared<const std::vector<Vec2>>(layer.uv);
  target.uv_layer = target.tangent_layer = layer.name;
  LostDirections lost;
  Surface surface = surface_of(survey, target, lost);
  lost.warn();
  return {object.key, std::move(surface)};
}

/// Appends an object's triangles. A mirrored object keeps its front: two corners change places.
void add_high(const SceneSurvey& survey, const SceneObject& object, HighMesh& high) {
  const Mesh& mesh = survey.mesh_of(object);
  const Mat44 for_normals = object.to_world.inverse().transposed();
  const bool mirrored = object.to_world.determinant() < 0;
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    std::array<Vec3, 3> p, n;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t loop = mesh.triangle_loops[3 * t + (mirrored && k > 0 ? 3 - k : k)];
      p[k] = Vec3(Vec3d(mesh.positions[mesh.loop_vertex[loop]]) * object.to_world);
      Vec3d normal;
      for_normals.multDirMatrix(Vec3d(mesh.loop_normal[loop]), normal);
      n[k] = Vec3(normal.normalized());
    }
    const float area = (p[1] - p[0]).cross(p[2] - p[0]).length();
    if (!(area > 0) || !std::isfinite(area)) continue;
    high.position.insert(high.position.end(), p.begin(), p.end());
    high.normal.insert(high.normal.end(), n.begin(), n.end());
  }
}

/// Both sides of the measurement.
struct Meshes {
  HighMesh high;
  std::vector<LowSurface> low;
};

class MeshReader {
 public:
  MeshReader(BlenderSession& session, const SsbumpMeshOptions& options)
      : session_(session), options_(options) {
    for (const std::string& one : options.onto) (is_mesh_file(one) ? files_ : names_).push_back(one);
  }

  Meshes read() {
    const SceneSurvey survey = survey_meshes(session_, options_.high);
    check_patterns(names_, survey, options_.high, "--onto");
    check_patterns(options_.high_objects, survey, options_.high, "--high-objects");
    for (std::size_t i = 0; i < survey.objects.size(); ++i) {
      const SceneObject& object = survey.objects[i];
      if (fits(names_, object)) {
        meshes_.low.push_back(low_surface(survey, i, options_.uv));
      } else if (fits(options_.high_objects, object)) {
        add_high(survey, object, meshes_.high);
      }
    }
    for (const std::string& file : files_) add_low_file(file);
    check();
    return std::move(meshes_);
  }

 private:
  void add_low_file(const fs::path& file) {
    const SceneSurvey survey = survey_meshes(session_, file);
    check_patterns(options_.low_objects, survey, file, "--low-objects");
    for (std::size_t i = 0; i < survey.objects.size(); ++i) {
      const SceneObject& object = survey.objects[i];
      if (fits(options_.low_objects, object) && survey.mesh_of(object).triangles() > 0)
        meshes_.low.push_back(low_surface(survey, i, options_.uv));
    }
  }

  void check() const {
    const std::string high = options_.high.string();
    if (meshes_.high.position.empty())
      fail(ExitCode::invalid_input, "{}: no face is left to take detail from; see --high-objects", high);
    if (meshes_.low.empty())
      fail(ExitCode::invalid_input, "--onto {}: no mesh with faces; see --low-objects",
           options_.onto.front());
  }

  BlenderSession& session_;
  const SsbumpMeshOptions& options_;
  std::vector<std::string> files_, names_;  // of --onto
  Meshes meshes_;
};

void check_uvs(const std::vector<LowSurface>& low, const SsbumpMeshOptions& options) {
  const UvUse use = uv_use(low, options.measure.width, options.measure.height);
  for (std::size_t i = 0; i < low.size(); ++i) {
    if (use.texels[i] > 0) continue;
    fail(ExitCode::invalid_input,
         "object '{}' covers no texel of {} x {}: move its UVs into the unit square, or raise --size",
         low[i].name, options.measure.width, options.measure.height);
  }
  if (use.overlaps.empty()) return;
  const auto covered = double(std::accumulate(use.texels.begin(), use.texels.end(), std::size_t{0}));
  const UvOverlap& worst = use.overlaps.front();
  const std::string who = worst.first == worst.second
                              ? fmt::format("UVs of object '{}' overlap each other", low[worst.first].name)
                              : fmt::format("UVs of objects '{}' and '{}' overlap", low[worst.first].name,
                                            low[worst.second].name);
  const double share = double(worst.texels) / covered;
  if (options.allow_overlap || share < noticed_overlap) {
    log::warn("{} in {}; the last face has them", who, counted(worst.texels, "texel"));
    return;
  }
  fail(ExitCode::invalid_input,
       "{} in {} ({:.1f} %): unwrap them apart, name another layer with --uv, or pass --allow-overlap "
       "where that is meant (mirrored halves)",
       who, counted(worst.texels, "texel"), 100 * share);
}

/// Warns of texels without detail; throws Error(invalid_input) where all are.
void report_misses(const SsbumpMesh& result) {
  std::size_t texels = 0, missed = 0, behind = 0, worst = 0;
  const auto& surfaces = result.maps.surfaces;
  const auto share = [&](std::size_t i) {
    return double(surfaces[i].missed) / double(std::max<std::size_t>(1, surfaces[i].texels));
  };
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    texels += surfaces[i].texels;
    missed += surfaces[i].missed;
    behind += surfaces[i].behind;
    if (share(i) > share(worst)) worst = i;
  }
  const std::string& name = result.objects[worst];
  if (missed == texels) {
    fail(ExitCode::invalid_input,
         "no texel of '{}' found detail within {:.4g} units of its surface: do the meshes lie on each other? "
         "Raise --cage, or check scale and position of the two files",
         name, result.cage);
  }
  if (behind > 0)
    log::warn("{} found only the back of a face: are normals of the detailed mesh turned round?",
              counted(behind, "place"));
  if (missed == 0) return;
  log::warn(
      "{} of {} ({:.1f} %) found no detail within {:.4g} units; worst is '{}' ({:.1f} %), first at "
      "texel {}, {}; raise --cage, or see --missing",
      missed, counted(texels, "texel"), 100.0 * double(missed) / double(texels), result.cage, name,
      100 * share(worst), surfaces[worst].missed_x, surfaces[worst].missed_y);
}

void renormalize(FloatImage& normals) {
  for (int y = 0; y < normals.height(); ++y) {
    for (int x = 0; x < normals.width(); ++x) {
      const auto texel = normals.texel(x, y);
      const Vec3 normal(texel[0], texel[1], texel[2]);
      const Vec3 straight = normal.length2() > 0 ? unit(normal) : Vec3(0, 0, 1);
      std::copy_n(&straight.x, 3, texel.begin());
    }
  }
}

/// Fills texels without a value from their neighbours: inside the faces without limit, unless they are to be
/// marked; outside up to `dilate` texels.
void fill(MeshOcclusion& maps, const SsbumpMeshOptions& options) {
  TexelMask valued = covered_mask(maps.found);
  TexelMask gaps = covered_mask(maps.covered), outside = gaps;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    outside[i] = gaps[i] == 0 ? 1 : 0;
    gaps[i] = gaps[i] != 0 && valued[i] == 0 ? 1 : 0;
  }
  const bool mark = options.missing == SsbumpMeshOptions::Missing::mark;
  for (FloatImage* image : {&maps.weights.image, &maps.normal, &maps.height}) {
    if (!mark) fill_from_neighbours(*image, valued, gaps, std::numeric_limits<std::size_t>::max());
    TexelMask filled = valued;
    for (std::size_t i = 0; i < filled.size() && !mark; ++i) filled[i] |= gaps[i];
    fill_from_neighbours(*image, std::move(filled), outside, static_cast<std::size_t>(options.dilate));
  }
  renormalize(maps.normal);
}

MeshOcclusion measure(const Meshes& meshes, const MeshOcclusionOptions& options) {
  Progress progress("tracing", progress_for(log::is_quiet(), log::is_jsonl()));
  MeshOcclusion maps = measure_occlusion(meshes.high, meshes.low, options, [&](double share) {
    progress.update(share, "");
    return !StopRequest::requested();
  });
  if (StopRequest::requested()) throw Interrupted{StopRequest::signal()};
  return maps;
}

}  // namespace

SsbumpMesh measure_ssbump_mesh(BlenderSession& session, const SsbumpMeshOptions& options) {
  const Meshes meshes = MeshReader(session, options).read();
  check_uvs(meshes.low, options);
  SsbumpMesh result;
  MeshOcclusionOptions measured = options.measure;
  if (!(measured.cage > 0)) measured.cage = default_cage(meshes.low);
  result.cage = measured.cage;
  result.blender_version = session.blender().info().version_text;
  for (const LowSurface& low : meshes.low) result.objects.push_back(low.name);
  log::info("{} of detail on {}, {} x {} texels, {} each, cage {:.4g}",
            counted(meshes.high.position.size() / 3, "triangle"), fmt::join(result.objects, ", "),
            measured.width, measured.height, counted(static_cast<std::size_t>(measured.rays), "ray"),
            result.cage);
  result.maps = measure(meshes, measured);
  report_misses(result);
  fill(result.maps, options);
  return result;
}

}  // namespace rnmbake
