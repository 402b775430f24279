#include "base/clock.h"
#include "pipeline/dispatch/dispatcher.h"
#include "pipeline/fixture.h"

#include <map>
#include <set>

namespace rnmbake {
namespace {

using Kind = LaunchFailure::Kind;

/// A bake of two invented objects in several passes, with a cache.
struct PassBake {
  explicit PassBake(const std::filesystem::path& cache, int samples = 1 << 18, double noise = 0)
      : store(cache, 0), scene(2, {}), context(scene.context()) {
    Plan plan = scene.plan();
    for (BakeTask& task : plan.tasks) {
      task.cycles.samples = samples;
      task.cycles.noise = noise;
    }
    planned = std::move(plan);
  }

  BakeTimings run() {
    BlenderSession session(scene.config(), blender);
    BakeCollector collector(BakeContext{context.survey, context.targets, context.bases, planned},
                            scene.settings().output, scene.headers(), preview);
    auto recipe = receiver_requests(scene.settings(), context.survey, planned);
    recipe.in_passes = in_passes;
    const PassCache cache(store, KeyMaker().add("scene", "a").make("scene"));
    DispatchRules rules{cache, deadline};
    rules.preview = preview;
    const BakeTimings timings =
        run_batches(session, planned, BlendPath("scene.blend"), recipe, collector, rules);
    delivered = is_delivered(collector, 0) && is_delivered(collector, 1);
    for (std::size_t i = 0; i < 2 && delivered; ++i)
      outcome.push_back(std::get<Delivered>(*collector.deliveries()[i]));
    return timings;
  }

  [[nodiscard]] std::multiset<std::pair<int, int>> samples_baked() const {
    std::multiset<std::pair<int, int>> baked;
    for (const auto& pass : blender.passes) baked.emplace(pass.at("seed"), pass.at("first"));
    return baked;
  }

  Store store;
  Invented scene;
  BakeContext context;
  Plan planned;
  FakeBlender blender;
  std::optional<double> deadline;
  bool delivered = false, preview = false, in_passes = true;
  std::vector<Delivered> outcome;  // [targets]
};

/// Ends the launch after so many passes of all launches.
void die_after(PassBake& bake, std::size_t passes, Kind kind = Kind::crashed) {
  bake.blender.fault_after = [&bake, passes, kind](const nlohmann::json&) {
    return bake.blender.passes.size() == passes ? std::optional(failure(kind, "it ended")) : std::nullopt;
  };
}

std::size_t passes_of_whole(const std::filesystem::path& cache) {
  PassBake bake(cache);
  (void)bake.run();
  return bake.blender.passes.size();
}

TEST(Passes, AreBakedOnceEach) {
  const TempFolder folder;
  PassBake bake(folder.path());
  EXPECT_EQ(bake.run().launches, 1);
  EXPECT_TRUE(bake.delivered);
  const auto baked = bake.samples_baked();
  EXPECT_GT(baked.size(), 4U);
  EXPECT_EQ(std::set(baked.begin(), baked.end()).size(), baked.size());
}

TEST(Passes, AreShownAfterTheFirst) {
  const TempFolder folder;
  for (const bool preview : {false, true}) {
    PassBake bake(folder.path() / (preview ? "with" : "without"));
    bake.preview = preview;
    std::vector<bool> is_there;  // after each pass
    bake.blender.fault_after = [&](const nlohmann::json&) {
      is_there.push_back(std::filesystem::exists(bake.scene.folder() / "preview" / "object1.png"));
      return std::nullopt;
    };
    (void)bake.run();
    EXPECT_TRUE(bake.delivered);
    ASSERT_GT(is_there.size(), 2U);
    EXPECT_EQ(is_there.back(), preview);
    EXPECT_FALSE(std::filesystem::exists(bake.scene.folder() / "preview"));
  }
}

TEST(Passes, ThatAreThereAreNotBakedAgainAfterACrash) {
  const TempFolder folder, other;
  const std::size_t all = passes_of_whole(other.path());
  for (const std::size_t after : {std::size_t{1}, all / 2, all - 1}) {
    const TempFolder cache;
    PassBake bake(cache.path());
    die_after(bake, after);
    const BakeTimings timings = bake.run();
    EXPECT_TRUE(bake.delivered);
    EXPECT_EQ(timings.launches, 2);
    EXPECT_EQ(bake.blender.passes.size(), all);  // none twice, since those that were whole counted
  }
}

TEST(Passes, OfARunThatWasStoppedAreTakenUpByTheNext) {
  const TempFolder cache, other;
  const std::size_t all = passes_of_whole(other.path());
  PassBake stopped(cache.path());
  die_after(stopped, 3, Kind::stopped);
  EXPECT_THROW((void)stopped.run(), Interrupted);
  PassBake next(cache.path());
  (void)next.run();
  EXPECT_TRUE(next.delivered);
  EXPECT_EQ(next.blender.passes.size(), all - 3);
}

TEST(Passes, OfWhatIsKnownAreNotBakedAtAll) {
  const TempFolder cache;
  PassBake first(cache.path()), second(cache.path());
  (void)first.run();
  const BakeTimings timings = second.run();
  EXPECT_EQ(timings.launches, 0);
  EXPECT_TRUE(second.delivered);
  EXPECT_TRUE(second.blender.launches.empty());
}

TEST(Passes, OfMoreSamplesGoOnFromThoseThatAreThere) {
  const TempFolder cache;
  PassBake few(cache.path(), 1 << 16), many(cache.path(), 1 << 18);
  (void)few.run();
  (void)many.run();
  std::map<int, int> samples;  // by seed
  for (const auto& pass : many.blender.passes) {
    EXPECT_GE(pass.at("first"), 1 << 15);
    samples[pass.at("seed").get<int>()] += pass.at("count").get<int>();
  }
  for (const auto& [seed, count] : samples) EXPECT_EQ(count, (1 << 17) - (1 << 15)) << seed;
  EXPECT_EQ(samples.size(), 2U);
}

TEST(Passes, OfWhatIsBakedAsAWholeAddToNothing) {
  const TempFolder cache, other;
  PassBake few(cache.path(), 16), many(cache.path(), 64), alone(other.path(), 64);
  for (PassBake* bake : {&few, &many, &alone}) {
    bake->in_passes = false;
    bake->blender.noise = 1;
    (void)bake->run();
  }
  ASSERT_EQ(many.outcome.size(), 2U);
  EXPECT_NE(few.outcome[0].hashes, many.outcome[0].hashes) << "the test is too weak";
  EXPECT_EQ(many.outcome[0].hashes, alone.outcome[0].hashes);
}

TEST(Passes, GoOnUntilTheNoiseIsSmallEnough) {
  const TempFolder cache;
  const double wanted = 0.05;
  PassBake bake(cache.path(), 1 << 18, wanted);
  bake.blender.noise = 0.4;  // of a mean of 0.5, or twice that: 256 samples, or 1024
  (void)bake.run();
  ASSERT_TRUE(bake.delivered);
  for (const Delivered& one : bake.outcome) {
    EXPECT_LE(one.standard_error, 1.02 * wanted);  // another mean stands below it than in the decision
    EXPECT_GE(one.standard_error, wanted / 2);
    EXPECT_GE(one.samples, 256 * 0.8);
    EXPECT_LE(one.samples, 1024 * 2);
  }
  PassBake again(cache.path(), 1 << 18, wanted);
  again.blender.noise = 0.4;
  EXPECT_EQ(again.run().launches, 0);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(again.outcome[i].samples, bake.outcome[i].samples);
}

TEST(Passes, OfRoundsThatWereCutOffEndAlike) {
  const TempFolder cache, other;
  const auto make = [](PassBake& bake) { bake.blender.noise = 0.4; };
  PassBake whole(other.path(), 1 << 18, 0.02), stopped(cache.path(), 1 << 18, 0.02),
      next(cache.path(), 1 << 18, 0.02);
  make(whole), make(stopped), make(next);
  (void)whole.run();
  die_after(stopped, 5, Kind::stopped);
  EXPECT_THROW((void)stopped.run(), Interrupted);
  (void)next.run();
  EXPECT_EQ(next.blender.passes.size() + 5, whole.blender.passes.size());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(next.outcome[i].samples, whole.outcome[i].samples);
    EXPECT_EQ(next.outcome[i].standard_error, whole.outcome[i].standard_error);
  }
}

TEST(Passes, EndInTime) {
  PassBake bake("");
  bake.blender.noise = 0.4;
  bake.deadline = steady_clock().now();
  (void)bake.run();
  ASSERT_TRUE(bake.delivered);
  EXPECT_EQ(bake.outcome[0].samples, 32);  // one round, which is what anybody gets
}

TEST(Passes, LeaveNothingButTheirSumInTheCache) {
  const TempFolder cache;
  PassBake bake(cache.path());
  (void)bake.run();
  std::set<std::string> kinds;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(cache.path())) {
    if (entry.is_regular_file()) kinds.insert(entry.path().parent_path().parent_path().filename().string());
  }
  EXPECT_TRUE(kinds.contains("target"));
  EXPECT_FALSE(kinds.contains("pass"));
  EXPECT_FALSE(kinds.contains("journal"));
}

TEST(Passes, OfOneObjectThatChangedAreBakedForItAlone) {
  const TempFolder cache;
  PassBake before(cache.path()), after(cache.path());
  (void)before.run();
  for (BakeTask& task : after.planned.tasks) {
    if (task.target == 1) task.cycles.samples *= 2;
  }
  (void)after.run();
  EXPECT_TRUE(after.delivered);
  for (const Baked& launch : after.blender.launches) {
    for (const auto& [target, basis] : launch) EXPECT_EQ(target, 1U);
  }
  EXPECT_FALSE(after.blender.launches.empty());
}

}  // namespace
}  // namespace rnmbake
