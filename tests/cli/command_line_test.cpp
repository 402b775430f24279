#include "cli/flags/command_line.h"

#include "config/value.h"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

SettingOverride given(const char* key, const std::string& text) {
  const Setting& setting = *find_setting(key);
  SettingOverride one{&setting, parse_value(setting, text, "flag"), SettingSource::flag,
                      "flag " + setting.flag()};
  return one;
}

TEST(CommandLine, HoldsWhatWasTyped) {
  std::vector<SettingOverride> flags{given("file", "my hall.blend"), given("samples", "64"),
                                     given("objects", "a,b*"), given("dir", "out")};
  flags.front().where = "argument SCENE";
  EXPECT_EQ(command_line("validate", resolve({}, {}, flags)),
            "rnmbake validate 'my hall.blend' --objects 'a,b*' --samples 64 --output out");
}

TEST(CommandLine, LeavesOutWhatOneFlagTurnsOffInAnother) {
  EXPECT_EQ(command_line("bake", resolve({}, {}, {given("file", "a.blend"), given("resolution", "64")})),
            "rnmbake bake a.blend --resolution 64");
}

TEST(CommandLine, NamesTheProjectInsteadOfItsValues) {
  const ProjectFile project = parse_project("[scene]\nfile = 'a.blend'\n[bake]\nsamples = 7\n", "hall.toml");
  EXPECT_EQ(command_line("bake", resolve(project, {}, {given("repair", "false")})),
            "rnmbake bake hall.toml --no-repair");
}

TEST(CommandLine, QuotesForAShell) {
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("a/b-c_1.0%"), "a/b-c_1.0%");
}

}  // namespace
}  // namespace rnmbake
