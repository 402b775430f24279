#include "pipeline/dispatch/dispatcher.h"

#include "base/error.h"
#include "pipeline/fixture.h"

#include <map>

namespace rnmbake {
namespace {

using Kind = LaunchFailure::Kind;
using Mode = BakingSettings::Dispatch;

/// A bake of invented objects by a fake Blender.
struct Bake {
  explicit Bake(std::size_t objects, const BakeSettings& settings = {})
      : scene(objects, settings),
        context(scene.context()),
        session(scene.config(), blender),
        collector(context, scene.settings().output, scene.headers()) {}

  BakeTimings run() {
    const auto requests = receiver_requests(scene.settings(), context.survey, context.plan);
    return run_batches(session, context.plan, BlendPath("scene.blend"), requests, collector);
  }

  Invented scene;
  BakeContext context;
  FakeBlender blender;
  BlenderSession session;
  BakeCollector collector;
};

/// Fails every launch that holds this one.
auto offender(std::size_t target, std::size_t basis, const LaunchFailure& how) {
  return [=](const Baked& baked) {
    return baked.contains({target, basis}) ? std::optional(how) : std::nullopt;
  };
}

LaunchFailure hung(const std::string& phase) {
  LaunchFailure how = failure(Kind::hung, "600 s without progress");
  how.phase = phase;
  return how;
}

std::size_t launches_of(const FakeBlender& blender, const Baked& what) {
  return static_cast<std::size_t>(std::count(blender.launches.begin(), blender.launches.end(), what));
}

BakeSettings with_dispatch(Mode mode) {
  BakeSettings settings;
  settings.bake.dispatch = mode;
  return settings;
}

TEST(Dispatcher, DeliversEverythingInOneLaunch) {
  Bake bake(5);
  const BakeTimings timings = bake.run();
  EXPECT_EQ(bake.blender.launches.size(), 1U);
  for (std::size_t t = 0; t < 5; ++t) EXPECT_TRUE(is_delivered(bake.collector, t));
  EXPECT_EQ(bake.scene.files().size(), 5U);
  EXPECT_EQ(timings.launches, 1);
  EXPECT_EQ(timings.failed_launches, 0);
  EXPECT_EQ(timings.bake_seconds, 0.5);
  EXPECT_EQ(timings.prepare_seconds, 0.25);
  EXPECT_EQ(timings.launch_seconds, 1);
  EXPECT_EQ(timings.peak_bytes, 20000U);
}

TEST(Dispatcher, LaunchesAsOftenAsTheModeSays) {
  for (const auto& [mode, launches] : std::map<Mode, std::size_t>{{Mode::basis, 12}, {Mode::object, 3}}) {
    Bake bake(3, with_dispatch(mode));
    (void)bake.run();
    EXPECT_EQ(bake.blender.launches.size(), launches);
    for (std::size_t t = 0; t < 3; ++t) EXPECT_TRUE(is_delivered(bake.collector, t));
  }
}

TEST(Dispatcher, FindsTheOffenderAndDeliversTheRest) {
  for (std::size_t guilty = 0; guilty < 9; ++guilty) {
    for (std::size_t basis = 0; basis < 4; ++basis) {
      Bake bake(9);
      bake.blender.fault = offender(guilty, basis, failure(Kind::crashed, "Blender crashed (SIGSEGV)"));
      (void)bake.run();
      for (std::size_t t = 0; t < 9; ++t) EXPECT_EQ(is_delivered(bake.collector, t), t != guilty);
      const std::string reason = reason_of(bake.collector, guilty);
      EXPECT_NE(reason.find("basis " + bake.context.bases[basis].name), std::string::npos) << reason;
      EXPECT_NE(reason.find("Blender crashed (SIGSEGV)"), std::string::npos) << reason;
      EXPECT_EQ(bake.scene.files().size(), 8U);
    }
  }
}

TEST(Dispatcher, FindsSeveralOffenders) {
  Bake bake(16);
  bake.blender.fault = [](const Baked& baked) {
    const bool guilty =
        baked.contains({3, 1}) || baked.contains({4, 0}) || baked.contains({4, 2}) || baked.contains({15, 3});
    return guilty ? std::optional(failure(Kind::crashed, "signal 6")) : std::nullopt;
  };
  (void)bake.run();
  for (std::size_t t = 0; t < 16; ++t)
    EXPECT_EQ(is_delivered(bake.collector, t), t != 3 && t != 4 && t != 15);
}

TEST(Dispatcher, SplitsWithoutRetryingJoinedLaunches) {
  Bake bake(8);
  bake.blender.fault = offender(5, 2, failure(Kind::crashed, "signal 11"));
  const BakeTimings timings = bake.run();
  std::map<Baked, int> seen;
  for (const Baked& launch : bake.blender.launches) ++seen[launch];
  const Baked alone{{5, 2}};
  for (const auto& [launch, times] : seen) EXPECT_EQ(times, launch == alone ? 2 : 1);
  // 8 objects and 4 bases: 3 + 2 splits to the offender, then twice alone
  EXPECT_EQ(timings.failed_launches, 3 + 2 + 2);
  EXPECT_EQ(timings.launches, static_cast<int>(bake.blender.launches.size()));
}

TEST(Dispatcher, TriesALoneOffenderAsOftenAsAskedFor) {
  for (const int retries : {0, 1, 3}) {
    BakeSettings settings;
    settings.run.retries = retries;
    Bake bake(2, settings);
    bake.blender.fault = offender(1, 1, hung("bake"));
    (void)bake.run();
    EXPECT_EQ(launches_of(bake.blender, {{1, 1}}), static_cast<std::size_t>(retries + 1));
  }
}

TEST(Dispatcher, DeliversWhatARetryBrought) {
  Bake bake(1, with_dispatch(Mode::basis));
  int left = 1;
  bake.blender.fault = [&](const Baked& baked) {
    return baked.contains({0, 3}) && left-- > 0 ? std::optional(failure(Kind::killed, "SIGKILL"))
                                                : std::nullopt;
  };
  const BakeTimings timings = bake.run();
  EXPECT_TRUE(is_delivered(bake.collector, 0));
  EXPECT_EQ(timings.failed_launches, 1);
}

TEST(Dispatcher, DoesNotAskAgainWhereTheScriptRefused) {
  Bake bake(2);
  bake.blender.fault =
      offender(0, 0, failure(Kind::refused, "object 'object0': no faces", int(ExitCode::invalid_input)));
  (void)bake.run();
  EXPECT_EQ(launches_of(bake.blender, {{0, 0}}), 1U);
  EXPECT_EQ(reason_of(bake.collector, 0), "basis flat: object 'object0': no faces");
  EXPECT_TRUE(is_delivered(bake.collector, 1));
}

TEST(Dispatcher, DropsTheOtherBasesOfWhatWasGivenUp) {
  BakeSettings settings = with_dispatch(Mode::basis);
  settings.run.jobs = 1;
  settings.run.retries = 0;
  Bake bake(2, settings);
  bake.blender.fault = offender(0, 0, failure(Kind::crashed, "signal 11"));
  (void)bake.run();
  EXPECT_EQ(bake.blender.launches.size(), 1U + 4U);
}

TEST(Dispatcher, SaysWhatHelps) {
  const std::map<Kind, std::string> remedies{
      {Kind::hung, "raise --timeout"}, {Kind::outlasted, "raise --launch-timeout"},
      {Kind::killed, "fewer --jobs"},  {Kind::crashed, "--exclude"},
      {Kind::script, "defect"},        {Kind::no_result, "--keep-temporary"}};
  for (const auto& [kind, remedy] : remedies) {
    Bake bake(1);
    const LaunchFailure how =
        failure(kind, kind == Kind::killed ? "Blender was killed; try fewer --jobs" : "what");
    bake.blender.fault = [&how](const Baked&) { return how; };
    (void)bake.run();
    const std::string reason = reason_of(bake.collector, 0);
    EXPECT_NE(reason.find(how.message), std::string::npos) << reason;
    EXPECT_NE(reason.find(remedy), std::string::npos) << reason;
    EXPECT_EQ(reason.find('\n'), std::string::npos);
  }
}

TEST(Dispatcher, EndsWhereNothingWorks) {
  Bake bake(7);
  bake.blender.fault = [](const Baked&) { return failure(Kind::crashed, "signal 11"); };
  (void)bake.run();
  for (std::size_t t = 0; t < 7; ++t) EXPECT_FALSE(reason_of(bake.collector, t).empty());
  EXPECT_LE(bake.blender.launches.size(), 7U * 4 * 3);
  EXPECT_TRUE(bake.scene.files().empty());
}

TEST(Dispatcher, AHangBeforeTheBakeIsNotSplit) {
  for (const char* phase : {"", "load"}) {
    Bake bake(5);
    int left = 1;
    bake.blender.fault = [&](const Baked&) { return left-- > 0 ? std::optional(hung(phase)) : std::nullopt; };
    const BakeTimings timings = bake.run();
    EXPECT_EQ(timings.launches, 2);
    for (std::size_t t = 0; t < 5; ++t) EXPECT_TRUE(is_delivered(bake.collector, t));
  }
  Bake never(5);
  never.blender.fault = [](const Baked&) { return hung("load"); };
  EXPECT_EQ(never.run().launches, 2);
  for (std::size_t t = 0; t < 5; ++t) EXPECT_FALSE(reason_of(never.collector, t).empty());
}

TEST(Dispatcher, WhereEveryLaunchHangsItIsTheScene) {
  for (const Mode mode : {Mode::scene, Mode::object, Mode::basis}) {
    BakeSettings settings = with_dispatch(mode);
    settings.run.jobs = 1;
    Bake bake(9, settings);
    bake.blender.fault = [](const Baked&) { return hung("bake"); };
    EXPECT_EQ(bake.run().launches, 5);
    for (std::size_t t = 0; t < 9; ++t) {
      EXPECT_NE(reason_of(bake.collector, t).find("5 launches hung"), std::string::npos)
          << reason_of(bake.collector, t);
      EXPECT_NE(reason_of(bake.collector, t).find("--timeout"), std::string::npos)
          << reason_of(bake.collector, t);
    }
  }
}

TEST(Dispatcher, FindsWhatHangsAmongWhatDoesNot) {
  Bake bake(16);
  bake.blender.fault = [](const Baked& baked) {
    return baked.contains({3, 1}) || baked.contains({12, 0}) ? std::optional(hung("bake")) : std::nullopt;
  };
  (void)bake.run();
  for (std::size_t t = 0; t < 16; ++t) EXPECT_EQ(is_delivered(bake.collector, t), t != 3 && t != 12);
}

TEST(Dispatcher, AFullDiskEndsTheRunAtOnce) {
  Bake bake(4);
  bake.blender.fault = [](const Baked&) {
    return failure(Kind::refused, "the disk of /tmp/x is full", int(ExitCode::io));
  };
  try {
    (void)bake.run();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::io);
    EXPECT_STREQ(error.what(), "the disk of /tmp/x is full");
  }
  EXPECT_EQ(bake.blender.launches.size(), 1U);
}

TEST(Dispatcher, WhatTookTooLongIsSplitButNotTriedAgain) {
  BakeSettings settings;
  settings.run.retries = 3;
  Bake bake(2, settings);
  bake.blender.fault = offender(1, 1, failure(Kind::outlasted, "longer than 60 s"));
  (void)bake.run();
  EXPECT_EQ(launches_of(bake.blender, {{1, 1}}), 1U);
  EXPECT_TRUE(is_delivered(bake.collector, 0));
}

TEST(Dispatcher, TakesShortPicturesForAFailedLaunch) {
  Bake bake(2);
  bake.blender.short_pictures = true;
  const BakeTimings timings = bake.run();
  EXPECT_NE(reason_of(bake.collector, 0).find("is the disk full?"), std::string::npos)
      << reason_of(bake.collector, 0);
  EXPECT_FALSE(is_delivered(bake.collector, 1));
  EXPECT_EQ(timings.failed_launches, timings.launches);
}

TEST(Dispatcher, GivesUpAtOnceWhereTheMachineCannotBake) {
  Bake bake(4, with_dispatch(Mode::object));
  bake.blender.fault = [](const Baked&) {
    return failure(Kind::refused, "no CUDA device", int(ExitCode::environment));
  };
  try {
    (void)bake.run();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::environment);
    EXPECT_STREQ(error.what(), "no CUDA device");
  }
  EXPECT_LE(bake.blender.launches.size(), static_cast<std::size_t>(choose_jobs(bake.scene.settings(), 4)));
}

TEST(Dispatcher, StopsWhenTheUserDoes) {
  Bake bake(6, with_dispatch(Mode::object));
  bake.blender.fault = [](const Baked&) { return failure(Kind::stopped, "stopped"); };
  EXPECT_THROW((void)bake.run(), Interrupted);
  EXPECT_LT(bake.blender.launches.size(), 6U);
  EXPECT_TRUE(bake.scene.files().empty());
}

TEST(Dispatcher, StopsWhereTheOutputCannotBeWritten) {
  Bake bake(6, with_dispatch(Mode::object));
  std::filesystem::remove(bake.scene.folder());
  try {
    (void)bake.run();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::io);
  }
  std::filesystem::create_directory(bake.scene.folder());
}

TEST(Dispatcher, SharesWorkAmongJobs) {
  BakeSettings settings = with_dispatch(Mode::basis);
  settings.run.jobs = 8;
  Bake bake(20, settings);
  bake.blender.fault = offender(11, 2, failure(Kind::crashed, "signal 11"));
  (void)bake.run();
  for (std::size_t t = 0; t < 20; ++t) EXPECT_EQ(is_delivered(bake.collector, t), t != 11);
}

TEST(ChooseJobs, IsBoundedByTheLaunches) {
  BakeSettings settings;
  EXPECT_EQ(choose_jobs(settings, 1), 1);
  EXPECT_EQ(choose_jobs(settings, 0), 1);
  settings.run.jobs = 8;
  EXPECT_EQ(choose_jobs(settings, 3), 3);
  EXPECT_EQ(choose_jobs(settings, 100), 8);
}

}  // namespace
}  // namespace rnmbake
