#include "trace/gather_store.h"

#include "trace/trace_scenes.h"

#include <atomic>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Keeps everything in memory.
class MemoryStore : public GatherStore {
 public:
  MemoryStore() { paths_of_part = 256; }
  std::optional<std::string> find(const GatherPart& part) override {
    const std::lock_guard lock(mutex_);
    const auto found = all.find(key(part));
    if (found == all.end()) return std::nullopt;
    ++hits;
    return found->second;
  }
  void keep(const GatherPart& part, const std::string& bytes) override {
    const std::lock_guard lock(mutex_);
    all[key(part)] = bytes;
  }

  using Key = std::tuple<std::size_t, int, int, std::size_t, std::size_t>;
  std::map<Key, std::string> all;
  int hits = 0;

 private:
  static Key key(const GatherPart& part) {
    return {part.target, part.direction, part.round, part.first_block, part.blocks};
  }
  std::mutex mutex_;
};

DiffuseScene furnished_room() {
  DiffuseScene scene;
  add_object(scene, "room", room(1), Vec3(0.5F), Vec3(1));
  add_object(scene, "box", box(Vec3(-0.3F), Vec3(0.2F), false), Vec3(0.8F));
  return scene;
}

struct Gathering {
  explicit Gathering(GatherOptions wanted) : options(std::move(wanted)) {
    surfaces = {surface_of(furnished, 0), surface_of(furnished, 1)};
    targets = {{&surfaces[0], 0, 16, 16, 7}, {&surfaces[1], 1, 8, 8, 8}};
  }

  /// How many targets came; `most` batches are gathered before it is stopped.
  std::size_t run(GatherStore* store, int most = 1 << 30) {
    std::atomic<int> batches = 0;
    std::size_t came = 0;
    const auto take = [&](std::size_t index, Gathered&& gathered) {
      results[index] = std::move(gathered);
      ++came;
    };
    gather(
        scene, targets, options, take, [&](const GatherProgress&) { ++batches; },
        [&] { return batches >= most; }, store);
    polled = batches;
    return came;
  }

  const DiffuseScene furnished = furnished_room();
  const TraceScene scene{furnished, "4.3.2"};
  std::vector<Surface> surfaces;
  std::vector<GatherTarget> targets;
  GatherOptions options;
  std::map<std::size_t, Gathered> results;
  int polled = 0;
};

void expect_equal(const Gathering& a, const Gathering& b) {
  for (std::size_t target = 0; target < 2; ++target) {
    const Gathered &one = a.results.at(target), &other = b.results.at(target);
    EXPECT_EQ(one.coverage.data(), other.coverage.data());
    EXPECT_EQ(one.validity.data(), other.validity.data());
    EXPECT_EQ(one.paths, other.paths);
    EXPECT_EQ(one.rays, other.rays);
    ASSERT_EQ(one.sh.size(), other.sh.size());
    for (std::size_t c = 0; c < one.sh.size(); ++c) EXPECT_EQ(one.sh[c].data(), other.sh[c].data());
    ASSERT_EQ(one.directions.size(), other.directions.size());
    for (std::size_t k = 0; k < one.directions.size(); ++k) {
      EXPECT_EQ(one.directions[k].radiance.data(), other.directions[k].radiance.data());
      EXPECT_EQ(one.directions[k].standard_error.data(), other.directions[k].standard_error.data());
      EXPECT_EQ(one.directions[k].mean_error, other.directions[k].mean_error);
    }
  }
}

std::vector<GatherOptions> ways() {
  GatherOptions plain = all_directions(32);
  plain.sh_order = 2;
  GatherOptions to_error = all_directions(4096);
  to_error.error = 0.05;
  GatherOptions apart = all_directions(8);
  apart.faults.self_reflection = true;
  apart.blender_version = "4.3.2";
  return {plain, to_error, apart};
}

TEST(GatherStore, GoesOnToTheSameResultWhereverItWasStopped) {
  for (const GatherOptions& options : ways()) {
    Gathering whole(options);
    ASSERT_EQ(whole.run(nullptr), 2U);
    for (const int threads : {1, 2}) {
      Gathering stopped(options);
      stopped.options.threads = threads;
      MemoryStore store;
      int runs = 0;
      while (stopped.run(&store, whole.polled / 3) < 2) ASSERT_LT(++runs, 40);
      EXPECT_GT(runs, 0) << "the test is too weak";
      EXPECT_GT(store.hits, 0);
      expect_equal(stopped, whole);
    }
  }
}

TEST(GatherStore, GathersNothingAgainThatIsComplete) {
  for (const GatherOptions& options : ways()) {
    MemoryStore store;
    Gathering first(options), again(options);
    ASSERT_EQ(first.run(&store), 2U);
    ASSERT_EQ(again.run(&store, 1), 2U);  // the first batch would stop it
    expect_equal(first, again);
  }
}

TEST(GatherStore, GathersAgainWhatCannotBeRead) {
  for (const GatherOptions& options : ways()) {
    MemoryStore store;
    Gathering first(options), again(options);
    ASSERT_EQ(first.run(&store), 2U);
    for (auto& [key, bytes] : store.all) bytes.pop_back();
    ASSERT_EQ(again.run(&store), 2U);
    expect_equal(first, again);
  }
}

TEST(GatherStore, TargetsDoNotDependOnThoseBesideThem) {
  Gathering both(all_directions(16)), alone(all_directions(16));
  ASSERT_EQ(both.run(nullptr), 2U);
  alone.targets.erase(alone.targets.begin());
  ASSERT_EQ(alone.run(nullptr), 1U);
  EXPECT_EQ(alone.results.at(0).directions[1].radiance.data(),
            both.results.at(1).directions[1].radiance.data());
}

}  // namespace
}  // namespace rnmbake
