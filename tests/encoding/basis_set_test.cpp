#include "encoding/basis_set.h"

#include "base/error.h"
#include "encoding/direction_sets.h"

#include <cmath>
#include <limits>
#include <map>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

const Vec3 kSide(1, 0, 0);

std::string refusal(const BasisSet& set) {
  try {
    (void)check_basis(set);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    return error.what();
  }
  return "accepted";
}

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(BasisSet, RnmIsSound) {
  EXPECT_TRUE(check_basis(rnm_set()).empty());
  EXPECT_TRUE(holds_rnm(rnm_set()));
  const BasisSet with_flat = flat_and_rnm();
  EXPECT_TRUE(check_basis(with_flat).empty());
  EXPECT_TRUE(holds_rnm(with_flat));
}

TEST(BasisSet, StudySetHoldsWhatFeedsAndNormalsOfFourTilts) {
  const BasisSet study = direction_set("study").value(), feeding = direction_set("sh3").value();
  EXPECT_TRUE(check_basis(study).empty());  // sound, and no two of them near each other
  for (const BasisDirection& basis : feeding.directions) EXPECT_TRUE(place_of(study, basis)) << basis.name;
  std::map<int, int> tilts;  // half degrees -> normals
  for (const BasisDirection& basis : study.directions)
    if (!place_of(feeding, basis)) ++tilts[int(std::lround(2 * std::acos(basis.direction.z) * 180 / pi))];
  EXPECT_EQ(tilts, (std::map<int, int>{{25, 5}, {70, 8}, {104, 11}, {150, 12}}));
  EXPECT_EQ(name_of_set(study.directions), "study");
}

TEST(BasisSet, HoldsRnmNeedsAllThreeInTheirPlaces) {
  BasisSet set = rnm_set();
  std::swap(set.directions[1].direction, set.directions[2].direction);  // y-down under y-up names
  EXPECT_FALSE(holds_rnm(set));
  set = rnm_set();
  set.directions.pop_back();
  EXPECT_FALSE(holds_rnm(set));
}

TEST(BasisSet, MisprintedVectorIsRejectedByName) {
  BasisSet set = rnm_set();
  set.name = "wrong.toml";
  set.directions[0].direction = Vec3(0.904534F, 0, 0.426401F);
  EXPECT_EQ(refusal(set),
            "wrong.toml: 'rnm0' is the misprinted Half-Life 2 basis: dot with rnm1 is -0.123; correct is "
            "(0.816497, 0, 0.577350)");
}

TEST(BasisSet, LengthIsNamed) {
  expect_part(refusal({"f", {{"a", Vec3(0, 0, 1.01F)}}}), "'a' has length 1.010000");
  expect_part(refusal({"f", {{"a", Vec3(0, 0, 0)}}}), "length 0.000000");
  EXPECT_EQ(refusal({"f", {{"a", Vec3(0, 0, 1.0009F)}}}), "accepted");
}

TEST(BasisSet, NotFinite) {
  expect_part(refusal({"f", {{"a", Vec3(0, std::numeric_limits<float>::quiet_NaN(), 1)}}}), "not finite");
  expect_part(refusal({"f", {{"a", Vec3(std::numeric_limits<float>::infinity(), 0, 1)}}}), "not finite");
}

TEST(BasisSet, NamesMustBeUsable) {
  for (const char* name : {"", "a/b", "..", "a.R", "ä", "a b"})
    expect_part(refusal({"f", {{name, kSide}}}), "cannot be used");
  expect_part(refusal({"f", {{std::string(65, 'x'), kSide}}}), "cannot be used");
  expect_part(refusal({"f", {{"Coverage", kSide}}}), "taken by a layer");
  expect_part(refusal({"f", {{"flat", kSide}}}), "kept for 'flat'");
  expect_part(refusal({"f", {{"up", kSide}, {"UP", Vec3(0, 1, 0)}}}), "are the same");
}

TEST(BasisSet, EmptyListIsRefused) {
  expect_part(refusal({"f", {}}), "is empty");
}

TEST(BasisSet, NearDuplicatesWarn) {
  const Vec3 close = Vec3(1, 0.008F, 0).normalized(), apart = Vec3(1, 0.02F, 0).normalized();
  EXPECT_EQ(check_basis({"f", {{"a", kSide}, {"b", close}}}).size(), 1U);
  EXPECT_TRUE(check_basis({"f", {{"a", kSide}, {"b", apart}}}).empty());
}

}  // namespace
}  // namespace rnmbake
