#include "jobs/graph.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

using Names = std::vector<std::string>;

/// Remembers which tasks ran, in their order.
class Trace {
 public:
  Task task(const std::string& name, std::vector<TaskNumber> needs = {}, double cost = 0) {
    return {name, [this, name] { note(name); }, std::move(needs), cost};
  }
  void note(const std::string& name) {
    const std::lock_guard lock(mutex_);
    names_.push_back(name);
  }
  [[nodiscard]] Names names() const {
    const std::lock_guard lock(mutex_);
    return names_;
  }

 private:
  mutable std::mutex mutex_;
  Names names_;
};

Task failing(const std::string& name, const std::string& why, std::vector<TaskNumber> needs = {}) {
  return {name, [why] { throw std::runtime_error(why); }, std::move(needs)};
}

bool is_done(const TaskOutcome& outcome) {
  return std::holds_alternative<Done>(outcome);
}

std::string skipped_because(const TaskOutcome& outcome) {
  const auto* skipped = std::get_if<Skipped>(&outcome);
  return skipped == nullptr ? "not skipped" : skipped->reason;
}

/// A time at which tasks end only together: one round passes when `width` tasks are in it.
class Rounds {
 public:
  explicit Rounds(int width) : width_(width) {}

  /// False where nobody else came for so long that nobody will.
  bool pass() {
    std::unique_lock lock(mutex_);
    const int mine = count_;
    if (++inside_ == width_) {
      inside_ = 0;
      ++count_;
      changed_.notify_all();
      return true;
    }
    return changed_.wait_for(lock, std::chrono::seconds(60), [&] { return count_ != mine; });
  }
  [[nodiscard]] int count() const { return count_; }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int width_, inside_ = 0, count_ = 0;
};

TEST(TaskGraph, KeepsBothWorkersBusy) {
  Rounds rounds(2);
  std::atomic<int> alone = 0;
  TaskGraph graph({2, {}, {}});
  for (int i = 0; i < 64; ++i) graph.add({"equal", [&] { alone += rounds.pass() ? 0 : 1; }, {}});
  for (const TaskOutcome& outcome : graph.run()) EXPECT_TRUE(is_done(outcome));
  EXPECT_EQ(rounds.count(), 32);  // the least that 64 tasks on two workers can take
  EXPECT_EQ(alone, 0);
}

TEST(TaskGraph, AddsLittleToTheTimeOfItsTasks) {
  std::atomic<std::int64_t> inside = 0;
  const auto now = [] { return std::chrono::steady_clock::now(); };
  TaskGraph graph({2, {}, {}});
  for (int i = 0; i < 64; ++i) {
    graph.add({"equal",
               [&] {
                 const auto begin = now();
                 std::this_thread::sleep_for(std::chrono::milliseconds(10));
                 inside += (now() - begin).count();
               },
               {}});
  }
  const auto begin = now();
  (void)graph.run();
  const double share = double((now() - begin).count()) / double(inside.load());
  RecordProperty("share", std::to_string(share));
  EXPECT_LT(share, 0.75);  // 0.5 on two workers, 1 on one; other programs have the cores, too
}

TEST(TaskGraph, BeginsInOrderAndTheCostlyFirst) {
  Trace trace;
  TaskGraph graph({1, {}, {}});
  const TaskNumber a = graph.add(trace.task("a"));
  const TaskNumber b = graph.add(trace.task("b", {a}));
  graph.add(trace.task("c", {b, a, b}));
  graph.add(trace.task("cheap", {}, 1));
  graph.add(trace.task("costly", {}, 10));
  graph.add(trace.task("d"));
  (void)graph.run();
  EXPECT_EQ(trace.names(), (Names{"costly", "cheap", "a", "b", "c", "d"}));
}

TEST(TaskGraph, SkipsOnlyWhatNeedsAFailedTask) {
  Trace trace;
  TaskGraph graph({2, {}, {}});
  const TaskNumber survey = graph.add(trace.task("survey"));
  const TaskNumber floor = graph.add(failing("bake floor", "no UVs", {survey}));
  const TaskNumber wall = graph.add(trace.task("bake wall", {survey}));
  const TaskNumber floor_file = graph.add(trace.task("write floor", {floor}));
  const TaskNumber wall_file = graph.add(trace.task("write wall", {wall}));
  const TaskNumber manifest = graph.add(trace.task("manifest", {floor_file, wall_file}));
  const auto outcomes = graph.run();
  EXPECT_TRUE(is_done(outcomes[survey]));
  EXPECT_EQ(std::get<Failed>(outcomes[floor]).reason, "no UVs");
  EXPECT_TRUE(is_done(outcomes[wall]));
  EXPECT_TRUE(is_done(outcomes[wall_file]));
  EXPECT_EQ(skipped_because(outcomes[floor_file]), "'bake floor' failed: no UVs");
  EXPECT_EQ(skipped_because(outcomes[manifest]), "'bake floor' failed: no UVs");
}

TEST(TaskGraph, TakesTasksFromTasks) {
  Trace trace;
  TaskGraph graph({2, {}, {}});
  std::vector<TaskNumber> parts;
  const TaskNumber failed = graph.add(failing("broken", "why"));
  graph.add({"plan",
             [&] {
               for (int i = 0; i < 20; ++i) parts.push_back(graph.add(trace.task("part")));
               graph.add(trace.task("sum", parts));
               graph.add(trace.task("never", {failed, parts[0]}));
             },
             {failed}});
  const TaskNumber plan = graph.add({"plan again",
                                     [&] {
                                       for (int i = 0; i < 20; ++i)
                                         parts.push_back(graph.add(trace.task("part")));
                                       graph.add(trace.task("sum", parts));
                                     },
                                     {}});
  const auto outcomes = graph.run();
  EXPECT_TRUE(is_done(outcomes[plan]));
  ASSERT_EQ(outcomes.size(), 3U + 21U);
  ASSERT_EQ(trace.names().size(), 21U);
  EXPECT_EQ(trace.names().back(), "sum");
}

TEST(TaskGraph, TellsALateTaskThatItsNeedFailed) {
  Trace trace;
  TaskGraph graph({1, {}, {}});
  const TaskNumber failed = graph.add(failing("broken", "why"));
  graph.add({"later", [&] { graph.add(trace.task("late", {failed})); }, {}});
  const auto outcomes = graph.run();
  ASSERT_EQ(outcomes.size(), 3U);
  EXPECT_EQ(skipped_because(outcomes[2]), "'broken' failed: why");
  EXPECT_TRUE(trace.names().empty());
}

TEST(TaskGraph, EndsWhatRunsWhenItIsStopped) {
  std::atomic<bool> stop = false;
  std::atomic<int> begun = 0, ended = 0;
  Rounds rounds(2);
  TaskGraph graph({2, [&] { return stop.load(); }, {}});
  for (int i = 0; i < 10; ++i) {
    graph.add({"task",
               [&] {
                 ++begun;
                 (void)rounds.pass();  // both workers are inside
                 stop = true;
                 ++ended;
               },
               {}});
  }
  const auto outcomes = graph.run();
  EXPECT_EQ(begun, 2);
  EXPECT_EQ(ended, 2);
  EXPECT_TRUE(is_done(outcomes[0]));
  EXPECT_TRUE(is_done(outcomes[1]));
  for (std::size_t i = 2; i < 10; ++i) EXPECT_EQ(skipped_because(outcomes[i]), "stopped");
}

TEST(TaskGraph, RethrowsWhatIsHopelessAfterWhatRanHasEnded) {
  Rounds rounds(2);
  std::atomic<bool> other_ended = false;
  std::atomic<int> later = 0;
  TaskGraph graph({2, {}, {}});
  graph.add({"hopeless",
             [&] {
               (void)rounds.pass();
               throw Hopeless("the disk is full");
             },
             {}});
  graph.add({"other",
             [&] {
               (void)rounds.pass();
               std::this_thread::sleep_for(std::chrono::milliseconds(50));
               other_ended = true;
             },
             {}});
  const TaskNumber third = graph.add({"needs both", [&] { ++later; }, {0, 1}});
  graph.add({"last", [&] { ++later; }, {third}});
  try {
    (void)graph.run();
    FAIL() << "went on";
  } catch (const Hopeless& error) {
    EXPECT_STREQ(error.what(), "the disk is full");
  }
  EXPECT_TRUE(other_ended);
  EXPECT_EQ(later, 0);
}

TEST(TaskGraph, LetsTheCallerSayWhatIsHopeless) {
  struct Signal {
    int number;
  };
  TaskGraph graph({1, {}, [](const std::exception& error) { return std::string(error.what()) == "full"; }});
  std::atomic<int> later = 0;
  graph.add(failing("one", "other"));
  graph.add(failing("two", "full"));
  graph.add({"three", [&] { ++later; }, {}});
  EXPECT_THROW((void)graph.run(), std::runtime_error);
  EXPECT_EQ(later, 0);
  TaskGraph stopped({2, {}, {}});
  stopped.add({"no std::exception", [] { throw Signal{2}; }, {}});
  EXPECT_THROW((void)stopped.run(), Signal);
}

TEST(TaskGraph, RefusesNeedsThatAreNotThere) {
  TaskGraph graph({1, {}, {}});
  EXPECT_THROW(graph.add({"one", [] {}, {0}}), std::out_of_range);
  EXPECT_TRUE(graph.run().empty());
}

TEST(TaskGraph, RunsManyTasksOfARandomGraph) {
  constexpr std::size_t count = 2000;
  std::vector<std::atomic<bool>> done(count);
  std::atomic<int> too_early = 0;
  TaskGraph graph({4, {}, {}});
  std::uint64_t state = 1;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<TaskNumber> needs;
    for (int k = 0; k < 3 && i > 0; ++k) {
      state = state * 6364136223846793005U + 1442695040888963407U;
      needs.push_back((state >> 33) % i);
    }
    graph.add({"task",
               [&, i, needs] {
                 for (const TaskNumber need : needs) too_early += done[need] ? 0 : 1;
                 done[i] = true;
               },
               needs, double(state % 7)});
  }
  for (const TaskOutcome& outcome : graph.run()) EXPECT_TRUE(is_done(outcome));
  EXPECT_EQ(too_early, 0);
}

}  // namespace
}  // namespace rnmbake
