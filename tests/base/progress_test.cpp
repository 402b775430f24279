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
  EXPECT_EQ(recorder.said[1].substr(0, 52), "baking [############............]  50 %, 10 s left x");
  EXPECT_LE(recorder.said[1].size(), 79u);
  EXPECT_EQ(recorder.said[2], "");
}

TEST(Progress, NeverGoesBackAndTakesNoNonsense) {
  Recorder recorder;
  Progress progress("x", recorder.options(ProgressOptions::Style::lines));
  progress.update(0.5, "");
  progress.update(0.25, "");
  progress.update(std::numeric_limits<double>::quiet_NaN(), "");
  recorder.clock.seconds += 10;
  EXPECT_DOUBLE_EQ(progress.eta_seconds(), 10);
  progress.update(7, "");
  EXPECT_EQ(recorder.said.at(0), "x: 100 %, 0 s left");
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
