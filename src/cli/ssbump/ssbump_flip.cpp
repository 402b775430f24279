#include "base/error.h"
#include "base/log.h"
#include "cli/ssbump/ssbump_tool_flags.h"
#include "cli/ssbump/ssbump_tools.h"

#include <memory>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

struct FlipOptions {
  SsbumpInputFlags input;
  SsbumpOutputFlags output;
};

int run_flip(const FlipOptions& options) {
  SsbumpPicture picture = options.input.read();
  SsbumpMetadata& metadata = picture.metadata;
  metadata.handed = metadata.handed == Handed::right ? Handed::left : Handed::right;
  SsbumpOutput output = options.output.output(encoding_of(metadata));
  output.dither = false;  // the values stay; only their places change
  write_ssbump(output, metadata, picture.weights);
  log::info("{}: now {}-handed", output.file.string(), name_of(metadata.handed));
  return static_cast<int>(ExitCode::ok);
}

}  // namespace

std::function<int()> add_ssbump_flip(CLI::App& ssbump) {
  auto options = std::make_shared<FlipOptions>();
  CLI::App* command =
      ssbump.add_subcommand("flip", "Right-handed to left-handed or back: swaps channels 2 and 3");
  options->input.add_to(*command);
  options->output.add_to(*command, false);
  return [options] { return run_flip(*options); };
}

}  // namespace rnmbake
