#include "cli/ssbump/nms.h"

#include "base/error.h"
#include "base/log.h"
#include "encoding/encodings.h"
#include "image/picture_rows.h"
#include "lightmap/decode.h"
#include "ssbump/map/normal_map.h"
#include "ssbump/map/slope_curl.h"
#include "ssbump/normal_shadows/lightmap_shadows.h"
#include "ssbump/normal_shadows/normal_shadows.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

struct NmsOptions {
  std::filesystem::path normal, lightmap, output;
  std::vector<float> light;
  std::vector<int> repeat{1, 1};
  NormalMapFormat format;
  NormalShadowOptions shadows;
  float hardness = -1;
  std::uint32_t seed = 0;
  bool jitter = false, clamp = false, lit = false, check = false, json = false;
  int bits = 8;
  double bound = 0.1;
};

constexpr int largest_side = 1 << 16;

Vec3 light_of(const NmsOptions& options) {
  const auto& l = options.light;
  const Vec3 light = l.size() == 3 ? Vec3(l[0], l[1], l[2]) : Vec3(0);
  const float length = light.length();
  if (!(length > 0) || !std::isfinite(length))
    fail(ExitCode::usage, "--light needs three numbers, not all 0, towards the light; such as 0.6,0,0.8");
  if (light.z <= 0) {
    fail(ExitCode::usage, "--light {},{},{} comes from below the surface; its z must be above 0", l[0], l[1],
         l[2]);
  }
  return light / length;
}

Storage storage_of(const NmsOptions& options) {
  const std::string ending = options.output.extension().string();
  if (ending == ".exr" || ending == ".EXR") return Storage::full;
  return options.bits == 16 ? Storage::u16 : Storage::u8;
}

/// Throws Error(usage) for outputs that cannot be written, before the work.
void check_output(const NmsOptions& options) {
  if (options.output.empty()) fail(ExitCode::usage, "nowhere to write to; pass -o FILE.png or FILE.exr");
  const Storage storage = storage_of(options);
  const std::string obstacle = storage_obstacle(options.output, storage);
  if (!obstacle.empty()) fail(ExitCode::usage, "cannot write {}: {}", options.output.string(), obstacle);
  if (!options.lightmap.empty() && storage != Storage::full) {
    fail(ExitCode::usage, "{}: a lit lightmap is E/pi and has no upper limit; pass -o FILE.exr",
         options.output.string());
  }
}

NormalShadowOptions shadow_options(const NmsOptions& options) {
  NormalShadowOptions shadows = options.shadows;
  if (options.hardness >= 0) shadows.hardness = options.hardness;
  if (options.jitter) shadows.jitter = options.seed;
  shadows.border = options.clamp ? Border::clamp : Border::wrap;
  return shadows;
}

std::map<std::string, Attribute> attributes_of(const NmsOptions& options, const std::string& what) {
  const NormalShadowOptions shadows = shadow_options(options);
  std::map<std::string, Attribute> attributes{
      {"rnmbake:normal_shadows", what},
      {"rnmbake:length", shadows.length},
      {"rnmbake:steps", shadows.steps},
      {"rnmbake:hardness", shadows.hardness_used()},
      {"rnmbake:shadow", std::string(shadows.hard ? "hard" : "soft")}};
  if (shadows.true_slopes) attributes["rnmbake:true_slopes"] = 1;
  if (!options.light.empty()) attributes["rnmbake:light"] = options.light;
  return attributes;
}

void write(const NmsOptions& options, const FloatImage& image, const std::string& what) {
  const bool colour = image.channels() == 3;
  PictureWriter writer(options.output,
                       {image.width(), image.height(),
                        colour ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"},
                        storage_of(options), attributes_of(options, what)});
  writer.write(0, image.height(), image.data());
  writer.commit();
}

void check_finite(const FloatImage& map, std::string_view name, const std::filesystem::path& file) {
  const auto bad = std::ranges::find_if_not(map.data(), [](float value) { return std::isfinite(value); });
  if (bad == map.data().end()) return;
  const auto texel = static_cast<int>((bad - map.data().begin()) / map.channels());
  fail(ExitCode::invalid_input, "{}: layer {} is not finite at texel ({}, {}); bake it again with --repair",
       file.string(), name, texel % map.width(), texel / map.width());
}

BakedLight baked_light(const std::filesystem::path& file) {
  const LayeredImage image = read_image(file);
  const auto refuse = [&](const std::string& why) {
    fail(ExitCode::unsupported,
         "{} does not tell the direction of its light: {}; bake flat and the Half-Life 2 basis, not "
         "normalized",
         file.string(), why);
  };
  if (!has_metadata(image)) refuse("its header names no convention");
  const LightmapMetadata metadata = read_metadata(image, file.string());
  if (const auto why = decode_obstacle(metadata, DecodeVariant::linear)) refuse(*why);
  Lightmap lightmap = lightmap_of(image, metadata);
  if (!lightmap.holds(flat_encoding)) refuse("it has no flat layer");
  if (!lightmap.holds(rnm_encoding)) refuse("a layer of rnm0, rnm1, rnm2 is missing");
  const auto finite = [&](std::string_view layer) {
    FloatImage map = lightmap.take(layer);
    check_finite(map, layer, file);
    return map;
  };
  FloatImage flat = finite(flat_layers.front());
  std::array<FloatImage, 3> rnm{finite(rnm_layers[0]), finite(rnm_layers[1]), finite(rnm_layers[2])};
  return {std::move(flat), std::move(rnm), std::move(lightmap.coverage), metadata.green == Green::y_down};
}

SlopeCurl curl_of(const NmsOptions& options, const FloatImage& normals, int scale) {
  return slope_curl(normals, {options.clamp ? Border::clamp : Border::wrap, options.bound, scale});
}

/// Warns where the slopes fit a surface better with the green channel reversed.
void warn_of_green(const NmsOptions& options, const FloatImage& normals) {
  const SlopeCurl curl = curl_of(options, normals, 1);
  constexpr double rounding = 0.01;  // curl of flat normals in 8 bits is below
  if (curl.rms < rounding || curl.relative_flipped * 1.5 > curl.relative) return;
  log::warn("{}: its slopes fit together better with --green {}; is green right?", options.normal.string(),
            options.format.y_down ? "up" : "down");
}

std::string row_of(const SlopeCurl& curl, int scale) {
  return fmt::format("{:>6}  {:<9.3g}  {:<9.3g} at {:<14}  {:>6.2f} %  {:>8.3f}  {:>12.3f}\n", scale,
                     curl.rms, curl.worst, fmt::format("({}, {})", curl.worst_x, curl.worst_y),
                     100 * curl.share_above, curl.relative, curl.relative_flipped);
}

nlohmann::json json_of(const SlopeCurl& curl, int scale) {
  return {{"scale", scale},
          {"places", curl.places},
          {"rms", curl.rms},
          {"worst", curl.worst},
          {"worst_texel", {curl.worst_x, curl.worst_y}},
          {"share_above", curl.share_above},
          {"relative", curl.relative},
          {"relative_green_turned", curl.relative_flipped}};
}

void check_integrability(const NmsOptions& options, const FloatImage& normals) {
  nlohmann::json json{{"schema_version", 1},      {"normal", options.normal.string()},
                      {"width", normals.width()}, {"height", normals.height()},
                      {"bound", options.bound},   {"scales", nlohmann::json::array()}};
  std::string text =
      fmt::format("curl of the slopes, over squares of so many texels; above {:g}\n", options.bound) +
      " scale  RMS        worst                         above     relative  green turned\n";
  for (const int scale : {1, 4, 16}) {
    if (scale > 1 && std::min(normals.width(), normals.height()) < 4 * scale) break;
    const SlopeCurl curl = curl_of(options, normals, scale);
    text += row_of(curl, scale);
    json["scales"].push_back(json_of(curl, scale));
  }
  text += "relative: 0 for the slopes of a surface, 1 for slopes that have nothing to do with each other\n";
  std::cout << (options.json ? json.dump(2) + "\n" : text);
}

void shadow_lightmap(const NmsOptions& options, const FloatImage& normals) {
  const Repeat repeat{options.repeat[0], options.repeat[1]};
  if (normals.width() > largest_side / repeat.u || normals.height() > largest_side / repeat.v) {
    fail(ExitCode::usage, "--repeat {},{} of {}x{} texels is more than {} a side; repeat less, or scale down",
         repeat.u, repeat.v, normals.width(), normals.height(), largest_side);
  }
  const BakedLight baked = baked_light(options.lightmap);
  write(options, lightmap_shadows(normals, baked, repeat, shadow_options(options)),
        "E/pi of a lightmap, its dominant direction shadowed");
}

void shadow_light(const NmsOptions& options, const FloatImage& normals) {
  const Vec3 light = light_of(options);
  const FloatImage left = normal_shadows(normals, light, shadow_options(options));
  if (options.lit)
    write(options, lit_by(normals, light, left), "cosine times light left");
  else
    write(options, left, "light left");
}

int run_nms(const NmsOptions& options) {
  const int ways = int(!options.light.empty()) + int(!options.lightmap.empty()) + int(options.check);
  if (ways != 1) {
    fail(ExitCode::usage, "nms does one of three things; give --light X,Y,Z, or --lightmap FILE, or --check");
  }
  if (!options.light.empty()) (void)light_of(options);
  if (!options.check) check_output(options);
  const FloatImage normals =
      unit_normals(read_image(options.normal), options.normal.string(), options.format);
  if (options.check) {
    check_integrability(options, normals);
    return 0;
  }
  warn_of_green(options, normals);
  if (options.lightmap.empty())
    shadow_light(options, normals);
  else
    shadow_lightmap(options, normals);
  return 0;
}

void add_normals(CLI::App& command, NmsOptions& options) {
  command.add_option("--normal", options.normal, "tangent-space normal map (.png, .jpg, .exr, ...)")
      ->required()
      ->type_name("FILE");
  command.add_flag(
      "--two-channel", options.format.two_channel,
      "x and y are the first two channels, z is rebuilt; as is done for pictures of two channels");
  command
      .add_option_function<std::string>(
          "--green", [&options](const std::string& way) { options.format.y_down = way == "down"; },
          "where green points: up (Blender, glTF, Unity, Godot) or down (Unreal, Source) [up]")
      ->check(CLI::IsMember({"up", "down"}).description(""))
      ->type_name("up|down");
  command
      .add_option_function<std::string>(
          "--wrap", [&options](const std::string& way) { options.clamp = way == "clamp"; },
          "beyond the border: the map again, or its last texel [tile]")
      ->check(CLI::IsMember({"tile", "clamp"}).description(""))
      ->type_name("tile|clamp");
}

void add_light(CLI::App& command, NmsOptions& options) {
  command
      .add_option("--light", options.light,
                  "one light: the direction towards it in tangent space (x right, y up the picture, z out)")
      ->delimiter(',')
      ->type_name("X,Y,Z");
  command
      .add_option(
          "--lightmap", options.lightmap,
          "or a lightmap in the normal map's UVs, with flat and the three maps: writes it decoded, with the "
          "light from each texel's dominant direction shadowed. An extension of ours, not of the published "
          "method")
      ->type_name("FILE");
  command
      .add_option("--repeat", options.repeat,
                  "with --lightmap: the normal map lies over it this many times [1,1]")
      ->delimiter(',')
      ->expected(2)
      ->check(CLI::Range(1, 4096).description(""))
      ->needs("--lightmap")
      ->type_name("U,V");
}

void add_parameters(CLI::App& command, NmsOptions& options) {
  command
      .add_option("--length", options.shadows.length,
                  "H: how far shadows reach at grazing light, as a share of the map's longer side [0.22]")
      ->check(CLI::Range(1e-4F, 4.0F).description(""))
      ->type_name("SHARE");
  command.add_option("--steps", options.shadows.steps, "N: lookups on the way [32]")
      ->check(CLI::Range(1, 65536).description(""))
      ->type_name("N");
  command.add_option("--hardness", options.hardness, "how fast soft shadows darken [50 H]")
      ->check(CLI::Range(0.0F, 1e6F).description(""))
      ->type_name("FACTOR");
  command.add_flag("--hard", options.shadows.hard, "shadow or not, nothing between");
  command.add_flag(
      "--true-slopes", options.shadows.true_slopes,
      "sum dot(light, n) / n.z, which is how far the surface rises over the ray, where the method sums "
      "dot(light, n): finds more of the shadows. An extension of ours");
  command.add_flag("--jitter", options.jitter,
                   "each texel starts a random part of a step earlier: noise, not bands");
  command.add_option("--seed", options.seed, "of --jitter [0]")->needs("--jitter")->type_name("N");
}

void add_results(CLI::App& command, NmsOptions& options) {
  command
      .add_option(
          "-o,--output", options.output,
          "what to write: the share of the light that is left, as data (.png, .tif, or .exr in floats)")
      ->type_name("FILE");
  command.add_flag("--lit", options.lit, "write that share times the cosine between light and normal")
      ->needs("--light");
  command.add_option("--bits", options.bits, "of .png and .tif [8]")
      ->check(CLI::IsMember({8, 16}).description(""))
      ->type_name("8|16");
  command.add_flag(
      "--check", options.check,
      "print how far the normal map is from any surface: the curl of its slopes; writes nothing");
  command
      .add_option("--bound", options.bound, "with --check: count the texels with more curl than this [0.1]")
      ->check(CLI::Range(0.0, 1e6).description(""))
      ->needs("--check")
      ->type_name("CURL");
  command.add_flag("--json", options.json, "with --check: one JSON object instead of the text")
      ->needs("--check");
}

}  // namespace

std::function<int()> add_nms_command(CLI::App& app) {
  auto options = std::make_shared<NmsOptions>();
  CLI::App* command = app.add_subcommand("nms", "Shadows out of a normal map alone (normal mapping shadows)");
  add_normals(*command, *options);
  add_light(*command, *options);
  add_parameters(*command, *options);
  add_results(*command, *options);
  return [options] { return run_nms(*options); };
}

}  // namespace rnmbake
