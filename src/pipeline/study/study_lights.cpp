#include "pipeline/study/study_lights.h"

#include "base/error.h"
#include "encoding/basis_set.h"
#include "encoding/direction_sets.h"
#include "encoding/encodings.h"
#include "encoding/random_light.h"
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

constexpr std::size_t tested_normals = 256;

Vec3 as_colour(std::span<const float> texel) {
  return {texel[0], texel[1], texel[2]};
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
         "with --basis "
         "(docs/study.md)",
         file);
  }
  return all;
}

/// One lightmap, 64 rows at a time.
class TexelsOf {
 public:
  TexelsOf(const LightmapPlace& place, const FedAndTested& directions)
      : rows_(place), directions_(directions) {
    const FedAndTested own = divided(rows_.metadata(), rows_.file());
    if (std::ranges::equal(own.tested, directions.tested, {}, &BasisDirection::name, &BasisDirection::name))
      return;
    fail(ExitCode::invalid_input, "{} has other directions than {}; bake them together", rows_.file(),
         directions.fed.name);
  }

  void add_to(EncodingStudy& study, const std::function<EncodingStudy()>& another) {
    constexpr int band = 64;
    for (int begin = 0; begin < rows_.height(); begin += band) {
      const int end = std::min(begin + band, rows_.height());
      const LayeredImage rows = rows_.read(begin, end);
      std::mutex mutex;
      tbb::parallel_for(tbb::blocked_range<int>(0, end - begin, 8),
                        [&](const tbb::blocked_range<int>& range) {
                          EncodingStudy part = another();
                          for (int y = range.begin(); y < range.end(); ++y) add_row(rows, y, part);
                          const std::scoped_lock lock(mutex);
                          study.merge(part);
                        });
    }
  }

 private:
  void add_row(const LayeredImage& rows, int y, EncodingStudy& study) const {
    const Layer* coverage = rows.find("coverage");
    std::vector<const FloatImage*> fed, tested;
    for (const BasisDirection& basis : directions_.fed.directions)
      fed.push_back(&rows.find(exr_layer(basis.name))->pixels);
    for (const BasisDirection& basis : directions_.tested)
      tested.push_back(&rows.find(exr_layer(basis.name))->pixels);
    std::vector<Vec3> at_fed(fed.size()), at_tested(tested.size());
    for (int x = 0; x < rows_.width(); ++x) {
      if (coverage != nullptr && coverage->pixels.texel(x, y)[0] < 0.5F) continue;
      for (std::size_t i = 0; i < fed.size(); ++i) at_fed[i] = as_colour(fed[i]->texel(x, y));
      for (std::size_t i = 0; i < tested.size(); ++i) at_tested[i] = as_colour(tested[i]->texel(x, y));
      study.add(at_fed, at_tested, as_colour(rows.find("")->pixels.texel(x, y)));
    }
  }

  LightmapRows rows_;
  const FedAndTested& directions_;
};

}  // namespace

EncodingStudy study_random(std::size_t count, std::uint64_t seed) {
  const BasisSet fed = direction_set("sh3").value();  // all of them: the sets are nested
  std::vector<Vec3> normals;
  for (const Vec3d& normal : spread_over_hemisphere(tested_normals)) normals.emplace_back(normal);
  EncodingStudy study(fed, normals);
  std::mt19937 random(static_cast<std::mt19937::result_type>(seed));
  std::vector<Vec3> at_normals(normals.size());
  for (std::size_t i = 0; i < count; ++i) {
    Hemisphere light = random_hemisphere(random);
    const double flat = irradiance(light, Vec3d(0, 0, 1));
    for (Sun& sun : light) sun.power /= flat;
    for (std::size_t k = 0; k < normals.size(); ++k)
      at_normals[k] = Vec3(static_cast<float>(irradiance(light, Vec3d(normals[k]))));
    study.add(bakes(light, fed), at_normals, Vec3(1));
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
  const auto another = [&] { return EncodingStudy(directions.fed, normals); };
  EncodingStudy study = another();
  for (std::size_t i = 0; i < folder.places.size(); ++i) {
    if (progress) progress(double(i) / double(folder.places.size()));
    TexelsOf(folder.places[i], directions).add_to(study, another);
  }
  return study;
}

}  // namespace rnmbake
