#include "cli/ssbump/ssbump_flags.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

CLI::Validator one_of(const std::vector<std::string>& words) {
  return CLI::IsMember(words).description("");
}

void check_not_negative(const char* flag, const std::optional<double>& value) {
  if (value && !(*value >= 0 && std::isfinite(*value)))
    fail(ExitCode::usage, "{} {:g} is no height; give a number from 0 up, and --invert for depths", flag,
         *value);
}

std::optional<WrapMode> axis_named(const std::string& word) {
  if (word == "wrap") return WrapMode::wrap;
  if (word == "mirror") return WrapMode::mirror;
  if (word == "none") return WrapMode::none;
  return std::nullopt;
}

}  // namespace

void parse_wrap(const std::string& text, WrapMode& x, WrapMode& y) {
  x = y = WrapMode::none;
  if (text == "x" || text == "x,y" || text == "y,x") x = WrapMode::wrap;
  if (text == "y" || text == "x,y" || text == "y,x") y = WrapMode::wrap;
  if (x == WrapMode::wrap || y == WrapMode::wrap) return;
  const auto comma = text.find(',');
  const auto first = axis_named(text.substr(0, comma));
  const auto second = comma == std::string::npos ? first : axis_named(text.substr(comma + 1));
  if (!first || !second) {
    fail(ExitCode::usage,
         "--wrap {} is none; give x,y, x, y, none or mirror, or a word for each axis such as mirror,none",
         text);
  }
  x = *first;
  y = *second;
}

SsbumpFlags::SsbumpFlags(CLI::App& command) : meshes_(command) {
  command.add_option("input", input, "height map: .png, .tga, .tif, .jpg, .exr, ...")->type_name("FILE");
  add_height_flags(command);
  add_surface_flags(command);
  add_method_flags(command);
  add_direction_flags(command);
  add_output_flags(command);
}

void SsbumpFlags::add_height_flags(CLI::App& command) {
  command
      .add_option("--channel", run_.heights.channel,
                  "where the heights are: a channel's name or number, or alpha, luminance [luminance of "
                  "colours, else the only one beside alpha]")
      ->type_name("NAME");
  command.add_flag("--invert", run_.heights.invert, "the map holds depths: bright is low");
  command
      .add_option("-s,--height", height_,
                  "bump scale: how many texels high the full range 0 to 1 is [a 32nd of the side of a square "
                  "of as many texels; 1 for float files, which then are in texels]")
      ->type_name("TEXELS");
  auto* world = command.add_option("--height-world", height_world_, "the same in the units of --texel-size")
                    ->type_name("UNITS");
  command.add_option("--texel-size", texel_size_, "how many units wide a texel is")->type_name("UNITS");
  command.get_option("--height")->excludes(world);
  command
      .add_option("-f,--filter-radius", run_.filter_radius,
                  "bilateral filter against the stair-steps of 8-bit heights, in texels; 0: off [10]")
      ->check(CLI::Range(0, 64).description(""))
      ->type_name("N");
  command
      .add_option("--edge-threshold", run_.filter_edge,
                  "heights that differ by this much do not mix, in the file's values [3 % of their range]")
      ->type_name("HEIGHT");
}

void SsbumpFlags::add_surface_flags(CLI::App& command) {
  command
      .add_option("--wrap", wrap_,
                  "which axes tile: x,y, x, y or none; or mirror; or a word for each axis (wrap, mirror, "
                  "none), such as mirror,none [x,y]")
      ->type_name("AXES");
  command
      .add_option("--albedo", run_.albedo,
                  "colour texture of the same size: what the surface reflects with --bounces; its luminance "
                  "is multiplied into the channels")
      ->type_name("FILE");
  command.add_flag("--modulate,!--no-modulate", run_.modulate, "whether --albedo is multiplied in [on]");
  command
      .add_option("--reflectance", run_.generate.albedo,
                  "what the surface reflects with --bounces where there is no --albedo [0.5]")
      ->check(CLI::Range(0.0, 1.0).description(""))
      ->type_name("SHARE");
}

void SsbumpFlags::add_method_flags(CLI::App& command) {
  command
      .add_option("--method", method_,
                  "horizon: sweep, exact but for the number of azimuths; trace: rays, the same without bias; "
                  "cone: open share of a 120-degree cone about each axis; blender: baked by Cycles [horizon]")
      ->check(one_of({"horizon", "trace", "cone", "blender"}))
      ->type_name("horizon|trace|cone|blender");
  auto* azimuths =
      command.add_option("--azimuths", run_.generate.azimuths, "of the horizon [as --error asks]")
          ->check(CLI::Range(4, 1024).description(""))
          ->type_name("N");
  command
      .add_option(
          "--error", run_.generate.error,
          "of the horizon's weights, RMS (and ten times that for all but one in 10,000): azimuths are "
          "doubled from 64 to at most 512 until two halves of them agree [0.001]")
      ->check(CLI::Range(1e-5, 1.0).description(""))
      ->excludes(azimuths)
      ->type_name("E");
  command.add_option("-r,--rays", run_.generate.rays, "for each texel, with trace and cone [250]")
      ->check(CLI::Range(1, 1 << 20).description(""))
      ->type_name("N");
  command
      .add_option("--power", run_.generate.power,
                  "of the cosine to each axis: higher is sharper and less diffuse [1]")
      ->check(CLI::Range(0.0, 256.0).description(""))
      ->type_name("P");
  command.add_option("--bounces", run_.generate.bounces, "reflections between texels that are followed [0]")
      ->check(CLI::Range(0, 16).description(""))
      ->type_name("N");
  command.add_option("--seed", run_.generate.seed, "of rays and dither [0]")->type_name("N");
  command
      .add_option(
          "--memory-limit", memory_mib_,
          "MiB beside the heights; larger maps are made in parts [a quarter of the machine's, at least "
          "2048]")
      ->check(CLI::Range(64, 1 << 24).description(""))
      ->type_name("MIB");
  command.add_option("--threads", run_.generate.threads, "0: all cores [0]")
      ->check(CLI::Range(0, 1024).description(""))
      ->type_name("N");
}

void SsbumpFlags::add_output_flags(CLI::App& command) {
  command.add_option("-o,--output", run_.output.file, "what to write: .png, .tga, .tif or .exr")
      ->type_name("FILE");
  command.add_option("--bits", bits_, "8, 16 or float [8; float for .exr, where 16 is half]")
      ->check(one_of({"8", "16", "float"}))
      ->type_name("8|16|float");
  command.add_flag("--dither,!--no-dither", run_.output.dither,
                   "8 bits rounded by chance, without bands [on]");
  command
      .add_option("--scale", scale_,
                  "what the open surface stores: third: 1/3, ndotb: 0.577, mod2x: 0.289 for shaders that "
                  "double [third]")
      ->check(one_of({"third", "ndotb", "mod2x"}))
      ->type_name("third|ndotb|mod2x");
  command
      .add_option("--handed", handed_,
                  "right: y up (OpenGL, Blender); left: y down (Direct3D, Source) [right]")
      ->check(one_of({"right", "left"}))
      ->type_name("right|left");
  auto* alpha = command
                    .add_option("--alpha", alpha_,
                                "fourth channel: up: light from straight above; ao: ambient occlusion [none]")
                    ->check(one_of({"none", "up", "ao"}))
                    ->type_name("none|up|ao");
  command.add_flag("-A,--ao-in-alpha", alpha_ao_, "as --alpha ao")->excludes(alpha);
  command.add_flag("--ao-only", run_.output.ao_only, "write ambient occlusion alone, one channel");
  command.add_option("-n,--normal", run_.normal, "write the plain normal map, too")->type_name("FILE");
  command.add_option("-D,--dump-height", run_.dump_height, "write the filtered heights, too")
      ->type_name("FILE");
  command.add_flag("--json", json, "print what was done as one JSON object");
}

std::optional<double> SsbumpFlags::texels_high() const {
  check_not_negative("--height", height_);
  check_not_negative("--height-world", height_world_);
  if (texel_size_ && !(*texel_size_ > 0 && std::isfinite(*texel_size_)))
    fail(ExitCode::usage, "--texel-size {:g} is no size; give a number above 0", *texel_size_);
  if (height_world_.has_value() != texel_size_.has_value())
    fail(ExitCode::usage, "--height-world and --texel-size go together; give both");
  return height_world_ ? *height_world_ / *texel_size_ : height_;
}

HeightOptions SsbumpFlags::height_options() const {
  HeightOptions heights = run_.heights;
  heights.texels = texels_high();
  parse_wrap(wrap_, heights.x, heights.y);
  return heights;
}

GenerateOptions SsbumpFlags::generate_options() const {
  GenerateOptions generate = run_.generate;
  if (!(generate.power > 0)) fail(ExitCode::usage, "--power 0 has no direction; give a number above 0");
  generate.memory = memory_mib_ << 20;
  generate.method = method_ == "trace"  ? SsbumpMethod::trace
                    : method_ == "cone" ? SsbumpMethod::cone
                                        : SsbumpMethod::horizon;
  return generate;
}

SsbumpOutput SsbumpFlags::output_options() const {
  SsbumpOutput output = run_.output;
  output.encoding = {*scale_named(scale_), *handed_named(handed_),
                     alpha_ao_ ? SsbumpAlpha::ao : *alpha_named(alpha_)};
  output.bits = bits_.empty()   ? SsbumpBits::chosen_by_ending
                : bits_ == "8"  ? SsbumpBits::eight
                : bits_ == "16" ? SsbumpBits::sixteen
                                : SsbumpBits::floats;
  output.seed = static_cast<std::uint32_t>(run_.generate.seed);
  return output;
}

SsbumpRays SsbumpFlags::rays() const {
  const GenerateOptions& generate = run_.generate;
  return {generate.rays, generate.power, generate.seed, generate.threads};
}

void SsbumpFlags::check_files(const SsbumpRunOptions& options) const {
  std::vector<std::filesystem::path> files{input.lexically_normal()};
  for (const auto& file : {options.output.file, options.normal, options.dump_height}) {
    if (file.empty()) continue;
    if (std::ranges::count(files, file.lexically_normal()) > 0)
      fail(ExitCode::usage, "{} is named twice; give every file its own name", file.string());
    files.push_back(file.lexically_normal());
    (void)storage_of(file, options.output.bits);
  }
}

SsbumpRunOptions SsbumpFlags::options() const {
  meshes_.check(!input.empty());
  if (input.empty() && !from_mesh())
    fail(ExitCode::usage, "no height map given; see 'rnmbake ssbump --help'");
  if (run_.output.file.empty())
    fail(ExitCode::usage, "nowhere to write to; pass -o FILE.png, .tga, .tif or .exr");
  if (run_.filter_edge && !(*run_.filter_edge > 0 && std::isfinite(*run_.filter_edge))) {
    fail(ExitCode::usage, "--edge-threshold {:g} lets nothing mix; give a number above 0, or -f 0",
         *run_.filter_edge);
  }
  SsbumpRunOptions options = run_;
  options.input = input;
  options.heights = height_options();
  options.generate = generate_options();
  options.output = output_options();
  options.directions = direction_options();
  if (method_ == "blender")
    options.baked = [this](const HeightField& field) { return meshes_.bake(field, rays()); };
  check_files(options);
  return options;
}

}  // namespace rnmbake
