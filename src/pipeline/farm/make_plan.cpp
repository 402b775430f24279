#include "pipeline/farm/make_plan.h"

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/owner.h"
#include "base/text.h"
#include "blender/scripts.h"
#include "pipeline/dispatch/kept_targets.h"
#include "pipeline/dispatch/launch_batch.h"
#include "pipeline/dispatch/memory.h"
#include "pipeline/farm/batch_file.h"
#include "pipeline/farm/cut_tasks.h"
#include "pipeline/farm/farm_sink.h"
#include "pipeline/farm/shared_folders.h"
#include "pipeline/run/result_store.h"
#include "pipeline/scene/scene_key.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <set>
#include <utility>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

/// Files that the scene reads, as they are now; what was not there is not looked for.
std::vector<RunFile> look_at_inputs(const SceneSurvey& survey) {
  std::vector<RunFile> files;
  for (const InputFile& input : survey.inputs) {
    if (input.was_there) files.push_back(look_at(input.kind, input.path));
  }
  return files;
}

/// The scene that launches open: the user's own file where it is, or one that was made for it, moved with its
/// folder as deep in the plan as it was, so that its relative paths hold.
fs::path place_scene(const BlenderSession& session, const BlendPath& shown, const fs::path& plan) {
  const fs::path users = fs::absolute(session.settings().scene.file).lexically_normal();
  if (fs::absolute(shown.path()).lexically_normal() == users) return users;
  const fs::path from = shown.path().parent_path(), to = plan / "scene" / from.filename();
  make_folders(to.parent_path());
  fs::remove_all(to);
  fs::copy(from, to, fs::copy_options::recursive);
  return to / shown.path().filename();
}

/// Bytes that all passes of a batch take in the cache, at most.
std::int64_t cache_bytes(const BatchWork& work, const Plan& plan) {
  return texels_of(plan, work.layout().rects) * 16 * std::int64_t(work.passes().size());
}

void require_room(const BakeSettings& settings, std::int64_t bytes) {
  const std::int64_t limit = std::int64_t{settings.run.cache_limit} << 20;
  if (limit == 0 || bytes <= limit / 10 * 9) return;
  fail(ExitCode::usage,
       "passes may take {} MiB in the cache, whose limit is {} MiB: the first ones would be gone before the "
       "last ones are baked; raise --cache-limit, or switch it off with --cache-limit 0",
       bytes >> 20, settings.run.cache_limit);
}

/// Batches that the bake will want, with their passes, each written into its folder.
class Planner {
 public:
  Planner(BlenderSession& session, const BakeSubject& subject, FarmPlan& farm)
      : session_(session), subject_(subject), farm_(farm) {}

  void operator()(const Plan& plan, const BatchRecipe& recipe) {
    const BakeSettings& settings = session_.settings();
    refuse_noise(plan);
    const PassCache& cache = subject_.rules.cache;
    FarmSink sink;
    KeptTargets kept(plan, cache, sink);
    const auto missing = kept.missing(cut_by(recipe, plan, choose_jobs(settings, plan.batches.size())));
    farm_.jobs = choose_jobs(settings, missing.size());
    std::int64_t bytes = 0;
    for (const MissingBatch& one : missing) {
      const fs::path folder = session_.new_folder("request");
      BakeRequest request = recipe.request(one.batch, farm_.jobs, folder);
      BatchWork::Rules rules;
      rules.cost = cost_of(plan, request.layout, recipe.scene_triangles);
      const BatchWork work(plan, one.batch, std::move(request), folder, rules, kept.earlier(one), cache);
      bytes += cache_bytes(work, plan);
      require_room(settings, bytes);
      write_batch(plan, one.batch, farm_.batch_folder(farm_.batches.size()));
      farm_.batches.push_back(batch_of(work, plan, rules.cost));
      fs::remove_all(folder);
    }
    log::info("{} of {} baked before; {} in {} to bake, at most {} MiB in the cache", sink.taken(),
              counted(plan.targets.size(), "object"), counted(passes(), "pass"),
              counted(farm_.batches.size(), "batch"), bytes >> 20);
  }

 private:
  static void refuse_noise(const Plan& plan) {
    for (const BakeTask& task : plan.tasks) {
      if (task.cycles.noise > 0)
        fail(ExitCode::usage,
             "{}: --noise decides while it bakes how long to go on, which a plan cannot know; give --samples "
             "and leave noise out of the project file's overrides",
             plan.targets[task.target].key);
    }
  }

  static FarmBatch batch_of(const BatchWork& work, const Plan& plan, const PassCost& cost) {
    FarmBatch batch;
    for (const std::size_t task : work.batch().tasks) {
      const std::string& key = plan.targets[plan.tasks[task].target].key;
      if (std::ranges::find(batch.objects, key) == batch.objects.end()) batch.objects.push_back(key);
    }
    for (std::size_t i = 0; i < work.passes().size(); ++i) {
      const SamplePass& pass = work.passes()[i];
      batch.passes.push_back({pass, work.key_of(i), cost.fixed_seconds + cost.sample_seconds * pass.count});
    }
    return batch;
  }

  [[nodiscard]] std::size_t passes() const {
    std::size_t count = 0;
    for (const FarmBatch& batch : farm_.batches) count += batch.passes.size();
    return count;
  }

  BlenderSession& session_;
  const BakeSubject& subject_;
  FarmPlan& farm_;
};

}  // namespace

void require_farmable(const ResolvedConfig& config) {
  const BakeSettings& settings = config.globals;
  if (!settings.run.time.empty())
    fail(ExitCode::usage,
         "--time counts on one machine's clock and cannot be divided; leave it out and give --samples");
  if (settings.object.noise > 0)
    fail(ExitCode::usage,
         "--noise decides while it bakes how long to go on, which a plan cannot know; leave it out and give "
         "--samples");
  if (settings.bake.recipe == BakingSettings::Recipe::flat_normal_map)
    fail(ExitCode::usage,
         "--recipe flat-normal-map is baked in one piece and has no passes to divide; use rnmbake bake, or "
         "--recipe receiver");
  if (cache_folder(settings.run.cache).empty())
    fail(ExitCode::usage,
         "there is no cache to bring results together in; name one with --cache DIR, in a folder that all "
         "machines see");
}

void settle_layout(BakeSettings& settings) {
  settings.run.jobs = choose_jobs(settings, std::numeric_limits<int>::max());
  settings.bake.memory_limit =
      int(std::clamp<std::int64_t>(memory_budget(settings) >> 20, 1, std::numeric_limits<int>::max()));
}

void prepare_plan_folder(const fs::path& folder) {
  make_folders(folder);
  const std::set<std::string> ours{
      "plan.json", "merged.json", "tasks",  "batches",       "scene",
      "slurm",     "openjd.json", "job.sh", "flamenco.json", "rnmbake.flamenco.js"};
  std::vector<fs::path> old;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (ours.contains(name)) old.push_back(entry.path());
    if (!ours.contains(name) && !name.starts_with("."))
      fail(ExitCode::usage, "{} holds {}, which is no part of a plan; name a new or empty folder with --plan",
           folder.string(), name);
  }
  std::ranges::sort(old, [](const fs::path& a, const fs::path&) { return a.filename() == "plan.json"; });
  for (const fs::path& one : old) fs::remove_all(one);
}

FarmPlan make_farm_plan(BlenderSession& session, const BakeSubject& subject, Store& store,
                        const FarmOptions& options) {
  const BlenderInfo& blender = session.blender().info();
  FarmPlan farm;
  farm.folder = fs::absolute(options.folder).lexically_normal();
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  farm.id = hash128_hex(fmt::format("{} {}", owner_word(), now));
  farm.blender = {blender.version_text, blender.build, scripts_hash(session.settings().run.scripts)};
  farm.scene_key = scene_key(session, subject.survey);
  farm.scene_triangles = scene_triangles(subject.survey);
  farm.settings = launch_settings(session.config());
  farm.output = fs::absolute(session.settings().output.dir).lexically_normal();
  farm.work_folder = fs::current_path();
  farm.merge = options.merge;
  farm.inputs = look_at_inputs(subject.survey);
  plan_only(session, subject, Planner(session, subject, farm));
  farm.scene = place_scene(session, subject.blends.shown, farm.folder);
  farm.tasks = cut_tasks(farm.batches, options.task_seconds, launch_seconds(farm.scene_triangles));
  leave_tokens(farm, store);
  write_farm_plan(farm);
  return farm;
}

}  // namespace rnmbake
