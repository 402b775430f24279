#include "cli/bake_several.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/log.h"
#include "base/object_notes.h"
#include "base/text.h"

#include <filesystem>
#include <string>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

bool is_inside(const std::filesystem::path& dir, const std::filesystem::path& folder) {
  const std::filesystem::path relative = dir.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

/// The folder that holds the output folders of all.
std::filesystem::path common_folder(const std::vector<ResolvedConfig>& configs) {
  std::filesystem::path common = configs.front().globals.output.dir.lexically_normal().parent_path();
  for (const ResolvedConfig& config : configs) {
    const std::filesystem::path dir = config.globals.output.dir.lexically_normal();
    while (!is_inside(dir, common) && common.has_relative_path()) common = common.parent_path();
  }
  return common;
}

/// Outcome of several scenes.
struct SceneCounts {
  std::vector<std::string> failed;  // as a whole
  int code = 0;

  void add(int one) {
    const auto badness = [](int c) {
      return c == 0 ? 0 : c == static_cast<int>(ExitCode::tasks_failed) ? 1 : 2;
    };
    if (badness(one) > badness(code)) code = one;
  }
};

/// One scene; what it throws is its own failure, unless the user stops the run.
void bake_one_of(const ResolvedConfig& config, const BakeOne& bake, SceneCounts& counts, RunReport& made) {
  const std::string scene = config.globals.scene.file.string();
  log::info("{}", scene);
  RunReport of_scene;
  try {
    require_scene(config);
    counts.add(bake(config, of_scene));
    add_scene(of_scene, made);
  } catch (const Error& error) {
    const std::string said = error.what();
    log::error("{}", said.starts_with(scene) ? said : scene + ": " + said);
    counts.add(static_cast<int>(error.code()));
    counts.failed.push_back(scene);
    add_failed_scene(config.globals.output.dir, error.what(), made);
  }
}

}  // namespace

int bake_several(const std::vector<ResolvedConfig>& configs, const BakeOne& bake, bool is_plan,
                 RunReport& made) {
  const double started = steady_clock().now();
  made.output = common_folder(configs);
  SceneCounts counts;
  for (const ResolvedConfig& config : configs) bake_one_of(config, bake, counts, made);
  if (is_plan) return counts.code;
  const std::string where = made.output.empty() ? "." : made.output.string();
  const std::string what = fmt::format("{} in {}: {}, {:.1f} s", counted(configs.size(), "scene"), where,
                                       counted(made.more.value("lightmaps", std::size_t{0}), "lightmap"),
                                       steady_clock().now() - started);
  if (counts.code == 0)
    log::info("{}", what);
  else if (counts.failed.empty())
    log::warn("{}; {} failed", what, counted(made.more["failed"].size(), "object"));
  else
    log::warn("{}; not baked: {}", what, first_names(counts.failed));
  return counts.code;
}

}  // namespace rnmbake
