#include "pipeline/farm/shared_folders.h"

#include "base/error.h"
#include "base/files.h"
#include "pipeline/farm/task_result.h"

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

fs::path token_of(const FarmPlan& plan) {
  return plan.output / (".rnmbake-farm-" + plan.id.substr(0, 8));
}

}  // namespace

void leave_tokens(const FarmPlan& plan, Store& store) {
  store.put(plan.probe_key(), plan.id);
  if (!store.has(plan.probe_key()))
    fail(ExitCode::io, "nothing can be kept in the cache {}; name another with --cache",
         store.folder().string());
  write_atomically(token_of(plan), plan.id + "\n");
}

void remove_token(const FarmPlan& plan) {
  std::error_code ignored;
  fs::remove(token_of(plan), ignored);
}

FarmPlan read_shared_plan(const fs::path& folder, const std::string& id) {
  std::error_code unseen;
  if (!fs::exists(folder / "plan.json", unseen))
    fail(ExitCode::environment,
         "{} does not see the plan {}: is that folder shared? Submit again with --plan in a folder that all "
         "machines see",
         host_name(), folder.string());
  FarmPlan plan = read_farm_plan(folder);
  if (plan.id != id)
    fail(ExitCode::environment,
         "{} on {} is not the plan that this job is for: it was planned again, or the folder is not shared; "
         "submit again with --plan in a folder that all machines see",
         folder.string(), host_name());
  return plan;
}

void require_shared_cache(const FarmPlan& plan, Store& store) {
  if (!store.get(plan.probe_key()))
    fail(ExitCode::environment,
         "the cache {} on {} is not the one that the plan was made with: is that folder shared? Submit again "
         "with --cache in a folder that all machines see",
         store.folder().string(), host_name());
}

void require_shared_output(const FarmPlan& plan) {
  const fs::path token = token_of(plan);
  std::error_code unseen;
  if (!fs::exists(token, unseen) || read_text(token) != plan.id + "\n")
    fail(ExitCode::environment,
         "the output folder {} on {} is not the one that the plan was made for: is it shared? Submit again "
         "with --output in a folder that all machines see",
         plan.output.string(), host_name());
}

}  // namespace rnmbake
