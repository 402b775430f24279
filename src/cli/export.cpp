#include "cli/export.h"

#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "base/text.h"
#include "blender/late_blender.h"
#include "cli/flags/settings_flags.h"
#include "pipeline/scene/export_scene.h"
#include "process/stop.h"

#include <algorithm>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct ExportFlags {
  explicit ExportFlags(CLI::App& command) : settings(command) {
    command.add_flag("--json", as_json, "say what was written as one JSON object");
  }
  SettingsFlags settings;
  bool as_json = false;
};

/// The file itself, or one named after the scene in a folder.
fs::path choose_file(const BakeSettings& settings) {
  const fs::path& given = settings.output.dir;
  if (given.empty()) fail(ExitCode::usage, "nowhere to write to: pass -o FILE.rnmscene, or a folder");
  if (is_rnmscene(given)) return given;
  return given / settings.scene.file.stem().concat(diffuse_scene_ending);
}

std::size_t triangles_of(const SceneSurvey& survey) {
  std::size_t sum = 0;
  for (const SceneObject& object : survey.objects) sum += survey.mesh_of(object).triangles();
  return sum;
}

std::string world_text(const DiffuseScene& scene) {
  const World& world = scene.world;
  if (world.picture < 0)
    return fmt::format("({:g}, {:g}, {:g})", world.radiance.x, world.radiance.y, world.radiance.z);
  const Texture& picture = scene.pictures[static_cast<std::size_t>(world.picture)];
  return fmt::format("{} x {} texels", picture.width, picture.height);
}

std::size_t unwrapped(const TargetList& list) {
  return static_cast<std::size_t>(std::count_if(list.targets.begin(), list.targets.end(),
                                                [](const Target& target) { return target.unwrapped; }));
}

void write_text(const ExportResult& exported, const fs::path& file, std::ostream& out) {
  const DiffuseScene& scene = exported.diffuse_scene;
  const SceneSurvey& survey = scene.survey;
  const auto line = [&](const char* what, const std::string& said) {
    out << printable(fmt::format("{:<10}{}", what, said)) << '\n';
  };
  line("file", fmt::format("{} ({:.1f} MB)", file.string(), double(fs::file_size(file)) / 1e6));
  line("objects", fmt::format("{}, {}; {} would get a lightmap, {} of them unwrapped", survey.objects.size(),
                              counted(triangles_of(survey), "triangle"), exported.list.targets.size(),
                              unwrapped(exported.list)));
  line("materials",
       fmt::format("{}, {}, {}", scene.materials.size(), counted(scene.pictures.size(), "picture"),
                   counted(scene.normal_maps.size(), "normal map")));
  line("lights", fmt::format("{}", survey.lights.size()));
  line("world", world_text(scene));
  line("camera", scene.camera ? scene.camera->name : "none");
  if (scene.outside.empty()) return;
  out << "\nOutside the reference's model:\n";
  for (const OutsideModel& outside : scene.outside)
    out << printable(fmt::format("  {}: {}", outside.owner, fmt::join(outside.what, ", "))) << '\n';
}

json as_json(const ExportResult& exported, const fs::path& file) {
  const DiffuseScene& scene = exported.diffuse_scene;
  const Vec3& radiance = scene.world.radiance;
  json result{
      {"schema_version", 1},
      {"file", file.string()},
      {"bytes", fs::file_size(file)},
      {"blender", scene.survey.blender_version},
      {"objects", scene.survey.objects.size()},
      {"triangles", triangles_of(scene.survey)},
      {"lightmaps", exported.list.targets.size()},
      {"unwrapped", unwrapped(exported.list)},
      {"materials", scene.materials.size()},
      {"pictures", scene.pictures.size()},
      {"normal_maps", scene.normal_maps.size()},
      {"lights", scene.survey.lights.size()},
      {"world", {{"radiance", {radiance.x, radiance.y, radiance.z}}, {"picture", scene.world.picture >= 0}}},
      {"camera", scene.camera ? json(scene.camera->name) : json()},
      {"outside_model", json::array()}};
  for (const OutsideModel& outside : scene.outside)
    result["outside_model"].push_back(
        {{"owner", outside.owner}, {"what", outside.what}, {"untraced", outside.untraced}});
  return result;
}

void export_to_file(const ResolvedConfig& config, bool json_wanted, std::ostream& out) {
  const fs::path file = choose_file(config.globals);
  if (file.has_parent_path()) make_folders(file.parent_path());
  AtomicFile(file).write(" ");  // never committed: finds out now that nothing can be written there
  LateBlender blender(config.globals);
  BlenderSession session(config, blender);
  const ExportResult exported = export_scene(session);
  write_diffuse_scene(file, exported.diffuse_scene);
  if (json_wanted) {
    out << as_json(exported, file).dump(2) << '\n';
  } else {
    write_text(exported, file, out);
  }
}

}  // namespace

std::function<int()> add_export_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("export", "Write a scene as the reference tracer sees it into one file");
  const auto flags = std::make_shared<ExportFlags>(*command);
  return [flags] {
    const auto config = flags->settings.resolve();
    if (!config) return static_cast<int>(ExitCode::ok);
    StopRequest::install();
    export_to_file(*config, flags->as_json, std::cout);
    return static_cast<int>(ExitCode::ok);
  };
}

}  // namespace rnmbake
