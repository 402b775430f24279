#include "pipeline/validate/decompose.h"

#include "image/metrics.h"
#include "pipeline/compare/compare_fit.h"
#include "pipeline/lightmaps/lightmap_folder.h"

#include <algorithm>
#include <map>
#include <utility>

namespace rnmbake {
namespace {

/// Rows that no fault of the recipe explains.
constexpr const char* not_lambertian = "non-Lambertian diffuse";
constexpr const char* model_difference = "model difference";

struct LoadedHalves {
  LoadedLightmap first, second;

  [[nodiscard]] ComparedPicture picture(const std::string& basis) const {
    return {basis_layer(first, basis), basis_layer(second, basis), nullptr};
  }
};

/// All lightmaps of one object.
struct LoadedObject {
  LoadedLightmap truth;
  std::vector<LoadedLightmap> emulated;
  LoadedHalves recipe, receiver;
  std::optional<LoadedHalves> own_recipe, own_receiver;

  [[nodiscard]] std::vector<const LoadedLightmap*> all() const {
    std::vector<const LoadedLightmap*> list{&truth, &recipe.first, &recipe.second, &receiver.first,
                                            &receiver.second};
    for (const LoadedLightmap& one : emulated) list.push_back(&one);
    for (const auto* halves : {&own_recipe, &own_receiver}) {
      if (*halves) list.insert(list.end(), {&(*halves)->first, &(*halves)->second});
    }
    return list;
  }
};

ComparedPicture traced(const LoadedLightmap& lightmap, const std::string& basis) {
  return {basis_layer(lightmap, basis), nullptr, basis_layer(lightmap, basis, "_stderr")};
}

FloatImage minus(const FloatImage& a, const FloatImage& b) {
  FloatImage difference = a;
  for (std::size_t i = 0; i < difference.data().size(); ++i) difference.data()[i] -= b.data()[i];
  return difference;
}

/// The comparisons behind the rows of one basis, by their names.
struct Parts {
  std::vector<std::pair<std::string, PictureComparison>> causes;
  PictureComparison total, residual;

  PictureComparison& cause(const std::string& name) {
    const auto known = std::ranges::find(causes, name, &std::pair<std::string, PictureComparison>::first);
    if (known != causes.end()) return known->second;
    causes.emplace_back(name, PictureComparison{});
    return causes.back().second;
  }
  void add(const Parts& other) {
    for (const auto& [name, comparison] : other.causes) cause(name).add(comparison);
    total.add(other.total);
    residual.add(other.residual);
  }
};

Parts parts_of(const DecomposeInput& input, const LoadedObject& object, const std::string& basis,
               const std::vector<CountedWhere>& counted) {
  Parts parts;
  const LoadedLightmap* before = &object.truth;
  for (std::size_t k = 0; k < object.emulated.size(); ++k) {
    const LoadedLightmap& with = object.emulated[k];
    parts.cause(input.emulated[k].cause).add(traced(with, basis), traced(*before, basis), counted);
    before = &with;
  }
  const ComparedPicture recipe = object.recipe.picture(basis);
  ComparedPicture whole = recipe;
  if (object.own_recipe && object.own_receiver) {
    whole = object.own_recipe->picture(basis);
    const ComparedPicture own_receiver = object.own_receiver->picture(basis),
                          receiver = object.receiver.picture(basis);
    const FloatImage own1 = minus(*whole.value, *own_receiver.value),
                     own2 = minus(*whole.second, *own_receiver.second),
                     lambert1 = minus(*recipe.value, *receiver.value),
                     lambert2 = minus(*recipe.second, *receiver.second);
    parts.cause(not_lambertian).add({&own1, &own2, nullptr}, {&lambert1, &lambert2, nullptr}, counted);
    parts.cause(model_difference).add(own_receiver, receiver, counted);
  }
  parts.residual.add(recipe, traced(*before, basis), counted);
  parts.total.add(whole, traced(object.truth, basis), counted);
  return parts;
}

Statistic scaled(const Statistic& statistic, double factor) {
  return {statistic.value * factor, statistic.low95 * factor, statistic.high95 * factor};
}

DecompositionRow row_of(const std::string& name, const PictureMetrics& metrics, double truth) {
  const double share = truth > 0 ? 1 / truth : 0;
  return {name, metrics.bias, metrics.rmse, scaled(metrics.bias, share), scaled(metrics.rmse, share)};
}

DecompositionRow noise_row(double noise, double truth) {
  const double share = truth > 0 ? noise / truth : 0;
  return {"noise", {}, {noise, noise, noise}, {}, {share, share, share}};
}

BasisDecomposition rows_of(const std::string& basis, const Parts& parts) {
  const PictureMetrics total = parts.total.metrics();
  const double truth = total.reference_mean;
  BasisDecomposition result;
  result.basis = basis;
  result.reference_mean = truth;
  for (const auto& [name, comparison] : parts.causes)
    result.rows.push_back(row_of(name, comparison.metrics(), truth));
  result.rows.push_back(noise_row(total.candidate_noise, truth));
  result.rows.push_back(row_of("residual", parts.residual.metrics(), truth));
  result.total = row_of("total", total, truth);
  return result;
}

/// Folders of all bakes and traces, from which load() takes one object's lightmaps.
class Folders {
 public:
  explicit Folders(const DecomposeInput& input)
      : truth_(open_lightmaps(input.truth)), recipe_(input.recipe), receiver_(input.receiver) {
    for (const auto& one : input.emulated) emulated_.push_back(open_lightmaps(one.path));
    if (input.own_recipe) own_recipe_.emplace(*input.own_recipe);
    if (input.own_receiver) own_receiver_.emplace(*input.own_receiver);
  }

  [[nodiscard]] std::vector<std::string> keys() const {
    std::vector<std::string> keys;
    for (const LightmapPlace& place : truth_.places) keys.push_back(place.key);
    return keys;
  }

  /// Lightmaps of one object; nothing where a folder lacks it.
  [[nodiscard]] std::optional<LoadedObject> load(const std::string& key) const {
    if (!has(key)) return std::nullopt;
    LoadedObject object{load_lightmap(*truth_.find(key)), {}, recipe_.load(key), receiver_.load(key), {}, {}};
    for (const LightmapFolder& folder : emulated_)
      object.emulated.push_back(load_lightmap(*folder.find(key)));
    if (own_recipe_) object.own_recipe = own_recipe_->load(key);
    if (own_receiver_) object.own_receiver = own_receiver_->load(key);
    for (const LoadedLightmap* lightmap : object.all()) check_fit(key, object.truth, *lightmap);
    return object;
  }

 private:
  struct OpenHalves {
    LightmapFolder first, second;
    explicit OpenHalves(const Halves& halves)
        : first(open_lightmaps(halves.first)), second(open_lightmaps(halves.second)) {}
    [[nodiscard]] bool has(const std::string& key) const { return first.find(key) && second.find(key); }
    [[nodiscard]] LoadedHalves load(const std::string& key) const {
      return {load_lightmap(*first.find(key)), load_lightmap(*second.find(key))};
    }
  };

  [[nodiscard]] bool has(const std::string& key) const {
    return recipe_.has(key) && receiver_.has(key) && (!own_recipe_ || own_recipe_->has(key)) &&
           (!own_receiver_ || own_receiver_->has(key)) &&
           std::ranges::all_of(emulated_, [&](const auto& folder) { return folder.find(key) != nullptr; });
  }

  LightmapFolder truth_;
  std::vector<LightmapFolder> emulated_;
  OpenHalves recipe_, receiver_;
  std::optional<OpenHalves> own_recipe_, own_receiver_;
};

std::vector<CountedWhere> covered_on_all(const LoadedObject& object) {
  std::vector<CountedWhere> counted;
  for (const LoadedLightmap* lightmap : object.all()) {
    if (const Layer* coverage = lightmap->image.find("coverage")) counted.push_back({&coverage->pixels});
  }
  return counted;
}

}  // namespace

std::vector<Decomposition> decompose(const DecomposeInput& input) {
  const Folders folders(input);
  std::vector<Decomposition> result{{"scene", {}}};
  std::vector<std::pair<std::string, Parts>> scene;  // by basis
  for (const std::string& key : folders.keys()) {
    const auto object = folders.load(key);
    if (!object) continue;
    const auto counted = covered_on_all(*object);
    Decomposition own{key, {}};
    for (const std::string& basis : common_bases(object->all())) {
      const Parts parts = parts_of(input, *object, basis, counted);
      own.bases.push_back(rows_of(basis, parts));
      auto sums = std::ranges::find(scene, basis, &std::pair<std::string, Parts>::first);
      if (sums == scene.end()) sums = scene.insert(scene.end(), {basis, {}});
      sums->second.add(parts);
    }
    result.push_back(std::move(own));
  }
  for (const auto& [basis, parts] : scene) result.front().bases.push_back(rows_of(basis, parts));
  return result;
}

}  // namespace rnmbake
