#include "cli/ssbump/ssbump.h"

#include "base/error.h"
#include "base/log.h"
#include "cli/ssbump/ssbump_flags.h"
#include "cli/ssbump/ssbump_tools.h"
#include "cli/ssbump/weight_range_json.h"
#include "pipeline/ssbump/ssbump_mesh_files.h"
#include "process/stop.h"

#include <array>
#include <iostream>
#include <memory>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

constexpr const char* examples =
    "Examples:\n"
    "  rnmbake ssbump bricks_height.png -o bricks_ssbump.png\n"
    "  rnmbake ssbump bricks.tga --channel alpha --height 24 --handed left -o bricks_ssbump.tga\n"
    "  rnmbake ssbump depth.exr --invert --height-world 0.2 --texel-size 0.004 -o wall.exr\n"
    "  rnmbake ssbump bricks_height.png --alpha up --normal bricks_n.png -o bricks_ssbump.png\n"
    "  rnmbake ssbump trim.png --wrap x --filter-radius 0 --bits 16 -o trim.png\n"
    "  rnmbake ssbump bricks_height.png --basis-set h6 -o bricks_h6.exr   for lightmaps of ten directions\n"
    "  rnmbake ssbump --from-mesh statue_high.glb --onto statue_low.glb -o statue_ssbump.png\n"
    "  rnmbake ssbump info bricks_ssbump.png            what a map holds\n"
    "  rnmbake ssbump compress-check bricks_ssbump.png  what BC1, RGB565 and BC7 would do to it";

nlohmann::ordered_json json_of(const SsbumpRunOptions& options, const SsbumpRunSummary& summary) {
  nlohmann::ordered_json json;
  json["output"] = options.output.file.string();
  json["width"] = summary.width;
  json["height"] = summary.height;
  json["channel"] = summary.heights.channel;
  json["texels_high"] = summary.heights.texels;
  json["lowest"] = summary.heights.lowest;
  json["highest"] = summary.heights.highest;
  json["edge_threshold"] = summary.edge;
  if (summary.azimuths > 0) json["azimuths"] = summary.azimuths;
  if (summary.rmse >= 0) json["rmse"] = summary.rmse;
  if (options.directions) {
    json["set"] = options.directions->set.name;
    for (std::size_t c = 0; c < summary.ranges.size(); ++c)
      json["weights"][options.directions->set.directions[c].name] = json_of(summary.ranges[c]);
    for (const auto& [step, seconds] : summary.seconds) json["seconds"][step] = seconds;
    return json;
  }
  json["scale"] = name_of(options.output.encoding.scale);
  json["handedness"] = name_of(options.output.encoding.handed);
  json["alpha"] = name_of(options.output.encoding.alpha);
  for (std::size_t c = 0; c < summary.ranges.size(); ++c) {
    json["weights"][ssbump_channel_names.at(c)] = json_of(summary.ranges[c]);
  }
  for (const auto& [step, seconds] : summary.seconds) json["seconds"][step] = seconds;
  return json;
}

SsbumpRunSummary made(const SsbumpFlags& flags, const SsbumpRunOptions& options) {
  if (flags.from_mesh()) return write_ssbump_mesh(flags.measure(), options);
  Progress progress("ssbump", progress_for(log::is_quiet(), log::is_jsonl()));
  return run_ssbump(options, progress);
}

int run_ssbump(const SsbumpFlags& flags) {
  const SsbumpRunOptions options = flags.options();
  StopRequest::install();
  const SsbumpRunSummary summary = made(flags, options);
  if (flags.json) {
    std::cout << json_of(options, summary).dump(2) << '\n';
  } else if (options.directions) {
    log::info("{}: {} x {}, weights for the {} lightmaps of the set {}", options.output.file.string(),
              summary.width, summary.height, summary.ranges.size(), options.directions->set.name);
  } else {
    log::info("{}: {} x {}, {:.1f} % of the sky is open on average", options.output.file.string(),
              summary.width, summary.height, 100 * summary.ranges.back().mean);
    if (summary.rmse >= 0) log::info("{} azimuths, RMS error about {:.2g}", summary.azimuths, summary.rmse);
  }
  if (summary.rmse > options.generate.error)
    log::warn("{}: RMS error about {:.2g} with {} azimuths, which is the most that are tried",
              options.output.file.string(), summary.rmse, summary.azimuths);
  return static_cast<int>(ExitCode::ok);
}

/// Throws Error(usage) for words that CLI11 gave to the command above the tool, where they would have no
/// effect.
void refuse_strays(const CLI::App& command, const CLI::App& tool) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    const bool is_flag = !option->get_lnames().empty();
    fail(ExitCode::usage, "{} '{}'; see 'rnmbake ssbump {} --help'",
         is_flag ? "unknown flag" : "unexpected argument",
         is_flag ? "--" + option->get_lnames().front() : option->results().front(), tool.get_name());
  }
}

}  // namespace

std::function<int()> add_ssbump_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("ssbump", "Self-shadowed bump maps from height maps; info, to-normal, mip, ...");
  const auto flags = std::make_shared<SsbumpFlags>(*command);
  command->footer(examples);
  command->require_subcommand(0, 1);
  std::vector<std::pair<CLI::App*, std::function<int()>>> tools;
  for (const auto& add : ssbump_tools()) {
    auto action = add(*command);
    CLI::App* tool = command->get_subcommands([](CLI::App*) { return true; }).back();
    tool->footer("");
    tools.emplace_back(tool, std::move(action));
  }
  return [flags, tools, command] {
    for (const auto& [tool, action] : tools) {
      if (!command->got_subcommand(tool)) continue;
      refuse_strays(*command, *tool);
      return action();
    }
    return run_ssbump(*flags);
  };
}

}  // namespace rnmbake
