#include "cli/study.h"

#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/text.h"
#include "pipeline/study/study_lights.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

struct StudyFlags {
  std::string what;
  std::size_t count = 400;
  std::uint64_t seed = 1;
  std::filesystem::path output;
  bool json = false;
};

EncodingStudy study(const StudyFlags& flags) {
  if (flags.what == "random") return study_random(flags.count, flags.seed);
  Progress progress("studying", progress_for(log::is_quiet(), log::is_jsonl()));
  return study_lightmaps(flags.what, [&](double share) { progress.update(share, flags.what); });
}

int run_study(const StudyFlags& flags) {
  const EncodingStudy studied = study(flags);
  const std::vector<EncodingErrors> errors = studied.errors();
  const std::string json = study_json(errors, studied.lights());
  if (!flags.output.empty()) {
    make_folders(flags.output);
    write_atomically(flags.output / "encodings.md", study_markdown(errors));
    write_atomically(flags.output / "encodings.json", json);
  }
  if (flags.json) {
    std::cout << json;
  } else {
    std::cout << "RMS error, percent of the flat light, over normals tilted up to so many degrees; "
              << counted(studied.lights(), "light") << "\n\n"
              << study_table(errors);
    for (const EncodingErrors& one : errors)
      if (!one.unfit.empty())
        std::cout << '\n' << printable(one.label) << ": " << printable(one.unfit) << '\n';
  }
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
      ->add_option("lights", flags->what,
                   "`random` hemispheres, or lightmaps that were baked for flat, rnm0 to rnm2 and for the "
                   "directions to "
                   "test at (--basis)")
      ->required()
      ->type_name("random|LIGHTMAPS");
  encodings->add_option("--count", flags->count, "random hemispheres [400]")
      ->check(CLI::Range(1, 1000000).description(""))
      ->type_name("N");
  encodings->add_option("--seed", flags->seed, "of the random hemispheres [1]")->type_name("N");
  encodings->add_option("-o,--output", flags->output, "write encodings.md and encodings.json there")
      ->type_name("DIR");
  encodings->add_flag("--json", flags->json, "print what goes into encodings.json instead of the table");
  return [flags] { return run_study(*flags); };
}

}  // namespace rnmbake
