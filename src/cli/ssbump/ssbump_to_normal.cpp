#include "base/error.h"
#include "cli/ssbump/ssbump_tool_flags.h"
#include "cli/ssbump/ssbump_tools.h"
#include "ssbump/map/normals.h"

#include <memory>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

struct ToNormalOptions {
  SsbumpInputFlags input;
  SsbumpOutputFlags output;
  std::string green;
};

int run_to_normal(const ToNormalOptions& options) {
  const SsbumpOutput output = options.output.output({});
  const SsbumpPicture picture = options.input.read();
  const bool y_down =
      options.green.empty() ? picture.metadata.handed == Handed::left : options.green == "y-down";
  FloatImage normals = bent_normals(picture.weights);
  pack_normals(normals, y_down);
  PictureWriter writer(output.file, normal_map_form(normals.width(), normals.height(),
                                                    storage_of(output.file, output.bits), y_down));
  writer.write(0, normals.height(), normals.data());
  writer.commit();
  return static_cast<int>(ExitCode::ok);
}

}  // namespace

std::function<int()> add_ssbump_to_normal(CLI::App& ssbump) {
  auto options = std::make_shared<ToNormalOptions>();
  CLI::App* command =
      ssbump.add_subcommand("to-normal", "The bent normal of every texel, normalise(sum of s_i B_i)");
  options->input.add_to(*command);
  options->output.add_to(*command, false);
  command->add_option("--green", options->green, "where green points [as the map's handedness]")
      ->check(CLI::IsMember({"y-up", "y-down"}).description(""))
      ->type_name("y-up|y-down");
  return [options] { return run_to_normal(*options); };
}

}  // namespace rnmbake
