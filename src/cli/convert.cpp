#include "cli/convert.h"

#include "base/error.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/text.h"
#include "encoding/codecs/make_codec.h"
#include "pipeline/convert/convert.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

struct ConvertFlags {
  std::filesystem::path lightmaps, output;
  std::string space = "tangent", depth = "half", layout = "layers";
  ConvertOptions convert;
  bool json = false;
};

nlohmann::json json_of(const ConvertSummary& summary) {
  const EncodeCounts& counts = summary.counts.encode;
  return {{"key", summary.key},
          {"files", file_names(summary.files)},
          {"texels", counts.texels},
          {"non_finite", counts.non_finite},
          {"negative_lobes", counts.negative_lobes},
          {"over_long", counts.over_long},
          {"out_of_range", counts.out_of_range},
          {"unconverged", counts.unconverged},
          {"beyond_half", summary.counts.beyond_half},
          {"without_frame", summary.counts.without_frame}};
}

/// One line for each thing that was bent, with the share of the covered texels.
void say_what_was_bent(const std::vector<ConvertSummary>& summaries) {
  ConvertCounts all;
  for (const ConvertSummary& summary : summaries) all += summary.counts;
  const auto say = [&](std::size_t count, const char* what) {
    if (count == 0) return;
    log::warn("{} of {} {}", count, counted(all.encode.texels, "texel"), what);
  };
  say(all.encode.non_finite, "hold NaN or infinite bakes and were written as darkness; bake with --repair");
  say(all.encode.unconverged,
      "have no numbers with which the decoder returns the bakes; the nearest were written");
  say(all.without_frame, "have no tangent frame and keep their flat light alone");
  if (all.beyond_half > 0)
    log::warn("{} beyond 65504 clamped; --depth float keeps what is above",
              counted(all.beyond_half, "value"));
  const auto note = [&](std::size_t count, const char* what) {
    if (count > 0) log::info("{} of {} {}", count, counted(all.encode.texels, "texel"), what);
  };
  note(all.encode.negative_lobes,
       "decode below 0 for some normal tilted up to 60 degrees; clamp in the shader");
  note(all.encode.out_of_range, "did not fit the packing's range and were fitted again within it");
  note(all.encode.over_long, "vary with the normal more than light from a whole sphere can (|v| > 2a)");
}

int run_convert(ConvertFlags flags) {
  const CodecOptions& codec = flags.convert.codec;
  if (codec.range == 0 && (codec.bits > 0 || codec.mono))
    fail(ExitCode::usage, "--bits and --mono are for packed encodings; add --range 2 or --range 4");
  flags.convert.world = flags.space == "world";
  flags.convert.split = flags.layout == "files";
  flags.convert.depth = flags.depth == "float" ? Depth::full : Depth::half;
  Progress progress("converting", progress_for(log::is_quiet(), log::is_jsonl()));
  const std::vector<ConvertSummary> summaries =
      convert_lightmaps(flags.lightmaps, flags.convert, flags.output,
                        [&](double share, const std::string& key) { progress.update(share, key); });
  say_what_was_bent(summaries);
  if (flags.json) {
    nlohmann::json list = nlohmann::json::array();
    for (const ConvertSummary& summary : summaries) list.push_back(json_of(summary));
    std::cout << nlohmann::json{{"encoding", flags.convert.codec.name}, {"lightmaps", list}}.dump(2) << '\n';
  } else {
    log::info("{} as {} in {}", counted(summaries.size(), "lightmap"), flags.convert.codec.name,
              flags.output.string());
  }
  return static_cast<int>(ExitCode::ok);
}

}  // namespace

std::function<int()> add_convert_command(CLI::App& app) {
  auto flags = std::make_shared<ConvertFlags>();
  CLI::App* command =
      app.add_subcommand("convert", "Turn lightmaps into another encoding: SH, ZH3, RNM of an engine");
  command
      ->add_option("lightmaps", flags->lightmaps,
                   "output folder of rnmbake bake or rnmbake reference, or one lightmap")
      ->required()
      ->type_name("LIGHTMAPS");
  const std::vector<std::string> names = codec_names();
  command
      ->add_option("--to", flags->convert.codec.name, "the encoding; docs/convert.md says what each is for")
      ->required()
      ->check(CLI::IsMember(names).description(""))
      ->type_name(fmt::format("{}", fmt::join(names, "|")));
  command->add_option("-o,--output", flags->output, "folder to write to; made where it is not there")
      ->required()
      ->type_name("DIR");
  command
      ->add_option(
          "--range", flags->convert.codec.range,
          "pack sh2, zh3 or geomerics: v/a within K for each axis; 2 for Bakery and MonoSH, 4 for Godot")
      ->check(CLI::IsMember({2.0, 4.0}).description(""))
      ->type_name("2|4");
  command->add_option("--bits", flags->convert.codec.bits, "of packed directions; 0: floats [0]")
      ->check(CLI::IsMember({0, 8, 16}).description(""))
      ->type_name("0|8|16");
  command->add_flag("--mono", flags->convert.codec.mono, "pack one direction for all colours (MonoSH)");
  command
      ->add_option("--space", flags->space,
                   "of the layers: tangent, or world, which needs lightmaps baked with --frames [tangent]")
      ->check(CLI::IsMember({"tangent", "world"}).description(""))
      ->type_name("tangent|world");
  command
      ->add_option("--layout", flags->layout,
                   "one EXR with layers for each lightmap, or one EXR for each layer (floor.l0.exr) [layers]")
      ->check(CLI::IsMember({"layers", "files"}).description(""))
      ->type_name("layers|files");
  command->add_option("--depth", flags->depth, "of the EXR's values [half]")
      ->check(CLI::IsMember({"half", "float"}).description(""))
      ->type_name("half|float");
  command->add_flag("--json", flags->json, "say what was written as one JSON object");
  return [flags] { return run_convert(*flags); };
}

}  // namespace rnmbake
