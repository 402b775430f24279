#include "pipeline/study/study_lights.h"

#include "base/error.h"
#include "encoding/basis_set.h"
#include "encoding/direction_sets.h"
#include "encoding/encodings.h"
#include "encoding/random_light.h"
#include "encoding/texel_frame.h"
#include "pipeline/lightmaps/lightmap_folder.h"
#include "pipeline/lightmaps/lightmap_rows.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <random>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

std::vector<Vec3> normals_to_test() {
  std::vector<Vec3> normals;
  for (const Vec3d& normal : spread_over_hemisphere(256)) normals.emplace_back(normal);
  return normals;
}

/// Bakes that codecs are fed with, and the others, whose directions are the normals they are tested at.
struct FedAndTested {
  BasisSet fed;
  std::vector<BasisDirection> tested;
};

FedAndTested divided(const LightmapMetadata& metadata, const std::string& file) {
  FedAndTested all{{file, {}}, {}};
  const BasisSet feeding = direction_set("sh3").value(), least = flat_and_rnm();
  for (const BasisDirection& basis : metadata.bases)
    (place_of(feeding, basis) ? all.fed.directions : all.tested).push_back(basis);
  const bool feeds = std::ranges::all_of(
      least.directions, [&](const BasisDirection& basis) { return place_of(all.fed, basis).has_value(); });
  if (!feeds || all.tested.empty()) {
    fail(ExitCode::unsupported,
         "{} has no bakes to test encodings at: needed are flat, rnm0 to rnm2 and other directions; bake "
         "with --basis-set study (docs/study.md)",
         file);
  }
  return all;
}

bool same_names(const std::vector<BasisDirection>& a, const std::vector<BasisDirection>& b) {
  return std::ranges::equal(a, b, {}, &BasisDirection::name, &BasisDirection::name);
}

/// The layers of these directions, in their order.
std::vector<const FloatImage*> pictures(const LayeredImage& rows,
                                        const std::vector<BasisDirection>& directions) {
  std::vector<const FloatImage*> found;
  for (const BasisDirection& basis : directions) found.push_back(&rows.find(exr_layer(basis.name))->pixels);
  return found;
}

/// The covered texels of some rows.
void add_texels(const LayeredImage& rows, const FedAndTested& directions, EncodingStudy& study) {
  const auto fed = pictures(rows, directions.fed.directions), tested = pictures(rows, directions.tested);
  const Layer* coverage = rows.find("coverage");
  const EncodingStudy none = study.another();
  std::mutex mutex;
  tbb::parallel_for(tbb::blocked_range<int>(0, fed.front()->height(), 8),
                    [&](const tbb::blocked_range<int>& range) {
                      EncodingStudy part = none;
                      std::vector<Vec3> at_fed(fed.size()), at_tested(tested.size());
                      for (int y = range.begin(); y < range.end(); ++y) {
                        for (int x = 0; x < fed.front()->width(); ++x) {
                          if (coverage != nullptr && coverage->pixels.texel(x, y)[0] < 0.5F) continue;
                          for (std::size_t i = 0; i < fed.size(); ++i) at_fed[i] = vec3_at(*fed[i], x, y);
                          for (std::size_t i = 0; i < tested.size(); ++i)
                            at_tested[i] = vec3_at(*tested[i], x, y);
                          part.add(at_fed, at_tested);
                        }
                      }
                      const std::scoped_lock lock(mutex);
                      study.merge(part);
                    });
}

void add_lightmap(const LightmapPlace& place, const FedAndTested& directions, EncodingStudy& study) {
  LightmapRows lightmap(place);
  const FedAndTested own = divided(lightmap.metadata(), lightmap.file());
  if (!same_names(own.fed.directions, directions.fed.directions) ||
      !same_names(own.tested, directions.tested)) {
    fail(ExitCode::invalid_input, "{} has other directions than {}; bake them together", lightmap.file(),
         directions.fed.name);
  }
  each_band(lightmap.height(),
            [&](int begin, int end) { add_texels(lightmap.read(begin, end), directions, study); });
}

}  // namespace

EncodingStudy study_random(std::size_t count, std::uint64_t seed) {
  const BasisSet fed = direction_set("sh3").value();  // all of them: the sets are nested
  const std::vector<Vec3> normals = normals_to_test();
  EncodingStudy study(fed, normals);
  std::mt19937 random(static_cast<std::mt19937::result_type>(seed));
  std::vector<Vec3> at_normals(normals.size());
  for (std::size_t i = 0; i < count; ++i) {
    Hemisphere light = random_hemisphere(random);
    const double flat = irradiance(light, Vec3d(0, 0, 1));
    for (Sun& sun : light) sun.power /= flat;
    for (std::size_t k = 0; k < normals.size(); ++k)
      at_normals[k] = Vec3(static_cast<float>(irradiance(light, Vec3d(normals[k]))));
    study.add(bakes(light, fed), at_normals);
  }
  return study;
}

EncodingStudy study_probe(const DistantLight& light, std::size_t count, std::uint64_t seed,
                          const std::function<void(double)>& progress) {
  const BasisSet fed = direction_set("sh3").value();
  const std::vector<Vec3> normals = normals_to_test();
  std::vector<Vec3> directions;
  for (const BasisDirection& basis : fed.directions) directions.push_back(basis.direction);
  directions.insert(directions.end(), normals.begin(), normals.end());
  EncodingStudy study(fed, normals);
  std::mt19937 random(static_cast<std::mt19937::result_type>(seed));
  constexpr std::size_t at_once = 64;
  for (std::size_t begin = 0; begin < count; begin += at_once) {
    if (progress) progress(double(begin) / double(count));
    std::vector<TexelFrame> frames;  // of the surfaces
    while (frames.size() < std::min(at_once, count - begin)) {
      const Vec3 normal(random_direction(random)), tangent = normal.cross(Vec3(random_direction(random)));
      if (tangent.length() > 1e-3F)
        frames.push_back({tangent.normalized(), normal.cross(tangent.normalized()), normal});
    }
    std::vector<std::vector<Vec3>> lights(frames.size());
    tbb::parallel_for(std::size_t(0), frames.size(), [&](std::size_t i) {
      std::vector<Vec3> world;
      for (const Vec3& direction : directions) world.push_back(frames[i].stored(direction));
      lights[i] = irradiance(light, frames[i].normal, world);
    });
    for (const std::vector<Vec3>& values : lights) {  // in their order: sums do not depend on threads
      const std::span<const Vec3> all(values);
      study.add(all.first(fed.directions.size()), all.subspan(fed.directions.size()));
    }
  }
  return study;
}

EncodingStudy study_lightmaps(const std::filesystem::path& path,
                              const std::function<void(double)>& progress) {
  const LightmapFolder folder = open_lightmaps(path);
  if (folder.places.empty()) fail(ExitCode::invalid_input, "{} holds no lightmap; bake again", path.string());
  const LightmapRows first(folder.places.front());
  if (!first.metadata().is_baked()) {
    fail(ExitCode::unsupported, "{} was converted to '{}'; study the lightmaps that it was made from",
         first.file(), first.metadata().convention);
  }
  const FedAndTested directions = divided(first.metadata(), first.file());
  std::vector<Vec3> normals;
  for (const BasisDirection& basis : directions.tested) normals.push_back(basis.direction);
  EncodingStudy study(directions.fed, normals);
  for (std::size_t i = 0; i < folder.places.size(); ++i) {
    if (progress) progress(double(i) / double(folder.places.size()));
    add_lightmap(folder.places[i], directions, study);
  }
  return study;
}

}  // namespace rnmbake
