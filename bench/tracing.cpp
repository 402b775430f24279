// bench/tracing.cpp - speed of the reference tracer on a .rnmscene: noise for time, and rays beside a bare
// Embree loop.
//
// Prints one JSON object. `cost` is relative variance x processor seconds: what halves it halves the time to
// any error.
#include "base/clock.h"
#include "encoding/basis_set.h"
#include "scene/diffuse_scene.h"
#include "scene/surface.h"
#include "scene/tangents.h"
#include "trace/gather.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace {

using namespace rnmbake;
using nlohmann::json;

struct Arguments {
  std::string scene, version = "4.3.2";
  int size = 64, samples = 64, threads = 0, bounces = 32;
  bool alone = false, bare = false;
};

/// In the space of a TraceScene.
std::vector<Surface> surfaces_of(const DiffuseScene& scene) {
  std::vector<Surface> surfaces;
  for (const SceneObject& object : scene.survey.objects) {
    const Mesh& mesh = scene.survey.mesh_of(object);
    std::vector<std::uint32_t> all(mesh.triangles());
    for (std::size_t t = 0; t < all.size(); ++t) all[t] = static_cast<std::uint32_t>(t);
    const UvLayer* lightmap = nullptr;
    for (const UvLayer& layer : mesh.uv_layers) {
      if (lightmap == nullptr || layer.name == "Lightmap") lightmap = &layer;
    }
    if (lightmap == nullptr) continue;
    surfaces.push_back(make_surface(mesh, all, lightmap->uv,
                                    tangent_frames(mesh, lightmap->uv, object.to_world),
                                    object.to_world * Mat44().setTranslation(-middle_of(scene))));
  }
  return surfaces;
}

/// Processor seconds of all threads, to which other work on the machine adds nothing.
double cpu_seconds() {
  return double(std::clock()) / CLOCKS_PER_SEC;
}

/// Sums over all texels of all targets.
struct Totals {
  double squared_error = 0, value = 0, texels = 0;
  std::int64_t rays = 0, paths = 0;

  void add(const Gathered& gathered, std::size_t direction) {
    const GatheredDirection& it = gathered.directions[direction];
    const auto& radiance = it.radiance.data();
    const auto& error = it.standard_error.data();
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      squared_error += double(error[i]) * error[i];
      value += radiance[i];
    }
    for (const float covered : gathered.coverage.data()) texels += 3 * double(covered);
  }
  /// Squared standard error (mean over texels and colours) over the squared mean.
  [[nodiscard]] double relative_variance() const {
    return value > 0 ? squared_error / texels / std::pow(value / texels, 2) : 0;
  }
};

json measure(const TraceScene& scene, const std::vector<GatherTarget>& targets,
             const GatherOptions& options) {
  std::vector<Totals> totals(options.directions.size());
  std::int64_t rays = 0, paths = 0;
  std::vector<double> objects;  // relative variance of each, mean over the directions
  const double start = steady_clock().now(), cpu_start = cpu_seconds();
  gather(scene, targets, options, [&](std::size_t, const Gathered& gathered) {
    double of_object = 0;
    for (std::size_t k = 0; k < totals.size(); ++k) {
      totals[k].add(gathered, k);
      Totals alone;
      alone.add(gathered, k);
      of_object += alone.relative_variance() / double(totals.size());
    }
    objects.push_back(of_object);
    rays += gathered.rays;
    paths += gathered.paths;
  });
  const double seconds = steady_clock().now() - start;
  json result{{"seconds", seconds},
              {"cpu_seconds", cpu_seconds() - cpu_start},
              {"rays", rays},
              {"paths", paths},
              {"rays_per_second", double(rays) / seconds}};
  double sum = 0;
  for (std::size_t k = 0; k < totals.size(); ++k) {
    result["relative_rmse"][options.directions[k].name] = std::sqrt(totals[k].relative_variance());
    sum += totals[k].relative_variance() / double(totals.size());
  }
  result["cost"] = sum * result["cpu_seconds"].get<double>();
  std::nth_element(objects.begin(), objects.begin() + objects.size() / 2, objects.end());
  result["median_cost"] = objects[objects.size() / 2] * result["cpu_seconds"].get<double>();
  return result;
}

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Times the reference tracer on a scene file");
  app.add_option("scene", arguments.scene, ".rnmscene")->required();
  app.add_option("--size", arguments.size, "side of each lightmap");
  app.add_option("--samples", arguments.samples);
  app.add_option("--threads", arguments.threads);
  app.add_option("--bounces", arguments.bounces);
  app.add_option("--version", arguments.version, "Blender whose light units hold");
  app.add_flag("--alone", arguments.alone, "texels do not share paths");
  app.add_flag("--bare", arguments.bare, "also time Embree alone on the same rays");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
  return arguments;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = parse(argc, argv);
  const DiffuseScene diffuse_scene = read_diffuse_scene(arguments.scene);
  const double start = steady_clock().now();
  TraceScene scene(diffuse_scene, arguments.version);
  const double built = steady_clock().now() - start;

  const std::vector<Surface> surfaces = surfaces_of(diffuse_scene);
  std::vector<GatherTarget> targets;
  for (const Surface& surface : surfaces) targets.push_back({&surface, 0, arguments.size, arguments.size});
  GatherOptions options;
  options.directions.push_back(flat_direction());
  for (const BasisDirection& basis : rnm_set().directions) options.directions.push_back(basis);
  options.samples = arguments.samples;
  options.threads = arguments.threads;
  options.bounces = arguments.bounces;
  options.reuse = !arguments.alone;

  RayLog log(arguments.bare ? std::size_t{1} << 20 : 0);
  if (arguments.bare) scene.log_rays(&log);
  json result = measure(scene, targets, options);
  scene.log_rays(nullptr);
  if (arguments.bare) {
    result = measure(scene, targets, options);  // again, without the log in the way
    result["bare_rays_per_second"] = scene.time_bare(log, arguments.threads);
    result["share_of_bare"] =
        result["rays_per_second"].get<double>() / result["bare_rays_per_second"].get<double>();
  }
  result["triangles"] = scene.triangles().size();
  result["bytes"] = scene.bytes();
  result["build_seconds"] = built;
  std::cout << result.dump(2) << '\n';
}
