#include "cli/flags/render_flags.h"

#include "base/error.h"
#include "base/text.h"
#include "cli/flags/command_line.h"
#include "probes/volume_sampler.h"

#include <algorithm>
#include <array>
#include <charconv>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

constexpr int smallest = 4, largest = 16384;  // Blender's own limit, and one that is a picture still

/// Settings that matter for a view.
constexpr std::array view_settings{
    "bounces",      "seed",           "device",  "allow_scripts",  "blender_version", "blender",
    "scripts",      "threads",        "timeout", "launch_timeout", "memory_max",      "sandbox",
    "sandbox_read", "keep_temporary", "scene",   "view_layer",     "frame",           "sky",
    "sun"};

template <std::size_t N>
std::vector<std::string> names(const std::array<std::string_view, N>& list) {
  return {list.begin(), list.end()};
}

template <std::size_t N>
std::string joined(const std::array<std::string_view, N>& list) {
  return fmt::format("{}", fmt::join(list, "|"));
}

/// The whole text as a number of pixels.
std::optional<int> pixels(const std::string& text) {
  int number = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, number);
  const bool good = parsed.ec == std::errc() && parsed.ptr == end && number >= smallest && number <= largest;
  return good ? std::optional(number) : std::nullopt;
}

}  // namespace

bool is_png(const std::filesystem::path& file) {
  return lower_extension(file) == ".png";
}

RenderFlags::RenderFlags(CLI::App& command) : settings(command, Purpose::reference, view_settings) {
  command
      .add_option(
          "--lightmaps", lightmaps,
          "output folder of rnmbake bake, reference or convert, or one lightmap (.exr); with --compare "
          "several: the bakes, then others that were converted from them, a picture each")
      ->type_name("DIR");
  command
      .add_option(
          "--decode", decode,
          "how surfaces are lit: by the flat lightmap (single), by all maps and the material's normal map "
          "(squared, linear, vrad: see rnmbake decode; encoded: what rnmbake convert wrote), traced (truth), "
          "by --probes (probes), or not (none: the albedo alone) [squared, encoded or probes]")
      ->check(CLI::IsMember({"single", "squared", "linear", "vrad", "encoded", "truth", "none", "probes"})
                  .description(""))
      ->type_name("single|squared|linear|vrad|encoded|truth|none|probes");
  command
      .add_option("--probes", probes,
                  "what rnmbake probes wrote: lights the objects that were left out of it, or all where none "
                  "were; with --compare in each encoding, and errors over these objects alone")
      ->type_name("DIR");
  command.add_option("--dynamic", dynamic, "patterns for the objects that the probes light instead of those")
      ->delimiter(',')
      ->type_name("A,B,...");
  command.add_option("--probes-as", probes_as, "what is kept of each probe [sh3]")
      ->check(CLI::IsMember(names(probe_encoding_names)).description(""))
      ->type_name(joined(probe_encoding_names));
  command
      .add_option("--leak-test", leak_test,
                  "which of the eight probes around a place light it: all, those in the open, or those that "
                  "see it [visibility, or validity where the distances are missing]")
      ->check(CLI::IsMember(names(leak_test_names)).description(""))
      ->type_name(joined(leak_test_names));
  command
      .add_option("--with", with,
                  "let Blender render the view instead, by Cycles or Eevee (which needs OpenGL); eevee with "
                  "--compare: as one of the pictures")
      ->check(CLI::IsMember({"cycles", "eevee"}).description(""))
      ->type_name("cycles|eevee");
  command
      .add_option("--materials", materials,
                  "what Cycles shows: lambert, as the tracer (with normal maps), or the scene's own (full) "
                  "[lambert]")
      ->check(CLI::IsMember({"lambert", "full"}).description(""))
      ->type_name("lambert|full");
  command.add_flag("--spheres", spheres,
                   "show the probes as spheres lit by what they hold, and everything by them: white in the "
                   "open, green where moved out of geometry, red where filled from neighbours");
  command.add_flag("--gbuffer", gbuffer,
                   "what a deferred renderer keeps instead of a picture: normals of the normal maps and of "
                   "the faces, positions, depths and objects, as layers of an .exr");
  command.add_flag("--compare", compare,
                   "all of these, and a report on how far each is from the truth: -o names its folder");
  command
      .add_option("-o,--output", output, "picture to write: .exr (linear) or .png; with --compare a folder")
      ->type_name("PATH");
  command
      .add_option("--camera", camera,
                  "look from the front right and above at all that is baked, whatever camera the scene has "
                  "[the scene's; fit where it has none]")
      ->check(CLI::IsMember({"fit"}).description(""))
      ->type_name("fit");
  command.add_option("--resolution", resolution, "size of the picture [the camera's, at most 960 pixels]")
      ->type_name("WxH");
  command
      .add_option("--samples", samples,
                  "camera rays for each pixel [16; 256 where light is traced, and for Cycles]")
      ->check(CLI::Range(1, 65536).description(""))
      ->type_name("N");
  command.add_option("--exposure", exposure, "of a .png: multiply by 2^STOPS [0]")->type_name("STOPS");
}

void RenderFlags::check() {
  if (output.empty()) fail(ExitCode::usage, "nowhere to write to: pass -o FILE.exr or FILE.png");
  if (!resolution.empty() && !size()) {
    fail(ExitCode::usage, "--resolution {} is not a size; give one such as 640x360, {} to {} pixels a side",
         resolution, smallest, largest);
  }
  const bool has_ending = is_png(output) || lower_extension(output) == ".exr";
  if (compare && has_ending)
    fail(ExitCode::usage, "--compare writes a folder, and {} is a picture; name a folder", output.string());
  if (!compare && !has_ending)
    fail(ExitCode::usage, "cannot write {}: the output must end in .exr or .png", output.string());
  const bool one_of_the_compared = compare && with == "eevee";
  const int ways =
      int(!decode.empty()) + int(!with.empty() && !one_of_the_compared) + int(compare) + int(gbuffer);
  if (ways > 1) {
    fail(ExitCode::usage, "--decode, --with, --gbuffer and --compare exclude each other; give one of them");
  }
  if (gbuffer && is_png(output))
    fail(ExitCode::usage, "--gbuffer writes layers, which {} cannot hold; name an .exr", output.string());
  if (gbuffer && samples > 0) {
    fail(ExitCode::usage,
         "--gbuffer takes one ray through each pixel's centre, as means of two surfaces are neither; leave "
         "--samples out");
  }
  if (lightmaps.size() > 1 && !compare)
    fail(ExitCode::usage,
         "several --lightmaps are for --compare; give one, or --compare with a folder as -o");
  if (probes.empty() && (decode == "probes" || !dynamic.empty() || !leak_test.empty()))
    fail(ExitCode::usage,
         "--decode probes, --dynamic and --leak-test are for light probes; pass --probes DIR");
  if (spheres && (probes.empty() || ways > 0))
    fail(ExitCode::usage,
         "--spheres is a picture of --probes DIR by itself; leave --compare and --decode out");
  if (ways == 0 && !probes.empty()) decode = "probes";
  if (!probes.empty() && decode != "probes" && !compare)
    fail(ExitCode::usage,
         "--probes lights by --decode probes, or in several ways by --compare; leave one out");
  decode_by_header = decode.empty() && ways == 0;
  if (decode_by_header) decode = "squared";
  if (!probes.empty()) return;
  const bool looks_up = compare || (!decode.empty() && decode != "truth" && decode != "none");
  if (looks_up && lightmaps.empty()) {
    fail(ExitCode::usage,
         "{} needs --lightmaps DIR; without lightmaps there are --decode truth and --with cycles",
         compare ? "--compare" : "--decode " + decode);
  }
}

std::optional<std::pair<int, int>> RenderFlags::size() const {
  const std::size_t times = resolution.find_first_of("xX");
  if (times == std::string::npos) return std::nullopt;
  const auto width = pixels(resolution.substr(0, times)), height = pixels(resolution.substr(times + 1));
  return width && height ? std::optional(std::pair(*width, *height)) : std::nullopt;
}

std::string RenderFlags::as_text() const {
  std::string text;
  const auto add = [&](const char* flag, const std::string& value) {
    if (!value.empty()) text += fmt::format(" {} {}", flag, shell_word(value));
  };
  for (const std::filesystem::path& path : lightmaps) add("--lightmaps", path.string());
  add("--probes", probes.string());
  for (const std::string& pattern : dynamic) add("--dynamic", pattern);
  if (probes_as != "sh3") add("--probes-as", probes_as);
  add("--leak-test", leak_test);
  if (spheres) text += " --spheres";
  add("--decode", decode);
  add("--with", with);
  if (gbuffer) text += " --gbuffer";
  if (compare) text += " --compare";
  if (materials != "lambert") add("--materials", materials);
  add("--camera", camera);
  add("--resolution", resolution);
  if (samples > 0) add("--samples", fmt::format("{}", samples));
  add("-o", output.string());
  return text;
}

}  // namespace rnmbake
