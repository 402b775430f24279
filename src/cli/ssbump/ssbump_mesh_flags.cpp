#include "cli/ssbump/ssbump_mesh_flags.h"

#include "base/error.h"
#include "blender/late_blender.h"
#include "process/stop.h"

#include <charconv>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

constexpr int largest = 16384;

std::optional<int> texels(std::string_view text) {
  int number = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
  return whole && number >= 1 && number <= largest ? std::optional(number) : std::nullopt;
}

void add_mesh_flags(CLI::App& command, SsbumpMeshOptions& options, std::string& size, std::string& missing) {
  const char* group = "Detail from a mesh";
  command.add_option("--from-mesh", options.high, "detailed mesh instead of a height map; it needs no UVs")
      ->type_name("HIGH")
      ->group(group);
  command
      .add_option(
          "--onto", options.onto,
          "low-poly meshes that share the picture: files, or names of objects in HIGH (* and ? allowed)")
      ->type_name("LOW...")
      ->group(group);
  command.add_option("--high-objects", options.high_objects, "objects of HIGH that are detail [*]")
      ->delimiter(',')
      ->type_name("A,B,...")
      ->group(group);
  command
      .add_option("--low-objects", options.low_objects, "objects of the files of --onto to put detail on [*]")
      ->delimiter(',')
      ->type_name("A,B,...")
      ->group(group);
  command.add_option("--size", size, "of the picture in texels [1024]")->type_name("N|WxH")->group(group);
  command.add_option("--uv", options.uv, "UV layer of LOW [the active-render one]")
      ->type_name("NAME")
      ->group(group);
  command
      .add_option("--cage", options.measure.cage,
                  "how far above and below LOW detail is sought, in units of the scene [3 % of LOW's box]")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("X")
      ->group(group);
  command
      .add_option("--reach", options.measure.reach,
                  "how far away a thing still casts a shadow, in units [any]")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("X")
      ->group(group);
  command.add_option("--parts", options.measure.parts, "a texel is the mean of N x N places in it [2]")
      ->check(CLI::Range(1, 8).description(""))
      ->type_name("N")
      ->group(group);
  command.add_flag("--allow-overlap", options.allow_overlap, "UVs of LOW may overlap; the last face wins")
      ->group(group);
  command
      .add_option("--missing", missing,
                  "texels without detail: from their neighbours, or black with alpha 0 [fill]")
      ->check(CLI::IsMember({"fill", "mark"}).description(""))
      ->type_name("fill|mark")
      ->group(group);
  command.add_option("--dilate", options.dilate, "texels that the faces' values spread beyond them [8]")
      ->check(CLI::Range(0, largest).description(""))
      ->type_name("N")
      ->group(group);
}

}  // namespace

std::optional<std::pair<int, int>> texel_size(const std::string& text) {
  const std::size_t times = text.find_first_of("xX");
  const auto width = texels(std::string_view(text).substr(0, times));
  const auto height = times == std::string::npos ? width : texels(std::string_view(text).substr(times + 1));
  return width && height ? std::optional(std::pair(*width, *height)) : std::nullopt;
}

SsbumpMeshFlags::SsbumpMeshFlags(CLI::App& command) {
  add_mesh_flags(command, options_, size_, missing_);
  const char* group = "Blender (meshes, --method blender)";
  command
      .add_option(
          "--lights", lights_,
          "of --method blender: a white sky (exact), or red, green and blue area lights along the basis "
          "vectors (as published) [sky]")
      ->check(CLI::IsMember({"sky", "area"}).description(""))
      ->type_name("sky|area")
      ->group(group);
  command.add_option("--blender", blender_, "Blender to use: a path or a name in PATH [searched]")
      ->type_name("PROGRAM")
      ->group(group);
  command.add_flag("--allow-scripts", allow_scripts_, "let .blend files run their own scripts and drivers")
      ->group(group);
  command.add_flag("--sandbox", sandbox_, "run Blender without network, home folder and other files")
      ->group(group);
  command.add_flag("--keep-temporary", keep_temporary_, "leave what Blender was given and gave")
      ->group(group);
}

void SsbumpMeshFlags::check(bool has_input) const {
  if (from_mesh() && has_input)
    fail(ExitCode::usage, "a height map and --from-mesh exclude each other; give one of them");
  if (from_mesh() && options_.onto.empty())
    fail(ExitCode::usage, "--from-mesh needs --onto LOW: the low-poly mesh whose UVs the picture is for");
  if (!from_mesh() && !options_.onto.empty())
    fail(ExitCode::usage, "--onto needs --from-mesh HIGH: the mesh that has the detail");
  if (!size_.empty() && !texel_size(size_)) {
    fail(ExitCode::usage, "--size {} is not a size; give one such as 1024 or 1024x512, 1 to {} texels a side",
         size_, largest);
  }
}

SsbumpMesh SsbumpMeshFlags::measure(const SsbumpRays& rays) const {
  SsbumpMeshOptions options = options_;
  const auto [width, height] = texel_size(size_).value_or(std::pair(1024, 1024));
  options.missing = missing_ == "mark" ? SsbumpMeshOptions::Missing::mark : SsbumpMeshOptions::Missing::fill;
  options.measure.width = width;
  options.measure.height = height;
  options.measure.rays = rays.rays;
  options.measure.power = rays.power;
  options.measure.seed = rays.seed;
  options.measure.threads = rays.threads;
  const ResolvedConfig resolved = config(rays);
  LateBlender blender(resolved.globals);
  BlenderSession session(resolved, blender);
  StopRequest::install();
  return measure_ssbump_mesh(session, options);
}

SsbumpWeights SsbumpMeshFlags::bake(const HeightField& field, const SsbumpRays& rays) const {
  if (rays.power != 1) {
    fail(ExitCode::unsupported,
         "--method blender knows power 1 only, not {:g}; use --method horizon or trace", rays.power);
  }
  SsbumpBlenderOptions options;
  options.lights = lights_ == "area" ? SsbumpBlenderOptions::Lights::area : SsbumpBlenderOptions::Lights::sky;
  options.samples = rays.rays;
  options.seed = static_cast<int>(rays.seed);
  const ResolvedConfig resolved = config(rays);
  LateBlender blender(resolved.globals);
  BlenderSession session(resolved, blender);
  StopRequest::install();
  return bake_height_map(session, field, options);
}

ResolvedConfig SsbumpMeshFlags::config(const SsbumpRays& rays) const {
  ResolvedConfig config = resolve({}, read_environment(process_environment()), {});
  config.globals.scene.file = from_mesh() ? options_.high : "the height map";
  config.globals.scene.allow_scripts |= allow_scripts_;
  config.globals.run.sandbox |= sandbox_;
  config.globals.output.keep_temporary |= keep_temporary_;
  if (!blender_.empty()) config.globals.run.blender = blender_;
  if (rays.threads > 0) config.globals.run.threads = rays.threads;
  return config;
}

}  // namespace rnmbake
