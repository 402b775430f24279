#include "cli/deliver.h"

#include "base/error.h"
#include "base/log.h"
#include "base/object_notes.h"
#include "base/progress.h"
#include "base/text.h"
#include "blender/late_blender.h"
#include "cli/bake.h"
#include "cli/flags/settings_flags.h"
#include "cli/run_report.h"
#include "pipeline/deliver/deliver.h"
#include "pipeline/deliver/engines/engine_targets.h"
#include "process/stop.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

constexpr const char* own_maps = ".lightmaps";  // in the output folder; engines pass hidden folders over

constexpr std::array without_flags{"engine"};  // that which bakes: --bake-engine

struct DeliverFlags {
  std::string engine, bake_engine, format;
  fs::path lightmaps;
  DeliverOptions options;
};

/// Of every engine, as CLI11 checks it.
std::vector<std::string> engine_names() {
  std::vector<std::string> names;
  for (const EngineTarget* target : engine_targets()) names.emplace_back(target->name());
  return names;
}

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const PageFormat format : page_formats()) names.emplace_back(name_of(format));
  return names;
}

/// "gltf: flat, threejs: rnm-vrad".
std::string own_encodings() {
  std::vector<std::string> said;
  for (const EngineTarget* target : engine_targets())
    said.push_back(fmt::format("{}: {}", target->name(), target->encodings().front()));
  return fmt::format("{}", fmt::join(said, ", "));
}

/// The layer that loses most.
void say_loss(const DeliverySummary& summary) {
  if (summary.losses.empty()) return;
  const PageLoss& worst = *std::ranges::max_element(
      summary.losses, {}, [](const PageLoss& loss) { return loss.lost.relative_rmse.value; });
  log::info("pages as {}: relative_rmse {:.2g}, relative_bias {:.1g}, max {:.2g} (page {}, {})",
            name_of(summary.form.format), worst.lost.relative_rmse.value, worst.lost.relative_bias.value,
            worst.lost.max, worst.page, worst.layer);
}

/// "1 page of 512 x 480", "3 pages (4096 x 4096, 4096 x 4096 and 4096 x 1200)".
std::string said_pages(const PageLayout& layout) {
  std::vector<std::string> sizes;
  for (const RectSize& page : layout.pages) sizes.push_back(fmt::format("{} x {}", page.width, page.height));
  return fmt::format("{} of {}", counted(sizes.size(), "page"), first_names(sizes));
}

void say_delivered(const DeliverySummary& summary, const fs::path& folder) {
  for (const std::string& note : summary.notes) log::warn("{}", note);
  log::info("{} on {}, {:.2f} texels for each covered one ({:.2f} for surfaces and the padding around)",
            counted(summary.layout.maps.size(), "lightmap"), said_pages(summary.layout),
            summary.layout.texels_for_each_covered(), summary.layout.least_for_each_covered());
  say_loss(summary);
  log::info("{} in {}, {} of them written anew", counted(summary.files.size(), "file"), folder.string(),
            summary.written);
}

void report(const DeliverySummary& summary, RunReport& made) {
  made.files = summary.files;
  made.main_file = made.output / summary.files.back();
  made.more["pages"] = summary.layout.pages.size();
  made.more["lightmaps"] = summary.layout.maps.size();
  made.more["texels_for_each_covered"] = summary.layout.texels_for_each_covered();
  made.more["least_for_each_covered"] = summary.layout.least_for_each_covered();
  made.more["written"] = summary.written;
  made.more["notes"] = summary.notes;
}

/// Where the lightmaps lie; bakes them first where a scene was named and not a folder of them.
struct Source {
  fs::path lightmaps;
  int code = 0;  // of the bake
};

Source bake_first(ResolvedConfig config, const DeliverFlags& flags, RunReport& made) {
  fs::path& output = config.globals.output.dir;
  output = flags.lightmaps.empty() ? output / own_maps : flags.lightmaps;
  const fs::path lightmaps = output;
  return {lightmaps, bake_scene(std::move(config), made)};
}

int run_deliver(const SettingsFlags& settings, const DeliverFlags& flags, RunReport& made) {
  DeliverOptions options = flags.options;
  options.engine = &engine_target(flags.engine);
  if (!flags.format.empty()) options.format = page_format(flags.format);
  check(options);
  const fs::path given = settings.scene_argument();
  const bool is_baked = fs::is_directory(given);
  auto config = is_baked ? settings.resolve_scene(scene_to_deliver(given)) : settings.resolve();
  if (!config) return static_cast<int>(ExitCode::ok);
  if (config->globals.output.dir.empty()) fail(ExitCode::usage, "nowhere to write to: pass -o DIR");
  StopRequest::install();
  const Source source = is_baked ? Source{given, 0} : bake_first(*config, flags, made);
  config->globals.scene.file = scene_to_deliver(source.lightmaps);
  LateBlender blender(config->globals);
  BlenderSession session(*config, blender);
  Progress progress("delivering", progress_for(log::is_quiet(), log::is_jsonl()));
  const DeliverySummary summary =
      deliver(session, source.lightmaps, options,
              [&](double share, const std::string& what) { progress.update(share, what); });
  made.output = config->globals.output.dir;
  report(summary, made);
  say_delivered(summary, made.output);
  return source.code;
}

}  // namespace

std::function<int()> add_deliver_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("deliver", "Hand a scene over to an engine, with its lightmaps");
  auto settings = std::make_shared<SettingsFlags>(*command, Purpose::bake, std::span<const char* const>(),
                                                  std::span<const char* const>(without_flags));
  auto flags = std::make_shared<DeliverFlags>();
  command->add_option("--engine", flags->engine, "for whom")
      ->required()
      ->check(CLI::IsMember(engine_names()).description(""))
      ->type_name(fmt::format("{}", fmt::join(engine_names(), "|")))
      ->group("Delivery");
  command->add_option("--bake-engine", flags->bake_engine, "who bakes: `rnmbake bake --engine` [cycles]")
      ->check(CLI::IsMember({"cycles", "embree"}).description(""))
      ->type_name("cycles|embree")
      ->group("Delivery");
  command
      ->add_option("--encoding", flags->options.encoding,
                   fmt::format("of the directional pages [{}]", own_encodings()))
      ->check(CLI::IsMember(delivered_encodings()).description(""))
      ->type_name(fmt::format("{}", fmt::join(delivered_encodings(), "|")))
      ->group("Delivery");
  command->add_option("--pages", flags->options.side, "largest side of the pages, texels [4096]")
      ->check(CLI::Range(16, 16384).description(""))
      ->type_name("SIDE")
      ->group("Delivery");
  command
      ->add_option("--page-padding", flags->options.padding,
                   "texels around surfaces that are filled from them, for filters and mipmaps [4]")
      ->check(CLI::Range(1, 64).description(""))
      ->type_name("TEXELS")
      ->group("Delivery");
  command->add_option("--page-format", flags->format, "of the pages [exr]")
      ->check(CLI::IsMember(format_names()).description(""))
      ->type_name(fmt::format("{}", fmt::join(format_names(), "|")))
      ->group("Delivery");
  command
      ->add_option("--page-mips", flags->options.mips,
                   "levels of mipmaps, of ktx2 [as many as --page-padding allows]")
      ->check(CLI::Range(0, 6).description(""))
      ->type_name("N")
      ->group("Delivery");
  command->add_flag("--page-zstd", flags->options.zstd, "compress ktx2 by Zstandard")->group("Delivery");
  command
      ->add_option("--lightmaps", flags->lightmaps,
                   "folder to bake into, or that a bake wrote [DIR/.lightmaps]")
      ->type_name("DIR")
      ->group("Delivery");
  command->add_flag("--with-lights", flags->options.lights, "put the scene's lamps into the .glb, too")
      ->group("Delivery");
  auto run = std::make_shared<RunFlags>(*command);
  return [settings, flags, run] {
    settings->want(
        {find_setting("save_scene"), std::string("always"), SettingSource::flag, "rnmbake deliver"});
    if (engine_target(flags->engine).in_world())
      settings->want({find_setting("frames"), true, SettingSource::flag, "rnmbake deliver"});
    if (!flags->bake_engine.empty())
      settings->want({find_setting("engine"), flags->bake_engine, SettingSource::flag, "flag --bake-engine"});
    return run->run([&](RunReport& made) { return run_deliver(*settings, *flags, made); });
  };
}

}  // namespace rnmbake
