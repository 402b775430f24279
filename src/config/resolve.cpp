#include "config/resolve.h"

#include "base/error.h"
#include "base/names.h"
#include "base/progress.h"
#include "base/text.h"
#include "config/recipe_names.h"
#include "config/sun.h"

#include <algorithm>
#include <set>
#include <system_error>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {

namespace {

bool any_match(const std::vector<std::string>& patterns, std::string_view name, std::string_view key) {
  return std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
    return glob_match(pattern, name) || glob_match(pattern, key);
  });
}

void check_limits(const ObjectSettings& object, const std::string& where) {
  if (object.min_resolution > object.max_resolution) {
    fail(ExitCode::usage, "{}: min_resolution = {} is above max_resolution = {}; change one of them", where,
         object.min_resolution, object.max_resolution);
  }
}

/// Where an error or a time decides how long to bake, and nobody gave a number.
constexpr int most_samples = 65536;

const std::vector<std::string> rnm{"flat", "rnm0", "rnm1", "rnm2"};

/// Names from a basis file or another set are checked where their vectors are.
bool takes_rnm(const BakingSettings& bake) {
  return bake.basis.empty() && bake.basis_set == BakingSettings::DirectionSet::rnm;
}

void fill_bases(BakingSettings& bake) {
  if (bake.bases.empty() && takes_rnm(bake)) bake.bases = rnm;
}

void check_sun(const SceneSettings& scene, const std::string& where) {
  if (scene.sun.empty() || sun_of(scene.sun)) return;
  fail(ExitCode::usage,
       "{}: sun = '{}' is no sun; give azimuth, elevation (-90 to 90 degrees) and strength: 135,45,3", where,
       scene.sun);
}

void check_bases(const BakingSettings& bake, const std::string& where) {
  std::set<std::string> seen;
  for (const std::string& name : bake.bases) {
    if (takes_rnm(bake) && std::find(rnm.begin(), rnm.end(), name) == rnm.end()) {
      fail(ExitCode::usage, "{}: unknown basis '{}'; give {}{}", where, name, fmt::join(rnm, ", "),
           did_you_mean(name, rnm));
    }
    if (!seen.insert(name).second) {
      fail(ExitCode::usage, "{}: '{}' stands twice in 'bases'; name it once", where, name);
    }
  }
}

std::vector<std::string> scene_endings(Purpose purpose) {
  if (purpose == Purpose::reference) return {".rnmscene", ".blend", ".glb", ".gltf"};
  return {".blend", ".glb", ".gltf"};
}

}  // namespace

void ResolvedConfig::take(const SettingOverride& given) {
  given.setting->slot.set(globals, given.value);
  values_.at(static_cast<std::size_t>(given.setting - settings().data())) = given;
}

const SettingOverride& ResolvedConfig::given(std::string_view key) const {
  for (const SettingOverride& one : values_) {
    if (one.setting->key == key) return one;
  }
  throw std::logic_error(fmt::format("no setting has the key '{}'", key));
}

const std::string& ResolvedConfig::provenance(std::string_view key) const {
  return given(key).where;
}

bool ResolvedConfig::is_shared(std::string_view key) const {
  return given(key).is_shared;
}

/// texels_per_unit normally decides alone. But who types --resolution 64 over a project that chooses sizes by
/// surface asks for 64: of the two, the one from the stronger source counts.
void ResolvedConfig::let_stronger_resolution_win() {
  const SettingOverride& fixed = given("resolution");
  const SettingOverride& by_surface = given("texels_per_unit");
  const bool project_only =
      fixed.source == SettingSource::project;  // by_surface is off then, and may be overridden
  if (fixed.source > by_surface.source && !project_only) {
    take({by_surface.setting, 0.0, fixed.source, fixed.where});
  }
}

bool ResolvedConfig::fixed_for_all(const Setting& setting) const {
  return values_.at(static_cast<std::size_t>(&setting - settings().data())).source >=
         SettingSource::environment;
}

void ResolvedConfig::apply(const ObjectOverride& override_, BakeSettings& settings) const {
  const auto sets = [&](std::string_view key) {
    return std::any_of(override_.values.begin(), override_.values.end(),
                       [&](const SettingOverride& one) { return one.setting->key == key; });
  };
  for (const SettingOverride& one : override_.values) {
    if (!fixed_for_all(*one.setting)) one.setting->slot.set(settings, one.value);
  }
  if (sets("resolution") && !sets("texels_per_unit") && !fixed_for_all(*find_setting("texels_per_unit"))) {
    settings.object.texels_per_unit = 0;
  }
}

/// Whether anybody said how many samples an object gets.
bool ResolvedConfig::sets_samples(std::string_view name, std::string_view key) const {
  return provenance("samples") != "default" ||
         std::ranges::any_of(overrides_, [&](const ObjectOverride& one) {
           return any_match(one.objects, name, key) &&
                  std::ranges::any_of(one.values,
                                      [](const SettingOverride& v) { return v.setting->key == "samples"; });
         });
}

ObjectSettings ResolvedConfig::for_object(std::string_view name, std::string_view key) const {
  BakeSettings result = globals;
  for (const ObjectOverride& override_ : overrides_) {
    if (any_match(override_.objects, name, key)) apply(override_, result);
  }
  check_limits(result.object, fmt::format("object '{}'", key));
  const bool is_open_ended = result.object.noise > 0 || !globals.run.time.empty();
  if (is_open_ended && !sets_samples(name, key)) result.object.samples = most_samples;
  return result.object;
}

bool ResolvedConfig::selects(std::string_view name, std::string_view key) const {
  return any_match(globals.scene.objects, name, key) && !any_match(globals.scene.exclude, name, key);
}

void ResolvedConfig::check_open_end() const {
  const std::string& time = globals.run.time;
  if (!time.empty() && !parse_duration(time))
    fail(ExitCode::usage, "{}: time = '{}' is no length of time; give seconds, or 90s, 10m, 2h",
         provenance("time"), time);
  using Recipe = BakingSettings::Recipe;
  const Recipe recipe = globals.bake.recipe;
  if (recipe != Recipe::gather && recipe != Recipe::flat_normal_map) return;
  if (!time.empty() || globals.object.noise > 0)
    fail(ExitCode::usage,
         "{}: {} is baked with as many samples as it begins with; give --samples in place of {}",
         provenance("recipe"), name_of(recipe), time.empty() ? "--noise" : "--time");
}

void ResolvedConfig::check_together() const {
  const bool least_given = provenance("min_resolution") != "default";
  check_limits(globals.object, provenance(least_given ? "min_resolution" : "max_resolution"));
  check_bases(globals.bake, provenance("bases"));
  if (!globals.bake.basis.empty() && globals.bake.basis_set != BakingSettings::DirectionSet::rnm) {
    fail(ExitCode::usage, "basis ({}) and basis_set ({}) both say which directions to bake; give one of them",
         provenance("basis"), provenance("basis_set"));
  }
  check_open_end();
  check_sun(globals.scene, provenance("sun"));
  const auto& bases = globals.bake.bases;
  if (globals.output.normalize == Normalize::flat && takes_rnm(globals.bake) &&
      std::find(bases.begin(), bases.end(), "flat") == bases.end()) {
    fail(ExitCode::usage, "{}: normalize = flat needs the flat bake; add flat to 'bases' ({})",
         provenance("normalize"), provenance("bases"));
  }
}

ResolvedConfig resolve(const ProjectFile& project, const std::vector<SettingOverride>& environment,
                       const std::vector<SettingOverride>& flags) {
  ResolvedConfig config;
  for (const Setting& setting : settings()) {
    SettingOverride given{&setting, setting.default_value(), SettingSource::fallback, "default"};
    config.values_.push_back(std::move(given));
  }
  for (const auto* layer : {&project.values, &environment, &flags}) {
    for (const SettingOverride& given : *layer) config.take(given);
  }
  config.let_stronger_resolution_win();
  fill_bases(config.globals.bake);
  config.overrides_ = project.overrides;
  config.project_file = project.file;
  config.check_together();
  return config;
}

std::vector<std::string> unmatched(const std::vector<std::string>& patterns,
                                   const std::vector<std::string>& names) {
  std::vector<std::string> lonely;
  for (const std::string& pattern : patterns) {
    const auto fits = [&](const std::string& name) { return glob_match(pattern, name); };
    if (std::none_of(names.begin(), names.end(), fits)) lonely.push_back(pattern);
  }
  return lonely;
}

std::vector<UnmatchedPattern> unmatched_patterns(const ResolvedConfig& config,
                                                 const std::vector<std::string>& names) {
  std::vector<UnmatchedPattern> all;
  const auto add = [&](const std::vector<std::string>& patterns, const std::string& where) {
    for (const std::string& pattern : unmatched(patterns, names)) {
      UnmatchedPattern one{pattern, where};
      all.push_back(std::move(one));
    }
  };
  if (config.provenance("objects") != "default") {
    add(config.globals.scene.objects, config.provenance("objects"));
  }
  if (!config.is_shared("exclude")) add(config.globals.scene.exclude, config.provenance("exclude"));
  for (const ObjectOverride& override_ : config.overrides()) {
    if (!override_.is_shared) add(override_.objects, override_.where);
  }
  return all;
}

bool is_project_path(const std::filesystem::path& path) {
  return lower_extension(path) == ".toml";
}

bool is_scene_path(const std::filesystem::path& path, Purpose purpose) {
  return std::ranges::count(scene_endings(purpose), lower_extension(path)) > 0;
}

void require_scene(const ResolvedConfig& config, Purpose purpose) {
  const bool traced = config.globals.bake.engine == BakingSettings::Engine::embree;
  if (purpose == Purpose::bake && traced) purpose = Purpose::reference;
  std::vector<std::string> endings = scene_endings(purpose);
  const std::string last = endings.back();
  endings.pop_back();
  const std::string known = fmt::format("{} or {}", fmt::join(endings, ", "), last);
  const std::filesystem::path& file = config.globals.scene.file;
  if (file.empty()) {
    fail(ExitCode::usage, "no scene: name a {} file, or a project .toml whose [scene] sets file", known);
  }
  if (!is_scene_path(file, purpose)) {
    fail(ExitCode::usage, "{}: not a scene by its ending; give a {} file, or a project .toml", file.string(),
         known);
  }
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  if (!std::filesystem::exists(status)) {
    fail(ExitCode::io, "{}: no such scene file; check the path ({})", file.string(),
         config.provenance("file"));
  }
  if (std::filesystem::is_directory(status)) {
    fail(ExitCode::io, "{}: is a folder; name the scene file in it", file.string());
  }
  if (!std::filesystem::is_regular_file(status)) {
    fail(ExitCode::io, "{}: is a pipe, a device or a socket; give a regular file", file.string());
  }
}

}  // namespace rnmbake
