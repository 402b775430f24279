#include "pipeline/dispatch/dispatcher.h"

#include "base/error.h"
#include "base/log.h"
#include "base/work_progress.h"
#include "blender/launch_watch.h"
#include "pipeline/dispatch/memory.h"
#include "pipeline/scene/scene_survey.h"
#include "process/stop.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <variant>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

struct Attempt {
  Batch batch;
  int retries_left = 0;
};

/// Number of hung launches, without one that succeeded, after which the scene counts as the cause and no
/// single object is sought. Two offenders, one in each half, hang four launches at most.
constexpr int hangs_of_a_scene = 5;

/// Whether the launch hung while it opened the scene, which does not depend on its batch.
bool is_before_baking(const LaunchFailure& failure) {
  return failure.kind == LaunchFailure::Kind::hung && (failure.phase.empty() || failure.phase == "load");
}

/// Texels x samples, to which the time of a bake is proportional.
double work_of(const Batch& batch, const Plan& plan) {
  double work = 0;
  for (const std::size_t task : batch.tasks) {
    for (const std::size_t rect : plan.tasks[task].rects) {
      const RectSize size = plan.rects[rect].size;
      work += double(size.width) * size.height * plan.tasks[task].cycles.samples;
    }
  }
  return work;
}

double total_work(const Plan& plan) {
  double work = 0;
  for (const Batch& batch : plan.batches) work += work_of(batch, plan);
  return work;
}

class Dispatcher {
 public:
  Dispatcher(BlenderSession& session, const Plan& plan, BlendPath blend, const MakeRequest& make_request,
             PictureSink& sink)
      : session_(session),
        plan_(plan),
        blend_(std::move(blend)),
        make_request_(make_request),
        sink_(sink),
        jobs_(choose_jobs(session.settings(), plan.batches.size())),
        progress_(total_work(plan)) {
    for (const Batch& batch : plan.batches) {
      queue_.push_back({batch, session.settings().run.retries});
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

  void run_attempt(Attempt attempt) {
    drop_settled(attempt.batch);
    if (attempt.batch.tasks.empty() || given_up(attempt.batch)) return;
    Launch launch;
    launch.entry = "bake_entry.py";
    launch.scene = blend_;
    launch.folder = session_.new_folder("bake");
    launch.threads = session_.threads(jobs_);
    BakeRequest request = make_request_(attempt.batch, jobs_, launch.folder);
    launch.request = std::move(request.json);
    launch.request.update(scene_request(session_, blend_.path()));
    const LaunchOutcome outcome = session_.blender().run(
        launch, session_.limits(), [&](const ProgressEvent& event) { show(attempt.batch, event); });
    if (const auto* failure = std::get_if<LaunchFailure>(&outcome)) {
      recover(std::move(attempt), *failure);
    } else if (auto rects = rects_of(request.layout, launch.folder); auto* lost = std::get_if<1>(&rects)) {
      recover(std::move(attempt), *lost);
    } else {
      sink_.take(attempt.batch, request.layout, std::get<0>(std::move(rects)));
      count(attempt.batch, std::get<Finished>(outcome));
    }
    if (!session_.settings().output.keep_temporary) fs::remove_all(launch.folder);
  }

  /// Pictures of a launch; a failure where some are missing or short, whatever its result says. A smaller
  /// launch may succeed.
  std::variant<std::vector<FloatImage>, LaunchFailure> rects_of(const BatchLayout& layout,
                                                                const fs::path& folder) const {
    try {
      return read_rects(layout, plan_, folder);
    } catch (const Error& error) {
      LaunchFailure failure;
      failure.message = error.what();
      return failure;
    }
  }

  /// Removes tasks of targets that were given up.
  void drop_settled(Batch& batch) const {
    std::erase_if(batch.tasks, [&](std::size_t task) { return sink_.is_settled(plan_.tasks[task].target); });
  }

  void recover(Attempt attempt, const LaunchFailure& failure) {
    progress_.finish(attempt.batch.tasks.front(), 0);
    if (is_hopeless(failure)) throw_failure(failure);
    if (!failure.details.empty()) log::debug("{}", failure.details);
    note_failure(failure);
    if (given_up(attempt.batch)) return;
    if (attempt.batch.tasks.size() > 1 && !is_before_baking(failure)) return divide(attempt, failure);
    const BakeTask& task = plan_.tasks[attempt.batch.tasks.front()];
    const bool may_differ =
        failure.kind != LaunchFailure::Kind::refused && failure.kind != LaunchFailure::Kind::outlasted;
    if (may_differ && attempt.retries_left > 0) {
      log::warn("{} ({}): {}; trying again", plan_.targets[task.target].key, task.name, describe(failure));
      enqueue({std::move(attempt.batch), attempt.retries_left - 1});
      return;
    }
    give_up(attempt.batch, fmt::format("{}: {}", task.name, describe(failure)));
  }

  /// Whether the failure (a stop, a full disk, a missing device) would end every other launch, too.
  static bool is_hopeless(const LaunchFailure& failure) {
    return failure.kind == LaunchFailure::Kind::stopped ||
           (failure.kind == LaunchFailure::Kind::refused &&
            (failure.code == int(ExitCode::environment) || failure.code == int(ExitCode::io)));
  }

  void divide(const Attempt& attempt, const LaunchFailure& failure) {
    log::warn("{}; splitting {} bakes to find the offender", describe(failure), attempt.batch.tasks.size());
    for (Batch& half : split(attempt.batch, plan_)) enqueue({std::move(half), attempt.retries_left});
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

  void count(const Batch& batch, const Finished& finished) {
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
    progress_.finish(batch.tasks.front(), work_of(batch, plan_));
  }

  void show(const Batch& batch, const ProgressEvent& event) {
    const double done = event.total > 0 ? work_of(batch, plan_) * event.done / event.total : 0;
    progress_.advance(batch.tasks.front(), done, in_words(event));
  }

  BlenderSession& session_;
  const Plan& plan_;
  BlendPath blend_;
  const MakeRequest& make_request_;
  PictureSink& sink_;
  int jobs_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Attempt> queue_;
  int running_ = 0;
  std::exception_ptr error_;
  BakeTimings timings_;
  int hangs_ = 0;
  std::string verdict_;  // on the scene, where that is what hangs Blender
  WorkProgress progress_;
};

}  // namespace

int choose_jobs(const BakeSettings& settings, std::size_t batches) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int wanted = settings.run.jobs > 0 ? settings.run.jobs : cores;
  return std::clamp(static_cast<int>(batches), 1, wanted);
}

MakeRequest receiver_requests(const BakeSettings& settings, const SceneSurvey& survey, const Plan& plan) {
  return [&](const Batch& batch, int jobs, const fs::path& folder) {
    return receiver_request(plan, batch, atlas_pixels_for(settings, survey, plan, batch, jobs), folder);
  };
}

BakeTimings run_batches(BlenderSession& session, const Plan& plan, const BlendPath& blend,
                        const MakeRequest& make_request, PictureSink& sink) {
  return Dispatcher(session, plan, blend, make_request, sink).run();
}

}  // namespace rnmbake
