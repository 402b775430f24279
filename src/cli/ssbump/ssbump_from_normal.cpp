#include "base/error.h"
#include "cli/ssbump/ssbump_tool_flags.h"
#include "cli/ssbump/ssbump_tools.h"
#include "image/layered_exr.h"
#include "ssbump/map/normal_map.h"
#include "ssbump/map/normals.h"

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

struct FromNormalOptions {
  std::filesystem::path normal;
  NormalMapFormat format;
  std::string green = "y-up", scale = "third", handed;
  SsbumpOutputFlags output;
};

int run_from_normal(const FromNormalOptions& options) {
  NormalMapFormat format = options.format;
  format.y_down = options.green == "y-down";
  const Handed as_green = format.y_down ? Handed::left : Handed::right;
  const SsbumpOutput output = options.output.output(
      {*scale_named(options.scale), handed_named(options.handed).value_or(as_green), SsbumpAlpha::none});
  const FloatImage normals = unit_normals(read_image(options.normal), options.normal.string(), format);
  SsbumpMetadata metadata;
  metadata.method = "normal map";
  metadata.settings = "no shadows";
  write_ssbump(output, metadata, weights_of_normals(normals));
  return static_cast<int>(ExitCode::ok);
}

}  // namespace

std::function<int()> add_ssbump_from_normal(CLI::App& ssbump) {
  auto options = std::make_shared<FromNormalOptions>();
  CLI::App* command = ssbump.add_subcommand(
      "from-normal", "A normal map as self-shadowed bump map, sat(N . B_i): no shadows");
  command->add_option("normal", options->normal, "tangent-space normal map")->required()->type_name("FILE");
  options->output.add_to(*command);
  command->add_option("--green", options->green, "where green points [y-up]")
      ->check(CLI::IsMember({"y-up", "y-down"}).description(""))
      ->type_name("y-up|y-down");
  command->add_flag("--two-channel", options->format.two_channel, "x and y only; z is worked out");
  command->add_option("--scale", options->scale, "what a flat normal stores [third]")
      ->check(CLI::IsMember({"third", "ndotb", "mod2x"}).description(""))
      ->type_name("third|ndotb|mod2x");
  command->add_option("--handed", options->handed, "of the map to write [right for y-up, left for y-down]")
      ->check(CLI::IsMember({"right", "left"}).description(""))
      ->type_name("right|left");
  return [options] { return run_from_normal(*options); };
}

}  // namespace rnmbake
