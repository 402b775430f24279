#include "base/progress.h"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

struct HandClock : Clock {
  [[nodiscard]] double now() const override { return seconds; }
  double seconds = 1000;
};

struct Recorder {
  HandClock clock;
  std::vector<std::string> said;
  ProgressOptions options(ProgressOptions::Style style) {
    ProgressOptions o;
    o.style = style;
    o.clock = &clock;
    o.sink = [this](std::string_view text) { said.emplace_back(text); };
    return o;
  }
};

TEST(Progress, SaysALineEveryTenSeconds) {
  Recorder recorder;
  Progress progress("baking", recorder.options(ProgressOptions::Style::lines));
  for (int second = 1; second <= 35; ++second) {
    recorder.clock.seconds = 1000 + second;
    progress.update(second / 40.0, "floor");
  }
  ASSERT_EQ(recorder.said.size(), 3u);
  EXPECT_EQ(recorder.said[0], "baking: 25 %, 30 s left, at floor");
  EXPECT_EQ(recorder.said[2], "baking: 75 %, 10 s left, at floor");
}

TEST(Progress, DrawsOneBarThatFitsTheLineAndGoesAway) {
  Recorder recorder;
  {
    Progress progress("baking", recorder.options(ProgressOptions::Style::bar));
    progress.update(0, "a");
    progress.update(0.1, "a");  // too early to draw again
    recorder.clock.seconds += 10;
    progress.update(0.5, std::string(200, 'x'));
  }
  ASSERT_EQ(recorder.said.size(), 3u);
  EXPECT_EQ(recorder.said[0], "baking [........................]   0 % a");
  EXPECT_EQ(recorder.said[1].substr(0, 50), "baking [############............]  50 %, 13 s left");
  EXPECT_LE(recorder.said[1].size(), 79u);
  EXPECT_EQ(recorder.said[2], "");
}

TEST(Progress, NeverGoesBackAndTakesNoNonsense) {
  Recorder recorder;
  Progress progress("x", recorder.options(ProgressOptions::Style::lines));
  progress.update(0.25, "y");
  recorder.clock.seconds += 10;
  progress.update(0.5, "y");
  progress.update(0.25, "y");
  progress.update(std::numeric_limits<double>::quiet_NaN(), "y");
  EXPECT_DOUBLE_EQ(progress.eta_seconds(), 20);
  recorder.clock.seconds += 10;
  progress.update(7, "y");
  EXPECT_EQ(recorder.said.at(1), "x: 100 %, 0 s left, at y");
}

// A bake of 27 s whose scene takes 20 s to load: by rule of three from its beginning it would have been 33
// min.
TEST(Progress, WhatComesBeforeTheWorkIsNoPartOfTheRate) {
  Recorder recorder;
  Progress progress("baking", recorder.options(ProgressOptions::Style::lines));
  progress.update(0, "load");
  recorder.clock.seconds += 20;
  progress.update(0.01, "bake");
  EXPECT_LT(progress.eta_seconds(), 0) << "one point is no rate";
  recorder.clock.seconds += 3.5;
  progress.update(0.51, "bake");
  EXPECT_NEAR(progress.eta_seconds(), 3.43, 0.01);
}

TEST(Progress, TimeRunsDownWhileNothingAdvances) {
  Recorder recorder;
  Progress progress("x", recorder.options(ProgressOptions::Style::lines));
  progress.update(0.1, "");
  recorder.clock.seconds += 10;
  progress.update(0.6, "");
  EXPECT_DOUBLE_EQ(progress.eta_seconds(), 8);
  recorder.clock.seconds += 5;
  progress.update(0.6, "");
  EXPECT_DOUBLE_EQ(progress.eta_seconds(), 3);
  recorder.clock.seconds += 5;
  progress.update(0.6, "y");
  EXPECT_LT(progress.eta_seconds(), 0) << "overdue: nobody knows";
  EXPECT_EQ(recorder.said.back(), "x: 60 %, at y");
}

TEST(Progress, SaysNoShareWhereThereIsNone) {
  Recorder recorder;
  Progress progress("reading the scene", recorder.options(ProgressOptions::Style::lines));
  recorder.clock.seconds += 10;
  progress.update(std::numeric_limits<double>::quiet_NaN(), "evaluate Cube");
  EXPECT_EQ(recorder.said.at(0), "reading the scene: at evaluate Cube");
}

TEST(Progress, IsSilentWhenOff) {
  Recorder recorder;
  {
    Progress progress("x", recorder.options(ProgressOptions::Style::off));
    recorder.clock.seconds += 100;
    progress.update(0.5, "y");
  }
  EXPECT_TRUE(recorder.said.empty());
}

TEST(SpokenDuration, UsesTwoUnits) {
  EXPECT_EQ(spoken_duration(8.4), "8 s");
  EXPECT_EQ(spoken_duration(200), "3 min 20 s");
  EXPECT_EQ(spoken_duration(7500), "2 h 05 min");
}

}  // namespace
}  // namespace rnmbake
