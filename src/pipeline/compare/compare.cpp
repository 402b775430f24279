#include "pipeline/compare/compare.h"

#include "base/error.h"
#include "base/names.h"
#include "base/version.h"
#include "pipeline/compare/compare_fit.h"
#include "pipeline/lightmaps/lightmap_folder.h"
#include "report/finding.h"
#include "report/maps.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace rnmbake {
namespace {

constexpr float sound_validity = 0.5F;  // a texel of this validity or more counts as sound in the report

/// Folders of one side, opened.
struct Side {
  const CompareSide& asked;
  LightmapFolder folder;
  std::optional<LightmapFolder> second;

  explicit Side(const CompareSide& side) : asked(side), folder(open_lightmaps(side.path)) {
    if (side.second.empty()) return;
    second = open_lightmaps(side.second);
    if (second->single_file != folder.single_file) {
      fail(ExitCode::usage, "{} and {} must both be folders, or both files", side.path.string(),
           side.second.string());
    }
  }
};

/// Paths of each texel; 0 where --error decided, for the file does not record their number.
double paths_of(const LightmapMetadata& metadata) {
  return metadata.error > 0 ? 0 : metadata.samples;
}

/// One object on one side, read.
struct SideLightmap {
  LoadedLightmap first;
  std::optional<LoadedLightmap> second;

  [[nodiscard]] ComparedPicture picture(const std::string& basis) const {
    ComparedPicture picture{basis_layer(first, basis), nullptr, basis_layer(first, basis, "_stderr"),
                            paths_of(first.metadata)};
    if (!second) return picture;
    picture.second = basis_layer(*second, basis);
    picture.paths += paths_of(second->metadata);
    return picture;
  }
};

/// Lightmap of the same key; of a single file, its only one.
const LightmapPlace* partner(const LightmapFolder& folder, const std::string& key) {
  return folder.single_file ? &folder.places.front() : folder.find(key);
}

SideLightmap load(const Side& side, const LightmapPlace& place) {
  SideLightmap loaded{load_lightmap(place), {}};
  if (!side.second) return loaded;
  const LightmapPlace* again = partner(*side.second, place.key);
  if (again == nullptr) {
    fail(ExitCode::invalid_input, "{} has no '{}', which {} has; bake both with the same --objects",
         side.second->path.string(), place.key, side.folder.path.string());
  }
  loaded.second = load_lightmap(*again);
  check_halves(place.key, loaded.first, *loaded.second);
  return loaded;
}

std::vector<const LoadedLightmap*> all_of(const SideLightmap& one, const SideLightmap& other) {
  std::vector<const LoadedLightmap*> all{&one.first, &other.first};
  if (one.second) all.push_back(&*one.second);
  if (other.second) all.push_back(&*other.second);
  return all;
}

const FloatImage* layer_of(const LoadedLightmap& lightmap, const char* name) {
  const Layer* layer = lightmap.image.find(name);
  return layer == nullptr ? nullptr : &layer->pixels;
}

std::vector<CountedWhere> covered_on_all(const std::vector<const LoadedLightmap*>& lightmaps) {
  std::vector<CountedWhere> counted;
  for (const LoadedLightmap* lightmap : lightmaps) {
    if (const FloatImage* coverage = layer_of(*lightmap, "coverage")) counted.push_back({coverage});
  }
  return counted;
}

std::size_t count(const FloatImage& picture, const std::vector<CountedWhere>& counted) {
  std::size_t texels = 0;
  for (std::size_t i = 0; i < picture.texels(); ++i) texels += counts(counted, i) ? 1 : 0;
  return texels;
}

void note_differences(const LightmapMetadata& a, const LightmapMetadata& b, ObjectComparison& object) {
  const auto note = [&](const char* what, const std::string& one, const std::string& other) {
    if (one == other || one.empty() || other.empty()) return;
    object.notes.push_back(fmt::format("{} differs: {} against {}", what, one, other));
  };
  note("what a texel averages over", a.footprint, b.footprint);
  note("the lightmap's UV layer", a.uv_layer, b.uv_layer);
  note("the normal map's UV layer", a.tangent_uv_layer, b.tangent_uv_layer);
  if (a.repaired || b.repaired) object.notes.emplace_back("some texels were repaired from their neighbours");
}

/// Compares pair after pair and keeps the scene's sums.
class Comparer {
 public:
  Comparer(const CompareOptions& options, const Side& candidate, const Side& reference, std::size_t pairs)
      : options_(options), candidate_(candidate), reference_(reference), pairs_(pairs) {}

  void compare(const LightmapPlace& one, const LightmapPlace& other) {
    const SideLightmap a = load(candidate_, one), b = load(reference_, other);
    check_fit(one.key, a.first, b.first);
    const auto lightmaps = all_of(a, b);
    const std::vector<std::string> bases = common_bases(lightmaps);
    if (bases.empty()) {
      fail(ExitCode::invalid_input,
           "'{}' has no basis in common in {} and {}; bake both with the same --bases", one.key, a.first.file,
           b.first.file);
    }
    std::vector<CountedWhere> counted = covered_on_all(lightmaps);
    ObjectComparison object = describe(one, other, a, b, counted);
    if (const FloatImage* validity = layer_of(b.first, "validity"))
      counted.push_back({validity, options_.min_validity});
    for (const std::string& basis : bases) compare_basis(basis, a, b, counted, object);
    report_.objects.push_back(std::move(object));
  }

  [[nodiscard]] Report finish() {
    for (const auto& [name, sums] : scene_) report_.scene.push_back({name, sums.metrics()});
    return std::move(report_);
  }

 private:
  [[nodiscard]] static ObjectComparison describe(const LightmapPlace& one, const LightmapPlace& other,
                                                 const SideLightmap& a, const SideLightmap& b,
                                                 std::vector<CountedWhere> counted) {
    ObjectComparison object;
    object.key = one.key;
    object.candidate_files = file_names(one.files);
    object.reference_files = file_names(other.files);
    const FloatImage& picture = a.first.image.layers.front().pixels;
    object.width = picture.width();
    object.height = picture.height();
    const auto covered = double(count(picture, counted));
    object.coverage = covered / double(picture.texels());
    object.outside_model = other.outside_model;
    note_differences(a.first.metadata, b.first.metadata, object);
    if (const FloatImage* validity = layer_of(b.first, "validity"); validity != nullptr && covered > 0) {
      counted.push_back({validity, sound_validity});
      object.validity = double(count(picture, counted)) / covered;
    }
    return object;
  }

  void compare_basis(const std::string& basis, const SideLightmap& a, const SideLightmap& b,
                     const std::vector<CountedWhere>& counted, ObjectComparison& object) {
    const ComparedPicture candidate = a.picture(basis), reference = b.picture(basis);
    PictureComparison comparison;
    comparison.add(candidate, reference, counted);
    object.bases.push_back({basis, comparison.metrics()});
    if (options_.with_maps) {
      const int limit = map_limit(pairs_, a.first.metadata.bases.size());
      object.maps.push_back(make_maps(basis, candidate, reference, counted, limit));
    }
    sums_of(basis).add(comparison);
  }

  /// Bases in the order in which they turn up.
  PictureComparison& sums_of(const std::string& basis) {
    const auto known = std::ranges::find(scene_, basis, &std::pair<std::string, PictureComparison>::first);
    if (known != scene_.end()) return known->second;
    scene_.push_back({basis, {}});
    return scene_.back().second;
  }

  const CompareOptions& options_;
  const Side &candidate_, &reference_;
  std::size_t pairs_;
  std::vector<std::pair<std::string, PictureComparison>> scene_;
  Report report_;
};

bool chosen(const CompareOptions& options, const std::string& key) {
  return std::ranges::any_of(options.objects, [&](const auto& glob) { return glob_match(glob, key); });
}

using Pair = std::pair<const LightmapPlace*, const LightmapPlace*>;

std::vector<Pair> pairs_of(const CompareOptions& options, const Side& candidate, const Side& reference) {
  std::vector<Pair> pairs;
  for (const LightmapPlace& place : candidate.folder.places) {
    const LightmapPlace* other = partner(reference.folder, place.key);
    if (other != nullptr && chosen(options, place.key)) pairs.push_back({&place, other});
  }
  if (!pairs.empty()) return pairs;
  fail(ExitCode::invalid_input, "{} and {} have no object in common{}; compare bakes of one scene",
       candidate.folder.path.string(), reference.folder.path.string(),
       options.objects == CompareOptions{}.objects ? "" : " that fits --objects");
}

std::vector<std::string> without_partner(const CompareOptions& options, const LightmapFolder& folder,
                                         const LightmapFolder& other) {
  std::vector<std::string> keys;
  for (const LightmapPlace& place : folder.places)
    if (partner(other, place.key) == nullptr && chosen(options, place.key)) keys.push_back(place.key);
  return keys;
}

std::string label_of(const CompareSide& side) {
  if (!side.label.empty()) return side.label;
  const std::filesystem::path path = side.path.lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

void name_sides(const CompareOptions& options, Report& report) {
  report.candidate_label = label_of(options.candidate);
  report.reference_label = label_of(options.reference);
  if (report.candidate_label != report.reference_label) return;
  report.candidate_label += " (A)";
  report.reference_label += " (B)";
}

std::string noise_of(bool known, bool halves) {
  return !known ? "not known, left in" : halves ? "from two bakes, taken out" : "standard errors, taken out";
}

void add_side(const std::string& label, const LoadedLightmap& lightmap, Report& report) {
  const LightmapMetadata& metadata = lightmap.metadata;
  const auto add = [&](const char* what, const std::string& value) {
    if (!value.empty()) report.settings.emplace_back(label + ": " + what, value);
  };
  add("recipe", metadata.recipe);
  add("model", metadata.model);
  add("faults", metadata.faults);
  add("samples", metadata.samples > 0 ? std::to_string(metadata.samples) : "");
  add("bounces", metadata.bounces < 0 ? "no limit" : std::to_string(metadata.bounces));
  add("seed", std::to_string(metadata.seed));
  add("footprint", metadata.footprint);
  if (!metadata.blender_version.empty())
    report.versions.emplace_back(label + ": Blender", metadata.blender_version);
  if (!metadata.rnmbake_version.empty())
    report.versions.emplace_back(label + ": rnmbake", metadata.rnmbake_version);
}

void add_noise(const CompareOptions& options, Report& report) {
  const PictureMetrics metrics = report.scene.empty() ? PictureMetrics{} : report.scene.front().metrics;
  report.settings.emplace_back(report.candidate_label + ": noise",
                               noise_of(metrics.candidate_noise_known, !options.candidate.second.empty()));
  report.settings.emplace_back(report.reference_label + ": noise",
                               noise_of(metrics.reference_noise_known, !options.reference.second.empty()));
}

}  // namespace

Report compare_lightmaps(const CompareOptions& options) {
  const Side candidate(options.candidate), reference(options.reference);
  if (candidate.folder.single_file != reference.folder.single_file) {
    fail(ExitCode::usage, "{} and {} must both be folders, or both files", candidate.folder.path.string(),
         reference.folder.path.string());
  }
  const std::vector<Pair> pairs = pairs_of(options, candidate, reference);
  Comparer comparer(options, candidate, reference, pairs.size());
  for (const auto& [one, other] : pairs) comparer.compare(*one, *other);

  Report report = comparer.finish();
  name_sides(options, report);
  report.candidate_only = without_partner(options, candidate.folder, reference.folder);
  report.reference_only = without_partner(options, reference.folder, candidate.folder);
  report.notes = reference.folder.notes;
  for (const std::string& note : candidate.folder.notes) {
    if (std::ranges::find(report.notes, note) == report.notes.end()) report.notes.push_back(note);
  }
  report.versions.emplace_back("rnmbake", version);
  add_side(report.candidate_label, load_lightmap(*pairs.front().first), report);
  add_side(report.reference_label, load_lightmap(*pairs.front().second), report);
  add_noise(options, report);
  report.finding = finding_of(report);
  return report;
}

}  // namespace rnmbake
