#include "pipeline/dispatch/dispatcher.h"

#include "base/error.h"
#include "base/log.h"
#include "base/work_progress.h"
#include "blender/launch_watch.h"
#include "jobs/jobserver.h"
#include "pipeline/dispatch/batch_work.h"
#include "pipeline/dispatch/kept_targets.h"
#include "pipeline/dispatch/launch_batch.h"
#include "process/stop.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <variant>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

struct Attempt {
  MissingBatch missing;
  EarlierPictures earlier;          // of a batch that was divided
  std::shared_ptr<BatchWork> work;  // from the first try on
  int retries_left = 0;
  bool was_killed = false, is_shown = false;
  std::vector<WholeBatch> wholes = {};  // whose piece it is, where pieces are looked into

  [[nodiscard]] const Batch& batch() const { return missing.batch; }
};

/// Number of hung launches, without one that succeeded, after which the scene counts as the cause and no
/// single object is sought. Two offenders, one in each half, hang four launches at most.
constexpr int hangs_of_a_scene = 5;

/// Whether the launch hung while it opened the scene, which does not depend on its batch.
bool is_before_baking(const LaunchFailure& failure) {
  return failure.kind == LaunchFailure::Kind::hung && (failure.phase.empty() || failure.phase == "load");
}

class Dispatcher {
 public:
  Dispatcher(BlenderSession& session, const Plan& plan, BlendPath blend, const BatchRecipe& recipe,
             PictureSink& sink, const DispatchRules& rules)
      : session_(session),
        plan_(plan),
        blend_(std::move(blend)),
        recipe_(recipe),
        sink_(sink),
        rules_(rules),
        kept_(plan, rules.cache, sink),
        progress_(0) {
    const auto all_jobs = choose_jobs(session.settings(), plan.batches.size());
    const std::vector<MissingBatch> missing =
        rules.shares.empty() ? kept_.missing(cut_by(recipe_, plan_, all_jobs)) : rules.shares;
    jobs_ = jobs_granted(jobserver_, choose_jobs(session.settings(), missing.size()));
    for (MissingBatch one : missing) {
      if (!recipe_.in_passes) one.done = {0, 0};  // it is baked as a whole, so nothing adds to what is there
      progress_.leave_out(-work_of(one));
      queue_.push_back({std::move(one), {}, nullptr, session.settings().run.retries});
    }
  }

  BakeTimings run() {
    const auto start = std::chrono::steady_clock::now();
    std::vector<std::thread> workers;
    workers.reserve(static_cast<std::size_t>(jobs_));
    for (int job = 0; job < jobs_; ++job) workers.emplace_back([this] { work(); });
    watch();
    for (std::thread& worker : workers) worker.join();
    if (error_) std::rethrow_exception(error_);
    if (rules_.shares.empty() && !rules_.why_missing) {  // a merge may have to be made again
      for (const ResultKey& key : used_) rules_.cache.forget(key);
      kept_.forget_journal();
    }
    timings_.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return timings_;
  }

 private:
  /// Shows signs of life until nothing runs or waits any more.
  void watch() {
    std::unique_lock lock(mutex_);
    while (running_ > 0 || (!queue_.empty() && !error_)) {
      changed_.wait_for(lock, std::chrono::milliseconds(250));
      progress_.tick();
    }
  }

  void work() {
    while (auto attempt = next()) {
      try {
        run_attempt(*attempt);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!error_) error_ = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      --running_;
      changed_.notify_all();
    }
    jobserver_.release();  // of the last worker there is none: it has make's own slot
  }

  std::optional<Attempt> next() {
    std::unique_lock lock(mutex_);
    // A running task may still split, so an empty queue alone is not the end.
    changed_.wait(lock, [this] { return error_ || !queue_.empty() || running_ == 0; });
    if (error_ || queue_.empty()) return std::nullopt;
    Attempt attempt = std::move(queue_.front());
    queue_.pop_front();
    ++running_;
    return attempt;
  }

  /// Texels x samples, to which the time of a bake is proportional.
  [[nodiscard]] double work_of(const MissingBatch& missing) const {
    double work = 0;
    for (const std::size_t task : missing.batch.tasks) {
      const int samples = plan_.tasks[task].cycles.samples - missing.done[0] - missing.done[1];
      work += double(texels_of(plan_, plan_.tasks[task].rects)) * samples;
    }
    return work;
  }

  void begin(Attempt& attempt) {
    const std::filesystem::path folder = session_.new_folder("bake");
    BatchWork::Rules rules;
    rules.whole = !recipe_.in_passes;
    rules.deadline = rules_.deadline;
    rules.halves = rules_.halves;
    rules.only = attempt.missing.passes;
    rules.wholes = attempt.wholes;
    BakeRequest request = recipe_.request(attempt.batch(), jobs_, folder);
    rules.cost = cost_of(plan_, request.layout, recipe_.scene_triangles);
    if (attempt.earlier.empty() && attempt.wholes.empty()) attempt.earlier = kept_.earlier(attempt.missing);
    attempt.work = std::make_shared<BatchWork>(plan_, attempt.batch(), std::move(request), folder, rules,
                                               std::exchange(attempt.earlier, {}), rules_.cache);
    attempt.work->take_kept();
    progress_.leave_out(attempt.work->kept());
  }

  void run_attempt(Attempt attempt) {
    if (is_settled(attempt.batch()) || given_up(attempt.batch())) return;
    if (!attempt.work) begin(attempt);
    BatchWork& work = *attempt.work;
    if (!work.is_complete() && rules_.why_missing) return look_into_pieces(attempt);
    if (!work.is_complete()) {
      const std::size_t passes_before = work.passes_done();
      const double before = work.done();
      const LaunchOutcome outcome =
          launch_batch(session_, blend_, jobs_, work, [&](const ProgressEvent& event) {
            show(work, before, event);
            preview(work, attempt.is_shown);
          });
      const auto* failure = std::get_if<LaunchFailure>(&outcome);
      if (failure == nullptr && work.is_complete()) count(std::get<Finished>(outcome));
      if (!work.is_complete()) {
        const LaunchFailure cause = failure != nullptr ? *failure : no_picture(work, plan_);
        return recover(std::move(attempt), cause, work.passes_done() > passes_before);
      }
      if (failure != nullptr) note_failure(*failure);  // after the last picture
    }
    deliver(work);
  }

  void deliver(BatchWork& work) {
    std::vector<BakedPicture> pictures = work.take_pictures();
    if (rules_.shares.empty() && !rules_.why_missing)
      kept_.keep(work.layout(), pictures, rules_.deadline.has_value());
    sink_.take(work.batch(), work.layout(), std::move(pictures));
    progress_.leave_out(work.take_less_work());
    progress_.finish(work.batch().tasks.front(), work.done() - work.kept());
    if (!session_.settings().output.keep_temporary) fs::remove_all(work.folder());
    const std::lock_guard lock(mutex_);
    for (ResultKey& key : work.used_keys()) used_.push_back(std::move(key));
  }

  [[nodiscard]] bool is_settled(const Batch& batch) const {
    return std::ranges::all_of(batch.tasks,
                               [&](std::size_t task) { return sink_.is_settled(plan_.tasks[task].target); });
  }

  void recover(Attempt attempt, const LaunchFailure& failure, bool got_on) {
    const Batch& batch = attempt.batch();
    progress_.finish(batch.tasks.front(), 0);
    if (is_hopeless(failure)) throw_failure(failure);
    if (!failure.details.empty()) log::debug("{}", failure.details);
    note_failure(failure);
    if (given_up(batch)) return;
    const bool may_differ =
        failure.kind != LaunchFailure::Kind::refused && failure.kind != LaunchFailure::Kind::outlasted;
    const bool first_kill = failure.kind == LaunchFailure::Kind::killed && !attempt.was_killed;
    if (batch.tasks.size() > 1 && !is_before_baking(failure) && !(may_differ && got_on) && !first_kill)
      return divide(attempt, failure);
    const BakeTask& task = plan_.tasks[batch.tasks.front()];
    const bool free_of_charge = may_differ && (got_on || (first_kill && batch.tasks.size() > 1));
    if (free_of_charge || (may_differ && attempt.retries_left > 0)) {
      log::warn("{} ({}): {}; trying again", plan_.targets[task.target].key, task.name, describe(failure));
      if (!free_of_charge) --attempt.retries_left;
      attempt.was_killed |= failure.kind == LaunchFailure::Kind::killed;
      return enqueue(std::move(attempt));
    }
    give_up(batch, fmt::format("{}: {}", task.name, describe(failure)));
  }

  /// Whether the failure (a stop, a full disk, a missing device) would end every other launch, too.
  static bool is_hopeless(const LaunchFailure& failure) {
    return failure.kind == LaunchFailure::Kind::stopped ||
           (failure.kind == LaunchFailure::Kind::refused &&
            (failure.code == int(ExitCode::environment) || failure.code == int(ExitCode::io)));
  }

  void divide(const Attempt& attempt, const LaunchFailure& failure) {
    const Batch& batch = attempt.batch();
    log::warn("{}; splitting {} bakes to find the offender", describe(failure), batch.tasks.size());
    // A share has pictures of no use to it, and its halves bake the very passes that it lacks.
    const bool is_share = !rules_.shares.empty();
    const EarlierPictures earlier = is_share ? EarlierPictures{} : attempt.work->so_far();
    const auto passes = is_share ? attempt.work->passes_left() : std::vector<SamplePass>{};
    for (Batch& half : split(batch, plan_))
      enqueue({{std::move(half), attempt.missing.done, passes}, earlier, nullptr, attempt.retries_left});
  }

  /// A batch that failed elsewhere was split there, pass by pass.
  void look_into_pieces(const Attempt& attempt) {
    const Batch& batch = attempt.batch();
    if (batch.tasks.size() == 1) {
      const std::size_t target = plan_.tasks[batch.tasks.front()].target;
      return sink_.give_up(target, rules_.why_missing(target));
    }
    std::vector<WholeBatch> wholes = attempt.wholes;
    wholes.push_back(attempt.work->as_whole());
    const EarlierPictures earlier = attempt.work->so_far();
    for (Batch& half : split(batch, plan_))
      enqueue({{std::move(half), attempt.missing.done, attempt.work->passes_left()},
               earlier,
               nullptr,
               0,
               false,
               false,
               wholes});
  }

  void note_failure(const LaunchFailure& failure) {
    const std::lock_guard lock(mutex_);
    ++timings_.launches;
    ++timings_.failed_launches;
    if (failure.kind != LaunchFailure::Kind::hung) return;
    ++hangs_;
    const bool none_succeeded = timings_.launches == timings_.failed_launches;
    if (verdict_.empty() && hangs_ >= hangs_of_a_scene && none_succeeded)
      verdict_ = fmt::format("{} launches hung, whatever they were to bake: {}", hangs_, describe(failure));
  }

  /// Gives up the batch's targets where the scene itself counts as the cause of hangs.
  bool given_up(const Batch& batch) {
    std::unique_lock lock(mutex_);
    if (verdict_.empty()) return false;
    lock.unlock();  // it is never changed again
    give_up(batch, verdict_);
    return true;
  }

  void give_up(const Batch& batch, const std::string& reason) {
    for (const std::size_t task : batch.tasks) sink_.give_up(plan_.tasks[task].target, reason);
  }

  /// Appends to the queue: retries run last, since a first success elsewhere shows that the scene is sound.
  void enqueue(Attempt attempt) {
    const std::lock_guard lock(mutex_);
    queue_.push_back(std::move(attempt));
    changed_.notify_all();
  }

  void count(const Finished& finished) {
    const std::lock_guard lock(mutex_);
    ++timings_.launches;
    timings_.launch_seconds += finished.wall_seconds;
    timings_.peak_bytes = std::max(timings_.peak_bytes, finished.peak_bytes);
    for (const auto& laps : finished.result) {
      for (const auto& lap : laps) {
        timings_.prepare_seconds += lap.value("prepare_seconds", 0.0);
        timings_.bake_seconds += lap.value("bake_seconds", 0.0);
        timings_.save_seconds += lap.value("save_seconds", 0.0);
      }
    }
  }

  /// `before`: work that was done when the launch began.
  void show(BatchWork& work, double before, const ProgressEvent& event) {
    const double share = event.total > 0 ? event.done / event.total : 0;
    const double since = recipe_.in_passes ? event.done : work.work() * share;
    const double done = std::clamp(before + since, work.done(), work.work());
    progress_.leave_out(work.take_less_work());
    progress_.advance(work.batch().tasks.front(), done - work.kept(), in_words(event));
  }

  /// After the first pass, unless it was the last, too.
  void preview(const BatchWork& work, bool& is_shown) {
    if (!rules_.preview || is_shown || work.passes_done() == 0 || work.is_complete()) return;
    is_shown = true;
    sink_.preview(work.layout(), work.pictures());
  }

  BlenderSession& session_;
  const Plan& plan_;
  BlendPath blend_;
  const BatchRecipe& recipe_;
  PictureSink& sink_;
  const DispatchRules& rules_;
  KeptTargets kept_;
  Jobserver jobserver_;
  int jobs_ = 1;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Attempt> queue_;
  int running_ = 0;
  std::exception_ptr error_;
  BakeTimings timings_;
  int hangs_ = 0;
  std::string verdict_;          // on the scene, where that is what hangs Blender
  std::vector<ResultKey> used_;  // of passes
  WorkProgress progress_;
};

}  // namespace

BakeTimings run_batches(BlenderSession& session, const Plan& plan, const BlendPath& blend,
                        const BatchRecipe& recipe, PictureSink& sink, const DispatchRules& rules) {
  return Dispatcher(session, plan, blend, recipe, sink, rules).run();
}

}  // namespace rnmbake
