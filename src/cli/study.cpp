#include "cli/study.h"

#include "base/error.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/text.h"
#include "cli/reference.h"
#include "cli/run_report.h"
#include "config/resolve.h"
#include "config/value.h"
#include "pipeline/run/hold_folder.h"
#include "pipeline/study/study_lights.h"
#include "pipeline/study/study_report.h"
#include "process/stop.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

struct StudyFlags {
  std::string what;
  std::size_t count = 400;
  std::uint64_t seed = 1;
  std::filesystem::path output;
  bool is_probe = false, json = false;
  std::string resolution = "16", error = "3";  // of a scene's truth
};

/// DIR/truth, with what is traced of the scene.
std::filesystem::path traced(const StudyFlags& flags) {
  if (flags.output.empty())
    fail(ExitCode::usage, "{} is a scene, which is traced first: pass -o DIR, where the truth is kept, too",
         flags.what);
  const std::filesystem::path truth = flags.output / "truth";
  std::vector<SettingOverride> given;
  const auto give = [&](const char* key, const std::string& value, const std::string& where) {
    const Setting* setting = find_setting(key);
    given.push_back({setting, parse_value(*setting, value, where), SettingSource::flag, where});
  };
  give("file", flags.what, "argument " + flags.what);
  give("dir", truth.string(), "flag -o");
  give("basis_set", "study", "rnmbake study");
  give("depth", "float", "rnmbake study");
  give("resolution", flags.resolution, "flag --resolution");
  give("error", flags.error, "flag --error");
  const ResolvedConfig config = resolve({}, read_environment(process_environment()), given);
  require_scene(config, Purpose::reference);
  StopRequest::install();
  RunReport made;
  if (trace_reference(config, {}, made) != 0)
    fail(ExitCode::tasks_failed, "{} was not traced as a whole; see above", flags.what);
  return truth;
}

StudyReport study(const StudyFlags& flags) {
  std::optional<Progress> progress;  // made with its first news: a scene is traced before
  const auto update = [&](double share) {
    if (!progress) progress.emplace("studying", progress_for(log::is_quiet(), log::is_jsonl()));
    progress->update(share, flags.what);
  };
  const auto report = [](std::string title, const EncodingStudy& study) {
    return StudyReport{std::move(title), study.lights(), study.errors(), {}, {}};
  };
  const bool pictures = !flags.output.empty();
  if (flags.what == "random") {
    StudyReport found =
        report(fmt::format("{} random hemispheres", flags.count), study_random(flags.count, flags.seed));
    if (pictures) found.pictures = sphere_pictures(sky_and_lamps());
    return found;
  }
  if (flags.is_probe || lower_extension(flags.what) == ".hdr") {
    const FloatImage picture = read_probe(flags.what);
    if (picture.height() > most_probe_rows) {
      log::info("{}: {} rows summed into {}; light finer than {:.1f} degrees is not told apart", flags.what,
                picture.height(), most_probe_rows, 180.0 / most_probe_rows);
    }
    const DistantLight light = probe_light(picture);
    StudyReport found = report(fmt::format("{} surfaces in the light of {}", flags.count,
                                           std::filesystem::path(flags.what).filename().string()),
                               study_probe(light, flags.count, flags.seed, update));
    found.probe = study_probe_sphere(light);
    if (pictures) found.pictures = sphere_pictures(probe_light(picture, 32));
    return found;
  }
  const std::filesystem::path lightmaps =
      is_scene_path(flags.what, Purpose::reference) ? traced(flags) : std::filesystem::path(flags.what);
  return report(std::filesystem::path(flags.what).filename().string(), study_lightmaps(lightmaps, update));
}

int run_study(const StudyFlags& flags) {
  std::optional<FolderLock> lock;
  if (!flags.output.empty()) lock.emplace(hold_folder(flags.output));
  const StudyReport found = study(flags);
  if (!flags.output.empty()) write_study(found, flags.output);
  std::cout << (flags.json ? study_json(found).dump(2) + '\n' : study_text(found));
  return static_cast<int>(ExitCode::ok);
}

}  // namespace

std::function<int()> add_study_command(CLI::App& app) {
  auto flags = std::make_shared<StudyFlags>();
  CLI::App* command = app.add_subcommand("study", "What each encoding loses of a light: a table of errors");
  CLI::App* encodings = command->add_subcommand(
      "encodings", "RMS error and bias of every encoding and packing, by the tilt of the normal");
  command->require_subcommand(1);
  encodings
      ->add_option(
          "lights", flags->what,
          "`random` hemispheres; a probe, that is a picture (.hdr) of the light around a point in "
          "latitudes and longitudes; a scene (.blend, .glb, .gltf, .rnmscene), which is traced; or lightmaps "
          "with more directions than encodings are made from (--basis-set study)")
      ->required()
      ->type_name("random|PROBE|SCENE|LIGHTMAPS");
  encodings->add_flag("--probe", flags->is_probe, "it is a probe, though its name does not end in .hdr");
  encodings
      ->add_option("--count", flags->count, "random hemispheres, or surfaces in the light of a probe [400]")
      ->check(CLI::Range(1, 1000000).description(""))
      ->type_name("N");
  encodings->add_option("--resolution", flags->resolution, "of a scene's lightmaps [16]")->type_name("N");
  encodings
      ->add_option("--error", flags->error,
                   "standard error to trace a scene to, percent of each object's mean [3]")
      ->type_name("PERCENT");
  encodings->add_option("--seed", flags->seed, "of the random hemispheres or surfaces [1]")->type_name("N");
  encodings
      ->add_option("-o,--output", flags->output,
                   "write encodings.html, encodings.md and encodings.json there, and pictures of spheres")
      ->type_name("DIR");
  encodings->add_flag("--json", flags->json, "print what goes into encodings.json instead of the table");
  return [flags] { return run_study(*flags); };
}

}  // namespace rnmbake
