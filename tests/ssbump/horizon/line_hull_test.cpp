#include "ssbump/horizon/line_hull.h"

#include "ssbump/horizon/horizon_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

// What follows is compiled for each set of instructions; the order matters.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ssbump/horizon/line_hull_test.cpp"
#include <hwy/foreach_target.h>

#include "ssbump/horizon/line_hull-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace rnmbake::HWY_NAMESPACE {
namespace {

using D = hn::CappedTag<float, most_lines_at_once>;

int lanes_here() {
  return static_cast<int>(hn::Lanes(D()));
}

/// What eyes on a line see of its heights from `ahead` of them on, block after block. As many heights in
/// front of the line and behind it as a block looks at.
template <int Sign>
void look(const float* line, int count, int ahead, float* slopes) {
  const Reciprocals reciprocals(4 * count);
  LineHull hull;
  hull.make_room();
  const int lanes = lanes_here();
  for (int i = 0; i < count; i += lanes) {
    const int step = Sign > 0 ? count - lanes - i : i;
    const LineBlock<Sign, D> block(D(), line, step, ahead, reciprocals);
    hn::StoreU(block.look_and_push(hull, hn::LoadU(D(), line + step)), D(), slopes + step);
  }
}
void look_ahead_here(const float* line, int count, int ahead, float* slopes) {
  look<1>(line, count, ahead, slopes);
}
void look_back_here(const float* line, int count, int ahead, float* slopes) {
  look<-1>(line, count, ahead, slopes);
}

void append_hull_here(const std::vector<float>& line, std::vector<LinePoint>& hull) {
  std::vector<LinePart> parts;
  append_hull(D(), line.data(), 0, static_cast<int>(line.size()) - 1, 1e-6F, hull, parts);
}

}  // namespace
}  // namespace rnmbake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rnmbake {
namespace {

HWY_EXPORT(look_ahead_here);
HWY_EXPORT(look_back_here);
HWY_EXPORT(append_hull_here);

/// Does the point stand over each line between two others about it?
bool on_hull(const std::vector<float>& line, int at, double least = 0) {
  const auto height = [&](int i) { return double{line[static_cast<std::size_t>(i)]}; };
  for (int a = 0; a < at; ++a) {
    for (int b = at + 1; b < static_cast<int>(line.size()); ++b) {
      const double chord = ((b - at) * height(a) + (at - a) * height(b)) / (b - a);
      if (height(at) <= chord + least) return false;
    }
  }
  return true;
}

/// Whole numbers: many lie on lines through others.
std::vector<float> whole_heights(std::mt19937& random, int count, int highest) {
  std::vector<float> line(static_cast<std::size_t>(count));
  std::uniform_int_distribution<int> height(0, highest);
  for (float& one : line) one = static_cast<float>(height(random));
  return line;
}

std::vector<int> hull_of(const std::vector<float>& line) {
  std::vector<int> places;
  for (int i = 0; i < static_cast<int>(line.size()); ++i)
    if (on_hull(line, i)) places.push_back(i);
  return places;
}

TEST(LineHull, PushKeepsTheUpperHullAndNothingElse) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    const std::vector<float> line = whole_heights(random, 1 + round % 50, round % 3 == 0 ? 4 : 100);
    const int count = static_cast<int>(line.size());
    std::vector<int> expected = hull_of(line);
    for (const bool rising : {true, false}) {
      LineHull hull;
      for (int i = 0; i < count; ++i) {
        const int at = rising ? count - 1 - i : i;
        hull.push({at, line[static_cast<std::size_t>(at)]});
      }
      if (rising) std::ranges::reverse(expected);
      ASSERT_EQ(std::vector<int>(hull.at(), hull.at() + hull.count()), expected);
      for (int i = 0; i < hull.count(); ++i)
        ASSERT_EQ(hull.heights()[i], line[static_cast<std::size_t>(hull.at()[i])]);
      if (rising) std::ranges::reverse(expected);
    }
  }
}

TEST(LineHull, HasRoomForAVectorMoreHoweverLongItGrows) {
  LineHull hull;
  hull.make_room();
  for (int i = 0; i < 1000; ++i) {
    for (int k = 0; k < LineHull::most_at_once; ++k) {
      hull.at_end()[k] = i * LineHull::most_at_once + k;
      hull.heights_end()[k] = 0.5F * static_cast<float>(i);
    }
    hull.append(LineHull::most_at_once);
  }
  ASSERT_EQ(hull.count(), 1000 * LineHull::most_at_once);
  for (int i = 0; i < hull.count(); ++i) ASSERT_EQ(hull.at()[i], i);
  hull.keep(3);
  hull.push({3, 1000});
  EXPECT_EQ(hull.count(), 2);
  hull.clear();
  EXPECT_EQ(hull.count(), 0);
}

TEST(LineHull, AppendedIsTheUpperHull) {
  std::mt19937 random(2);
  for (int round = 0; round < 100; ++round) {
    const std::vector<float> line = whole_heights(random, 1 + round, 50);
    std::vector<LinePoint> hull;
    HWY_DYNAMIC_DISPATCH(append_hull_here)(line, hull);
    std::vector<int> places;
    for (const LinePoint& point : hull) {
      places.push_back(point.at);
      ASSERT_EQ(point.height, line[static_cast<std::size_t>(point.at)]);
    }
    ASSERT_TRUE(std::ranges::is_sorted(places));
    for (const int place : hull_of(line)) {  // and points on the lines between them, by rounding
      if (on_hull(line, place, 1e-4)) {
        ASSERT_TRUE(std::ranges::binary_search(places, place));
      }
    }
    for (const int place : places)
      if (place > 0 && place + 1 < static_cast<int>(line.size())) {
        ASSERT_TRUE(on_hull(line, place, -1e-4));
      }
  }
}

TEST(LineHull, BlocksSeeTheSteepestOfAllThatLiesAhead) {
  constexpr int count = 192, pad = 64;
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  for (int round = 0; round < 60; ++round) {
    const int ahead = 1 + round % 33;
    std::vector<float> memory(count + 2 * pad, -1e6F);  // nothing stands in front of the line or behind it
    float* const line = memory.data() + pad;
    float height = 0;
    for (int i = 0; i < count; ++i)  // cliffs, slopes and noise
      line[i] = height =
          round % 3 == 0 ? 10 * normal(random) : height + (i % 40 == 7 ? 30 : 1) * normal(random);
    std::array<float, count> forth{}, back{};
    HWY_DYNAMIC_DISPATCH(look_ahead_here)(line, count, ahead, forth.data());
    HWY_DYNAMIC_DISPATCH(look_back_here)(line, count, ahead, back.data());
    for (int i = 0; i < count; ++i) {
      double steepest_ahead = -1e6, steepest_back = -1e6;
      for (int k = ahead; i + k < count; ++k)
        steepest_ahead = std::max(steepest_ahead, (double{line[i + k]} - line[i]) / k);
      for (int k = ahead; i - k >= 0; ++k)
        steepest_back = std::max(steepest_back, (double{line[i - k]} - line[i]) / k);
      const auto at = static_cast<std::size_t>(i);
      if (i + ahead < count) {
        ASSERT_NEAR(forth[at], steepest_ahead, 1e-4) << round << ' ' << i;
      }
      if (i - ahead >= 0) {
        ASSERT_NEAR(back[at], steepest_back, 1e-4) << round << ' ' << i;
      }
    }
  }
}

TEST(Reciprocals, AreThoseOfDistancesOnBothSides) {
  const Reciprocals reciprocals(300);
  EXPECT_EQ(reciprocals.farthest(), 300);
  EXPECT_EQ(reciprocals.centre()[0], 0);
  for (int i = 1; i <= 300; ++i) {
    ASSERT_EQ(reciprocals.centre()[i], 1 / static_cast<float>(i));
    ASSERT_EQ(reciprocals.centre()[-i], 1 / static_cast<float>(i));
  }
}

}  // namespace
}  // namespace rnmbake
#endif
