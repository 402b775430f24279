#include "config/settings.h"

#include "base/error.h"
#include "config/value.h"

#include <algorithm>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

const Setting& setting(const char* key) {
  const Setting* found = find_setting(key);
  if (found == nullptr) throw std::logic_error(key);
  return *found;
}

std::string refusal(const char* key, const char* text) {
  try {
    (void)parse_value(setting(key), text, "here");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return "accepted";
}

TEST(Settings, KeysFlagsAndVariablesAreUnique) {
  std::set<std::string> keys, flags, variables;
  for (const Setting& one : settings()) {
    EXPECT_TRUE(keys.insert(std::string(one.key)).second) << one.key;
    EXPECT_TRUE(flags.insert(one.flag()).second) << one.flag();
    EXPECT_TRUE(variables.insert(one.environment()).second) << one.environment();
  }
}

TEST(Settings, EveryLineIsComplete) {
  for (const Setting& one : settings()) {
    EXPECT_FALSE(one.help.empty()) << one.key;
    EXPECT_NE(one.help.back(), '.') << one.key;
    const bool has_table = std::any_of(setting_tables().begin(), setting_tables().end(),
                                       [&](const SettingTable& table) { return table.name == one.table; });
    EXPECT_TRUE(has_table) << one.key;
  }
}

TEST(Settings, EveryDefaultIsAcceptedAndReachesItsField) {
  for (const Setting& one : settings()) {
    const SettingValue value = checked(one, one.default_value(), "default");
    BakeSettings settings;
    one.slot.set(settings, value);
    EXPECT_EQ(one.slot.get(settings), one.default_value()) << one.key;
  }
}

// Setting one value may move no other: a line of the table that points to the wrong field shows here.
TEST(Settings, EachSettingHasAFieldOfItsOwn) {
  for (const Setting& one : settings()) {
    SettingValue other = one.default_value();
    if (auto* truth = std::get_if<bool>(&other)) *truth = !*truth;
    if (auto* whole = std::get_if<std::int64_t>(&other)) *whole = one.high;
    if (auto* real = std::get_if<double>(&other)) *real = 17.5;
    if (auto* text = std::get_if<std::string>(&other))
      *text = one.choices.empty() ? "other" : one.choices.back();
    if (auto* list = std::get_if<std::vector<std::string>>(&other)) *list = {"p", "q"};
    ASSERT_NE(other, one.default_value()) << one.key;
    BakeSettings settings;
    one.slot.set(settings, other);
    for (const Setting& checked : rnmbake::settings()) {
      const bool same_one = checked.key == one.key;
      EXPECT_EQ(checked.slot.get(settings), same_one ? other : checked.default_value()) << one.key;
    }
  }
}

TEST(Settings, EveryChoiceReadsBackAsItself) {
  for (const Setting& one : settings()) {
    for (const std::string_view choice : one.choices) {
      BakeSettings settings;
      one.slot.set(settings, parse_value(one, choice, "here"));
      EXPECT_EQ(one.slot.get(settings), SettingValue(std::string(choice))) << one.key;
    }
  }
}

TEST(Settings, ChoicesLandOnTheirEnumerators) {
  BakeSettings s;
  const auto set = [&](const char* key, const char* text) {
    setting(key).slot.set(s, parse_value(setting(key), text, "here"));
  };
  set("unwrap", "never");
  set("recipe", "flat-normal-map");
  set("device", "optix");  // any case
  set("depth", "float");
  set("dispatch", "Object");
  set("save_scene", "always");
  EXPECT_EQ(s.object.unwrap, ObjectSettings::Unwrap::never);
  EXPECT_EQ(s.bake.recipe, BakingSettings::Recipe::flat_normal_map);
  EXPECT_EQ(s.bake.device, BakingSettings::Device::optix);
  EXPECT_EQ(s.output.depth, Depth::full);
  EXPECT_EQ(s.bake.dispatch, BakingSettings::Dispatch::object);
  EXPECT_EQ(s.output.save_scene, OutputSettings::SaveScene::always);
}

TEST(Settings, TextBecomesValues) {
  using List = std::vector<std::string>;
  EXPECT_EQ(parse_value(setting("samples"), " 12 ", "x"), SettingValue(std::int64_t{12}));
  EXPECT_EQ(parse_value(setting("clamp"), "1e2", "x"), SettingValue(100.0));
  EXPECT_EQ(parse_value(setting("repair"), "On", "x"), SettingValue(true));
  EXPECT_EQ(parse_value(setting("repair"), "0", "x"), SettingValue(false));
  EXPECT_EQ(parse_value(setting("uv"), "UV Map ", "x"), SettingValue(std::string("UV Map ")));
  EXPECT_EQ(parse_value(setting("objects"), "a*, b c,,d", "x"), SettingValue(List{"a*", "b c", "d"}));
  EXPECT_EQ(parse_value(setting("objects"), "", "x"), SettingValue(List{}));
}

TEST(Settings, WhatDoesNotFitIsRefusedWithTheRemedy) {
  EXPECT_EQ(refusal("samples", "many"),
            "here: 'many' does not fit 'samples'; give a whole number from 1 to 16777216");
  EXPECT_EQ(refusal("samples", "0"),
            "here: 0 does not fit 'samples'; give a whole number from 1 to 16777216");
  EXPECT_EQ(refusal("resolution", "16385"),
            "here: 16385 does not fit 'resolution'; give a whole number from 4 to 16384");
  EXPECT_EQ(refusal("samples", "99999999999999999999"),
            "here: '99999999999999999999' does not fit 'samples'; give a whole number from 1 to 16777216");
  EXPECT_EQ(refusal("samples", "12.0"),
            "here: '12.0' does not fit 'samples'; give a whole number from 1 to 16777216");
  EXPECT_EQ(refusal("clamp", "nan"), "here: nan does not fit 'clamp'; give a number from 0 to 1000000000");
  EXPECT_EQ(refusal("clamp", "-1"), "here: -1.0 does not fit 'clamp'; give a number from 0 to 1000000000");
  EXPECT_EQ(refusal("repair", "maybe"), "here: 'maybe' does not fit 'repair'; give true or false");
  EXPECT_EQ(refusal("depth", "halv"),
            "here: 'halv' does not fit 'depth'; give half or float, did you mean 'half'?");
}

TEST(Settings, ValuesAreWrittenAsToml) {
  EXPECT_EQ(to_toml(true), "true");
  EXPECT_EQ(to_toml(std::int64_t{7}), "7");
  EXPECT_EQ(to_toml(3.0), "3.0");
  EXPECT_EQ(to_toml(0.1), "0.1");
  EXPECT_EQ(to_toml(std::string("a\"b\\c\n")), R"("a\"b\\c\u000A")");
  EXPECT_EQ(to_toml(std::vector<std::string>{"a", "b"}), R"(["a", "b"])");
}

TEST(Settings, EachCommandHasTheFlagsItCanUse) {
  EXPECT_TRUE(setting("samples").serves(Purpose::bake));
  EXPECT_TRUE(setting("samples").serves(Purpose::reference));
  EXPECT_TRUE(setting("recipe").serves(Purpose::bake));
  EXPECT_FALSE(setting("recipe").serves(Purpose::reference));
  EXPECT_FALSE(setting("recipe").serves(Purpose::validate));
  EXPECT_FALSE(setting("error").serves(Purpose::bake));
  EXPECT_TRUE(setting("error").serves(Purpose::validate));
  EXPECT_FALSE(setting("model").serves(Purpose::validate));
}

TEST(Settings, APercentSignMayFollowAPercentage) {
  EXPECT_EQ(parse_value(setting("error"), "0.5%", "here"), SettingValue(0.5));
  EXPECT_EQ(parse_value(setting("error"), "2", "here"), SettingValue(2.0));
  EXPECT_NE(refusal("error", "%"), "accepted");
  EXPECT_NE(refusal("error", "101%"), "accepted");
  EXPECT_NE(refusal("clamp", "5%"), "accepted");
}

}  // namespace
}  // namespace rnmbake
