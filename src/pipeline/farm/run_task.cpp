#include "pipeline/farm/run_task.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/log.h"
#include "blender/late_blender.h"
#include "blender/scripts.h"
#include "pipeline/dispatch/dispatcher.h"
#include "pipeline/farm/batch_file.h"
#include "pipeline/farm/farm_sink.h"
#include "pipeline/farm/shared_folders.h"
#include "pipeline/run/result_store.h"

#include <optional>
#include <utility>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

/// Results of another Blender have other keys, and their noise would not be this bake's.
void require_same_blender(const FarmPlan& plan, const BakeSettings& settings, const BlenderInfo& info) {
  const FarmBlender& wanted = plan.blender;
  if (info.version_text != wanted.version || info.build != wanted.build)
    fail(ExitCode::environment,
         "{} on {} is Blender {} ({}), and the plan is for {} ({}); name that one with --blender, or submit "
         "with a Blender that all nodes have",
         info.executable.string(), host_name(), info.version_text, info.build, wanted.version, wanted.build);
  if (scripts_hash(settings.run.scripts) != wanted.scripts)
    fail(ExitCode::environment,
         "rnmbake on {} has other scripts than the one that made the plan; install the same everywhere",
         host_name());
}

void require_same_inputs(const FarmPlan& plan) {
  RunRecord record{"", plan.inputs};
  const Reasons changes = reasons_to_run(record, "");
  if (!changes.empty())
    fail(ExitCode::invalid_input, "{} since the plan was made, or is another file on {}; submit again",
         changes.front(), host_name());
}

/// One launch for each share: its batch of `pieces`, and passes.
std::vector<MissingBatch> shares_of(const PassesByBatch& passes, const FarmTask& task, const Plan& pieces) {
  std::vector<MissingBatch> shares;
  for (std::size_t i = 0; i < task.shares.size(); ++i) {
    const FarmShare& share = task.shares[i];
    MissingBatch one{pieces.batches[i], {0, 0}, {}};
    for (std::size_t pass = share.first; pass < share.first + share.count; ++pass)
      one.passes.push_back(passes.at(share.batch)[pass].samples);
    shares.push_back(std::move(one));
  }
  return shares;
}

Plan pieces_of(const FarmPlan& plan, const FarmTask& task) {
  std::vector<fs::path> folders;
  for (const FarmShare& share : task.shares) folders.push_back(plan.batch_folder(share.batch));
  return read_batches(folders);
}

/// Passes that ought to be in the cache and are not: the disk is full, or the cache too small.
std::size_t not_kept(const PassesByBatch& passes, const FarmTask& task, const Store& store) {
  std::size_t missing = 0;
  for (const FarmShare& share : task.shares) {
    for (std::size_t pass = share.first; pass < share.first + share.count; ++pass)
      missing += store.has(passes.at(share.batch)[pass].key) ? 0 : 1;
  }
  return missing;
}

TaskResult bake_task(const FarmPlan& plan, const FarmTask& task, const NodeSettings& node) {
  const ResolvedConfig config = node_config(plan, node);
  require_same_inputs(plan);
  Store store = open_store(config.globals);
  require_shared_cache(plan, store);
  const PassesByBatch passes = read_passes(plan, task);
  TaskResult result;
  if (not_kept(passes, task, store) == 0) {
    log::info("all passes are in the cache already");
    return result;
  }
  if (node.must_see_output) require_shared_output(plan);
  LateBlender blender(config.globals);
  require_same_blender(plan, config.globals, blender.info());
  BlenderSession session(config, blender);
  const Plan pieces = pieces_of(plan, task);
  const BatchRecipe receivers = receiver_requests(config.globals, plan.scene_triangles, pieces);
  BatchRecipe recipe = receivers;  // atlases as the plan has them, however many Blenders run here
  recipe.request = [&](const Batch& batch, int /*jobs*/, const fs::path& folder) {
    return receivers.request(batch, plan.jobs, folder);
  };
  FarmSink sink;
  DispatchRules rules{{store, plan.scene_key}, {}, shares_of(passes, task, pieces), {}};
  result.launches = int(run_batches(session, pieces, BlendPath(plan.scene), recipe, sink, rules).launches);
  for (const auto& [target, reason] : sink.given_up()) {
    const std::string& key = pieces.targets[target].key;
    log::error("{}: {}", key, reason);
    result.failed.push_back({key, reason});
  }
  if (const std::size_t lost = not_kept(passes, task, store);
      lost > 0 && result.failed.empty() && !store.keeps())
    result.failed.push_back({"", fmt::format("{} passes could not be kept in {}: is its disk full?", lost,
                                             store.folder().string())});
  return result;
}

}  // namespace

TaskResult run_task(const FarmPlan& plan, std::size_t task, const NodeSettings& node) {
  if (task >= plan.tasks.size())
    fail(ExitCode::usage, "{} has {} tasks, counted from 0; there is none of index {}", plan.folder.string(),
         plan.tasks.size(), task);
  const double started = steady_clock().now();
  const auto keep = [&](TaskResult& result) {
    result.seconds = steady_clock().now() - started;
    result.host = host_name();
    write_task_result(plan, task, result);
  };
  note_task_begun(plan, task);
  try {
    TaskResult result = bake_task(plan, plan.tasks[task], node);
    keep(result);
    return result;
  } catch (const Error& error) {
    TaskResult result;
    result.failed.push_back({"", error.what()});
    keep(result);
    throw;
  }
}

}  // namespace rnmbake
