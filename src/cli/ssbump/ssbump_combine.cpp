#include "base/error.h"
#include "cli/ssbump/ssbump_tool_flags.h"
#include "cli/ssbump/ssbump_tools.h"
#include "ssbump/map/combine.h"

#include <cmath>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

struct CombineOptions {
  SsbumpInputFlags input;
  SsbumpOutputFlags output;
  std::filesystem::path detail;
  double repeat = 1;
  std::string how = "even";
};

int run_combine(const CombineOptions& options) {
  if (!(options.repeat > 0) || !std::isfinite(options.repeat))
    fail(ExitCode::usage, "--repeat {:g} covers nothing; give a number above 0", options.repeat);
  SsbumpPicture base = options.input.read();
  const SsbumpOutput output = options.output.output(encoding_of(base.metadata));
  const SsbumpPicture detail = read_ssbump(options.detail, {});
  combine_detail(base.weights, detail.weights, options.repeat,
                 options.how == "even" ? Combine::even : Combine::channels);
  base.metadata.settings += fmt::format("{}detail {} x {:g}", base.metadata.settings.empty() ? "" : ", ",
                                        options.how, options.repeat);
  write_ssbump(output, base.metadata, base.weights);
  return static_cast<int>(ExitCode::ok);
}

}  // namespace

std::function<int()> add_ssbump_combine(CLI::App& ssbump) {
  auto options = std::make_shared<CombineOptions>();
  CLI::App* command = ssbump.add_subcommand("combine", "Lay a tiled detail map over a map");
  options->input.add_to(*command);
  command->add_option("--detail", options->detail, "self-shadowed bump map of the detail")
      ->required()
      ->type_name("FILE");
  command->add_option("--repeat", options->repeat, "how often the detail tiles over each axis [1]")
      ->type_name("TIMES");
  command
      ->add_option("--how", options->how,
                   "even: all channels by the detail's mean, which leaves bent normals alone; channels: each "
                   "by its own, which adds the detail's bumps [even]")
      ->check(CLI::IsMember({"even", "channels"}).description(""))
      ->type_name("even|channels");
  options->output.add_to(*command);
  return [options] { return run_combine(*options); };
}

}  // namespace rnmbake
