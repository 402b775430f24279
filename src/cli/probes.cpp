#include "cli/probes.h"

#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "base/text.h"
#include "blender/late_blender.h"
#include "cli/flags/settings_flags.h"
#include "cli/run_report.h"
#include "pipeline/probes/picture_probe.h"
#include "pipeline/probes/probes_run.h"
#include "pipeline/run/hold_folder.h"
#include "pipeline/scene/export_scene.h"
#include "pipeline/scene/make_targets.h"
#include "probes/formats/formats.h"
#include "probes/probe_tree.h"
#include "probes/volume_file.h"
#include "process/stop.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

/// Settings that matter for probes.
constexpr std::array probes_settings{
    "samples",         "seed",          "clamp",        "bounces",        "device",         "materials",
    "allow_dark",      "allow_scripts", "atlas_limit",  "memory_limit",   "blender",        "scripts",
    "blender_version", "threads",       "timeout",      "retries",        "launch_timeout",

    "memory_max",      "sandbox",       "sandbox_read", "keep_temporary", "scene",          "view_layer",
    "frame",           "sky",           "sun",          "cache",          "cache_limit",    "lock_wait"};

std::string format_names() {
  std::string names;
  for (const ProbeFormat& format : probe_formats()) {
    names += names.empty() ? "" : "|";
    names += format.name;
  }
  return names;
}

struct ProbesFlags {
  explicit ProbesFlags(CLI::App& command)
      : settings(command, Purpose::reference, probes_settings), run(command) {}

  SettingsFlags settings;
  RunFlags run;
  double spacing = 0;  // 0: not said
  double error = 0;    // percent; 0: not said
  std::string bounds = "auto", lights = "all", by = "reference";
  ProbesOptions options;
  bool no_depth = false;
  std::filesystem::path output;
  std::vector<std::string> to;              // formats of engines
  std::vector<std::filesystem::path> from;  // pictures instead of a scene

  /// Throws Error(usage).
  [[nodiscard]] ProbesOptions checked() const {
    if (output.empty()) fail(ExitCode::usage, "nowhere to write to: pass -o DIR");
    for (const std::string& name : to) (void)probe_format_named(name);
    ProbesOptions made = options;
    if (spacing > 0) made.places.spacing = spacing;
    if (bounds != "auto") made.places.bounds = parse_bounds(bounds);
    made.lights = *probe_lights_of(lights);
    made.source = by == "blender" ? ProbeSource::blender : ProbeSource::reference;
    made.settle.depth = !no_depth;
    if (error > 0 && !made.places.points.empty())
      fail(ExitCode::usage, "--error divides boxes of probes, and --points has none; leave it out");
    made.refine.error = error / 100;
    if (error > 0) made.places.levels = made.refine.levels;
    made.regular = error > 0 && !to.empty();
    return made;
  }
};

void say_what_came_out(const ProbesResult& result, const std::filesystem::path& folder) {
  for (const ProbeVolume& volume : result.volumes) {
    if (!volume.grid) {
      log::info("'{}': {}", volume.name, counted(volume.probes.size(), "point"));
      continue;
    }
    const ProbeGrid& grid = *volume.grid;
    log::info("'{}': {} x {} x {} probes, {:.3g} x {:.3g} x {:.3g} units apart", volume.name, grid.counts[0],
              grid.counts[1], grid.counts[2], grid.steps[0].length(), grid.steps[1].length(),
              grid.steps[2].length());
    if (volume.tree) {
      log::info("'{}': {} with those of its tree, down to 1/{} of that", volume.name, volume.probes.size(),
                1 << depth_of(grid, *volume.tree));
    }
  }
  log::info("{}", (folder / "probes.json").string());
}

/// Files, and how many probes each volume has.
void note_volumes(const std::vector<ProbeVolume>& volumes, const std::filesystem::path& folder,
                  std::vector<std::string> files, RunReport& made) {
  made.output = folder;
  made.main_file = folder / "probes.json";
  made.files = std::move(files);
  made.more["volumes"] = nlohmann::ordered_json::array();
  for (const ProbeVolume& volume : volumes)
    made.more["volumes"].push_back({{"name", volume.name}, {"probes", volume.probes.size()}});
}

/// One probe out of pictures.
int probe_from_pictures(const ProbesFlags& flags, RunReport& made) {
  if (flags.output.empty()) fail(ExitCode::usage, "nowhere to write to: pass -o DIR");
  const DistantLight light = read_light(flags.from);
  ProbeVolume volume = empty_volume("probe", std::vector{Vec3d(0)});
  volume.probes.front() = probe_of(light);
  const FolderLock lock = hold_folder(flags.output);
  note_volumes({volume}, flags.output, write_volumes(flags.output, {volume}, {{"source", "pictures"}}), made);
  made.inputs = flags.from;
  if (!flags.run.json()) std::cout << picture_text(cubes_of(light), study_probe_sphere(light));
  log::info("{}", (flags.output / "probes.json").string());
  return static_cast<int>(ExitCode::ok);
}

int make_probes(const ResolvedConfig& config, const ProbesFlags& flags, RunReport& made) {
  ProbesOptions options = flags.checked();
  LateBlender blender(config.globals);
  if (!is_rnmscene(config.globals.scene.file))
    (void)blender.info();  // throws where it is missing, before any file is written
  (void)plan_reference(config, "5.0");
  const FolderLock lock = hold_folder(flags.output, config.globals.run.lock_wait);
  AtomicFile(flags.output / "probes.json")
      .write(" ");  // never committed: finds out now that nothing can be written
  BlenderSession session(config, blender);
  ExportResult exported = export_surfaces(session);
  check_light(config, exported.diffuse_scene.survey);
  options.lambert = config.globals.scene.materials == SceneSettings::Materials::lambert;
  options.settle.threads = config.globals.run.threads;
  const ReferencePlan plan = plan_reference(config, exported.diffuse_scene.survey.blender_version);
  take_out(options.dynamic, exported.diffuse_scene);
  const TraceScene scene(exported.diffuse_scene, plan.blender_version);
  const ProbesResult result = run_probes(session, exported, scene, plan, options);
  const std::vector<std::string> files = write_volumes(flags.output, result.volumes, result.about);
  made = made_from(config);
  add_scene_inputs(exported.diffuse_scene.survey.inputs, made);
  if (!options.places.points.empty()) made.inputs.push_back(options.places.points);
  note_volumes(result.volumes, flags.output, files, made);
  for (const std::string& name : flags.to) {
    for (const auto& file : write_probe_format(name, result.regular.empty() ? result.volumes : result.regular,
                                               flags.output / name)) {
      log::info("{}: {}", name, file.string());
      made.files.push_back(file.lexically_relative(flags.output).string());
    }
  }
  say_what_came_out(result, flags.output);
  made.more["check"] = check_json(result.check);
  if (!flags.run.json()) std::cout << check_text(result.check);
  return static_cast<int>(ExitCode::ok);
}

}  // namespace

std::function<int()> add_probes_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("probes", "Light what moves: ambient cubes and harmonics in boxes of light probes");
  auto flags = std::make_shared<ProbesFlags>(*command);
  command
      ->add_option("--spacing", flags->spacing,
                   "between the probes of a box, units of the scene [about 1000 probes]")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("X");
  command
      ->add_option(
          "--error", flags->error,
          "put more probes where light between them errs by more than so many percent of the mean "
          "light, as the reference finds it; --spacing is the widest then [about 125 probes at first]")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("PERCENT");
  command
      ->add_option("--levels", flags->options.refine.levels,
                   "with --error: how often the spacing is halved at most, 1 to 6 [3]")
      ->check(CLI::Range(1, most_tree_levels).description(""))
      ->type_name("N");
  command
      ->add_option("--bounds", flags->bounds,
                   "two corners of a box, filled with probes; auto: around all that does not move [auto]")
      ->type_name("X0,Y0,Z0,X1,Y1,Z1");
  command
      ->add_option("--at", flags->options.places.at,
                   "patterns for names of empties, and of Blender's light probe volumes, whose boxes and "
                   "numbers of probes are taken; without --at, --points and a box all of the latter")
      ->delimiter(',')
      ->type_name("A,B,...");
  command
      ->add_option("--points", flags->options.places.points,
                   "a file with x, y and z in each line: probes without a box")
      ->type_name("FILE.csv");
  command
      ->add_option("--dynamic", flags->options.dynamic,
                   "patterns for objects that move: they throw no shadow on probes and send them no light")
      ->delimiter(',')
      ->type_name("A,B,...");
  command
      ->add_option(
          "--lights", flags->lights,
          "all: all light; static: all but what comes straight from lamps, which the engine keeps as "
          "lights of its own; indirect: only what surfaces sent on, neither sky nor glowing "
          "surfaces directly [all]")
      ->check(CLI::IsMember(std::vector<std::string>(probe_lights_names.begin(), probe_lights_names.end()))
                  .description(""))
      ->type_name("all|static|indirect");
  command
      ->add_option("--by", flags->by,
                   "who lights them: the reference tracer, with standard errors, or Blender's Cycles, which "
                   "follows every material [reference]")
      ->check(CLI::IsMember({"reference", "blender"}).description(""))
      ->type_name("reference|blender");
  command
      ->add_option("--to", flags->to, "write files for these engines as well, each into a folder of its name")
      ->delimiter(',')
      ->type_name(format_names());
  command
      ->add_option("--check", flags->options.check,
                   "places between the probes at which the truth is traced, and held against each encoding; "
                   "with --by blender as many probes, too; 0: none [200]")
      ->type_name("N");
  command->add_flag("--two-sided", flags->options.settle.two_sided,
                    "faces have no back: no probe counts as inside of something");
  command->add_flag(
      "--no-depth", flags->no_depth,
      "leave out the distances around each probe, by which light is kept from leaking through walls");
  command->add_option("-o,--output", flags->output, "folder for probes.json and the pictures of each volume")
      ->type_name("DIR");
  command
      ->add_option(
          "--from", flags->from,
          "instead of a scene: a picture of the light around a point in latitudes and longitudes, or "
          "six faces of a cube map, px,nx,py,ny,pz,nz as OpenGL has them; prints how far ambient "
          "cubes by several recipes are apart")
      ->delimiter(',')
      ->type_name("FILE,...");
  return [flags] {
    return flags->run.run([&](RunReport& made) {
      if (!flags->from.empty()) return probe_from_pictures(*flags, made);
      const auto config = flags->settings.resolve();
      if (!config) return static_cast<int>(ExitCode::ok);
      StopRequest::install();
      return make_probes(*config, *flags, made);
    });
  };
}

}  // namespace rnmbake
