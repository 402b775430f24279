#include "base/error.h"
#include "cli/ssbump/ssbump_tool_flags.h"
#include "cli/ssbump/ssbump_tools.h"
#include "ssbump/map/compression_error.h"

#include <array>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

struct CompressCheckOptions {
  SsbumpInputFlags input;
  bool json = false;
};

constexpr std::array formats{TextureFormat::rgb8, TextureFormat::rgb565, TextureFormat::bc1,
                             TextureFormat::bc7};
constexpr std::array scales{SsbumpScale::third, SsbumpScale::ndotb, SsbumpScale::mod2x};

nlohmann::ordered_json json_of(TextureFormat format, SsbumpScale scale, const CompressionError& error) {
  return {{"format", name_of(format)},
          {"scale", name_of(scale)},
          {"bits_per_texel", bits_per_texel(format)},
          {"diffuse", {{"rms", error.diffuse_rms}, {"bias", error.diffuse_bias}, {"max", error.diffuse_max}}},
          {"bent_normal_degrees",
           {{"mean", error.angle_mean}, {"p95", error.angle_p95}, {"max", error.angle_max}}}};
}

std::string row_of(TextureFormat format, SsbumpScale scale, const CompressionError& error) {
  return fmt::format("{:<7} {:<6} {:>4.0f} {:>10.2f} % {:>8.2f} % {:>8.2f} % {:>9.2f} {:>7.2f} {:>7.2f}\n",
                     name_of(format), name_of(scale), bits_per_texel(format), 100 * error.diffuse_rms,
                     100 * error.diffuse_bias, 100 * error.diffuse_max, error.angle_mean, error.angle_p95,
                     error.angle_max);
}

int run_compress_check(const CompressCheckOptions& options) {
  const SsbumpPicture picture = options.input.read();
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  std::string table = fmt::format("{:<7} {:<6} {:>4} {:>12} {:>10} {:>10} {:>9} {:>7} {:>7}\n", "format",
                                  "scale", "bits", "diffuse RMS", "bias", "max", "bent mean", "95 %", "max");
  for (const TextureFormat format : formats) {
    for (const SsbumpScale scale : scales) {
      SsbumpEncoding encoding = encoding_of(picture.metadata);
      encoding.scale = scale;
      const CompressionError error = compression_error(picture.weights, encoding, format);
      json.push_back(json_of(format, scale, error));
      table += row_of(format, scale, error);
    }
  }
  std::cout << (options.json ? json.dump(2) + '\n'
                             : table +
                                   "\nDiffuse: share of what the open surface receives. Bent normals: "
                                   "degrees; reflections are off by twice that.\n");
  return static_cast<int>(ExitCode::ok);
}

}  // namespace

std::function<int()> add_ssbump_compress_check(CLI::App& ssbump) {
  auto options = std::make_shared<CompressCheckOptions>();
  CLI::App* command = ssbump.add_subcommand(
      "compress-check", "What RGB565, BC1 (DXT1) and BC7 do to a map's light and bent normals");
  options->input.add_to(*command);
  command->add_flag("--json", options->json, "a JSON list instead of the table");
  return [options] { return run_compress_check(*options); };
}

}  // namespace rnmbake
