#include "cli/decode.h"

#include "base/error.h"
#include "base/log.h"
#include "base/text.h"
#include "encoding/basis_set.h"
#include "image/layer_rows.h"
#include "image/layered_exr.h"
#include "lightmap/decode.h"
#include "lightmap/layout.h"
#include "pipeline/decode/decode_rows.h"
#include "pipeline/decode/lit_writer.h"
#include "pipeline/ssbump/decode_directions.h"
#include "pipeline/ssbump/decode_ssbump.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

struct DecodeOptions {
  std::filesystem::path lightmap, normal_map, ssbump, output;
  std::string ssbump_scale, ssbump_handed;
  std::vector<float> normal_vector;   // three numbers, unless there is a normal map
  std::string variant, normal_green;  // "": by the lightmap's header; y-up
  bool flip_green = false, force = false;
  float exposure = 0;
};

DecodeVariant variant_of(const DecodeOptions& options) {
  for (const auto variant :
       {DecodeVariant::linear, DecodeVariant::vrad, DecodeVariant::single, DecodeVariant::encoded})
    if (options.variant == name_of(variant)) return variant;
  return DecodeVariant::squared;
}

Green green_of(const DecodeOptions& options) {
  return options.normal_green == "y-down" ? Green::y_down : Green::y_up;
}

[[noreturn]] void refuse(const DecodeOptions& options, const std::string& why, const std::string& remedy) {
  fail(ExitCode::unsupported, "{} does not fit the {} decode: {}; {}", options.lightmap.string(),
       name_of(variant_of(options)), why, remedy);
}

/// Metadata that rnmbake writes by default, in place of an unusable header.
LightmapMetadata assumed_metadata(const DecodeOptions& options, const std::string& why) {
  log::warn("{}: {}; decoded as an RNM lightmap in E/pi, y-up, not normalized", options.lightmap.string(),
            why);
  LightmapMetadata metadata;
  metadata.bases = rnm_set().directions;
  return metadata;
}

LightmapMetadata metadata_of(const DecodeOptions& options, const LayeredImage& image) {
  const auto layer = image.attributes.find(layer_attribute);
  const bool is_flat = layer != image.attributes.end() && layer->second == Attribute(flat_direction().name);
  if (layer != image.attributes.end() && !(is_flat && variant_of(options) == DecodeVariant::single)) {
    refuse(options, "it holds one layer of a lightmap only",
           "decode the file of a bake with --layout layers");
  }
  if (!has_metadata(image)) {
    const char* why = "its header names no convention";
    if (!options.force) refuse(options, why, "decode a lightmap that rnmbake wrote, or add --force");
    return assumed_metadata(options, why);
  }
  try {
    return read_metadata(image, options.lightmap.string());
  } catch (const Error& error) {
    if (!options.force) throw;
    return assumed_metadata(options, error.what());
  }
}

void check_fit(const DecodeOptions& options, const LightmapMetadata& metadata) {
  if (const auto why = decode_obstacle(metadata, variant_of(options))) {
    if (!options.force) refuse(options, *why, "choose another --variant, or add --force");
    log::warn("{}: {}; decoded all the same", options.lightmap.string(), *why);
  }
  const bool uses_normal = variant_of(options) != DecodeVariant::single && options.ssbump.empty();
  if (uses_normal && options.normal_green.empty() && metadata.green == Green::y_down && !options.force) {
    refuse(options, "it was baked for y-down normal maps and the normals are taken as y-up",
           "say --normal-green y-down (or --flip-green) or --normal-green y-up");
  }
}

LitWriter writer_for(const DecodeOptions& options, int width, int height) {
  const std::string variant = options.ssbump.empty() ? options.variant : "ssbump, " + options.variant;
  return {options.output, width, height, variant, options.exposure};
}

void write(const DecodeOptions& options, FloatImage&& picture) {
  LitWriter writer = writer_for(options, picture.width(), picture.height());
  const int height = picture.height();
  writer.write(0, height, std::move(picture));
  writer.commit();
}

/// The lightmap as a whole, for pictures of another size than its own.
Lightmap whole_lightmap(const DecodeOptions& options, const LightmapMetadata& metadata) {
  return lightmap_of(read_image(options.lightmap), metadata);
}

void decode_under_ssbump(const DecodeOptions& options, const LightmapMetadata& metadata) {
  const SsbumpHints hints{scale_named(options.ssbump_scale), handed_named(options.ssbump_handed), {}};
  const SsbumpPicture weights = read_ssbump(options.ssbump, hints);
  write(options, decode_ssbump(whole_lightmap(options, metadata), weights, variant_of(options)));
}

void decode_under_normals(const DecodeOptions& options, LayerRows& lightmap,
                          const LightmapMetadata& metadata) {
  const int width = lightmap.facts().width, height = lightmap.facts().height;
  std::optional<NormalRows> normals;
  if (!options.normal_map.empty()) normals.emplace(options.normal_map);
  if (normals && (normals->width() != width || normals->height() != height)) {
    const LayeredImage picture = read_image(options.normal_map);
    const NormalPicture whole{normals_of(picture, options.normal_map.string()), green_of(options)};
    return write(options, decode(whole_lightmap(options, metadata), whole, variant_of(options)));
  }
  LitWriter writer = writer_for(options, width, height);
  const TakeRows take = [&](int begin, int end, FloatImage&& lit) {
    writer.write(begin, end, std::move(lit));
  };
  if (normals) {
    decode_rows(lightmap, metadata, *normals, green_of(options), variant_of(options), take);
  } else {
    const auto& n = options.normal_vector;
    decode_rows(lightmap, metadata, Vec3(n[0], n[1], n[2]), green_of(options), variant_of(options), take);
  }
  writer.commit();
}

void check_vector(const std::vector<float>& n) {
  if (n.empty()) {
    fail(ExitCode::usage,
         "decode needs normals or a self-shadowed bump map; give --normal FILE, --normal-vector X,Y,Z or "
         "--ssbump FILE");
  }
  const float length = n.size() == 3 ? Vec3(n[0], n[1], n[2]).length() : 0;
  if (length > 0 && std::isfinite(length)) return;
  fail(ExitCode::usage, "--normal-vector {} is not a direction; give three numbers such as 0,0,1",
       fmt::join(n, ","));
}

void check_options(DecodeOptions& options) {
  const std::string extension = lower_extension(options.output);
  if (extension != ".exr" && extension != ".png") {
    fail(ExitCode::usage, "cannot write {}: the output must end in .exr or .png", options.output.string());
  }
  if (options.normal_map.empty() && options.ssbump.empty()) check_vector(options.normal_vector);
  const bool fits_ssbump =
      options.variant.empty() || options.variant == "squared" || options.variant == "vrad";
  if (!options.ssbump.empty() && !fits_ssbump) {
    fail(ExitCode::usage,
         "--variant {} is for normals; with --ssbump maps are taken as they are (squared) or scaled to the "
         "flat bake (vrad)",
         options.variant);
  }
  if (options.flip_green) options.normal_green = "y-down";
}

/// A self-shadowed bump map of a set of directions; nothing for all else.
std::optional<DirectionMap> direction_map_of(const DecodeOptions& options) {
  if (options.ssbump.empty()) return std::nullopt;
  auto map = read_direction_map(options.ssbump);
  if (!map) return std::nullopt;
  if (!options.variant.empty() || !options.ssbump_scale.empty() || !options.ssbump_handed.empty()) {
    fail(ExitCode::usage,
         "{} holds weights for lightmaps as they are baked; leave out --variant, --ssbump-scale and "
         "--ssbump-handed",
         options.ssbump.string());
  }
  return map;
}

int run_decode(DecodeOptions options) {
  check_options(options);
  const auto directions = direction_map_of(options);
  LayerRows lightmap(options.lightmap);
  const LightmapMetadata metadata = metadata_of(options, lightmap.header());
  if (directions) {
    options.variant = directions->metadata.set.name;
    write(options, decode_directions(whole_lightmap(options, metadata), *directions));
    return static_cast<int>(ExitCode::ok);
  }
  if (options.variant.empty() && options.ssbump.empty()) options.variant = name_of(natural_variant(metadata));
  if (options.variant.empty()) options.variant = name_of(DecodeVariant::squared);
  check_fit(options, metadata);
  if (options.ssbump.empty()) {
    decode_under_normals(options, lightmap, metadata);
  } else {
    decode_under_ssbump(options, metadata);
  }
  return static_cast<int>(ExitCode::ok);
}

void add_pictures(CLI::App& command, DecodeOptions& options) {
  command.add_option("lightmap", options.lightmap, "a lightmap that rnmbake wrote (.exr)")
      ->required()
      ->type_name("FILE");
  auto* normal_map =
      command
          .add_option("--normal", options.normal_map,
                      "tangent-space normal map (.png, .jpg, .exr, ...) in the lightmap's UV layout")
          ->type_name("FILE");
  command
      .add_option("--normal-vector", options.normal_vector,
                  "or one tangent-space normal for all texels, such as 0,0,1")
      ->delimiter(',')
      ->type_name("X,Y,Z")
      ->excludes(normal_map);
  auto* ssbump =
      command
          .add_option("--ssbump", options.ssbump,
                      "or a self-shadowed bump map: E = sum of s_i LM_i, in the lightmap's UV layout")
          ->type_name("FILE")
          ->excludes(normal_map)
          ->excludes(command.get_option("--normal-vector"));
  command.add_option("--ssbump-scale", options.ssbump_scale, "of a map that does not say its scale [third]")
      ->check(CLI::IsMember({"third", "ndotb", "mod2x"}).description(""))
      ->type_name("third|ndotb|mod2x")
      ->needs(ssbump);
  command.add_option("--ssbump-handed", options.ssbump_handed, "of a map that does not say [right]")
      ->check(CLI::IsMember({"right", "left"}).description(""))
      ->type_name("right|left")
      ->needs(ssbump);
  command
      .add_option("-o,--output", options.output,
                  "what to write: .exr (E/pi, float) or .png (to look at: clamped to [0,1] and sRGB-encoded)")
      ->required()
      ->type_name("FILE");
}

void add_meaning(CLI::App& command, DecodeOptions& options) {
  command
      .add_option(
          "--variant", options.variant,
          "squared: sum w LM / sum w, w = sat(dot)^2; linear: sum sat(dot) LM; vrad: squared on maps "
          "scaled to the flat bake; single: the flat bake; encoded: as rnmbake convert wrote it [squared, or "
          "encoded]. Of maps baked without --normalize flat, "
          "squared returns 0.789 of a uniform sky and 0.577 of an overhead sun for a flat normal")
      ->check(CLI::IsMember({"squared", "linear", "vrad", "single", "encoded"}).description(""))
      ->type_name("squared|linear|vrad|single|encoded");
  auto* green =
      command.add_option("--normal-green", options.normal_green, "where the normals' green points [y-up]")
          ->check(CLI::IsMember({"y-up", "y-down"}).description(""))
          ->type_name("y-up|y-down");
  command
      .add_flag("--flip-green", options.flip_green,
                "the normals are y-down (Unreal, Source), as --normal-green y-down")
      ->excludes(green);
}

}  // namespace

std::function<int()> add_decode_command(CLI::App& app) {
  auto options = std::make_shared<DecodeOptions>();
  CLI::App* command = app.add_subcommand(
      "decode", "Light a normal map or a self-shadowed bump map with a lightmap, as a shader would");
  add_pictures(*command, *options);
  add_meaning(*command, *options);
  command->add_option("--exposure", options->exposure, "multiply the result by 2^STOPS [0]")
      ->type_name("STOPS");
  command->add_flag("--force", options->force, "decode although the header says that the maps do not fit");
  return [options] { return run_decode(*options); };
}

}  // namespace rnmbake
