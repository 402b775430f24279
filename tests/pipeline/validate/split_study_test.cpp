#include "pipeline/validate/split_study.h"

#include "pipeline/traced_scene.h"

#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Two tiles in one object (loose parts), 4 units apart along x.
ExportResult two_tiles() {
  ExportResult exported;
  add_object(exported.diffuse_scene, "tiles", {level(1, 0), level(1, 0, true, Vec3(4, 0, 0))}, Vec3(0.5F));
  add_target(exported, 0, 16);
  return exported;
}

std::map<std::string, std::size_t> counts_of(const std::vector<Splitting>& all) {
  std::map<std::string, std::size_t> counts;
  for (const Splitting& one : all) counts[one.name] = one.list.targets.size();
  return counts;
}

TEST(SplitStudy, GrowsAndNamesEachNumberOnce) {
  const auto all = splittings(two_tiles());
  ASSERT_GE(all.size(), 2U);
  EXPECT_EQ(all.front().name, "whole");
  EXPECT_EQ(all.front().list.targets.size(), 1U);
  std::set<std::size_t> seen;
  for (const Splitting& one : all) EXPECT_TRUE(seen.insert(one.list.targets.size()).second) << one.name;
  EXPECT_EQ(counts_of(all).at("loose"), 2U);
}

TEST(SplitStudy, PiecesKeepTheTexels) {
  const ExportResult exported = two_tiles();
  for (const Splitting& one : splittings(exported)) {
    std::multiset<std::uint32_t> triangles;
    for (const Target& target : one.list.targets) {
      EXPECT_EQ(target.width, 16);
      EXPECT_EQ(target.uv, exported.list.targets.front().uv);
      triangles.insert(target.part.triangles.begin(), target.part.triangles.end());
    }
    EXPECT_EQ(triangles, (std::multiset<std::uint32_t>{0, 1, 2, 3})) << one.name;
    EXPECT_EQ(one.list.settings.size(), one.list.targets.size());
  }
}

TEST(SplitStudy, KeysAreUniqueAndPiecesAreNamed) {
  for (const Splitting& one : splittings(two_tiles())) {
    std::set<std::string> keys;
    for (const Target& target : one.list.targets) {
      EXPECT_TRUE(keys.insert(target.key).second) << target.key;
      EXPECT_EQ(target.part.name.empty(), target.key == "tiles");
    }
  }
}

TEST(SplitStudy, StartsFromWholeObjectsWhateverWasBaked) {
  ExportResult exported = two_tiles();
  Target half = exported.list.targets.front();
  half.key = "tiles/part0";
  half.part = {"part0", {0, 1}};
  exported.list.targets.front() = half;
  const Splitting whole = splittings(exported).front();
  ASSERT_EQ(whole.list.targets.size(), 1U);
  EXPECT_EQ(whole.list.targets.front().key, "tiles");
  EXPECT_EQ(whole.list.targets.front().part.triangles.size(), 4U);
}

}  // namespace
}  // namespace rnmbake
