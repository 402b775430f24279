#include "pipeline/deliver/engines/godot_names.h"
#include "pipeline/deliver/engines/unreal_names.h"

#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// unreal_case.py has the same of the script that looks for these names.
TEST(EngineNames, WhatUnrealCannotHoldBecomesUnderscores) {
  EXPECT_EQ(unreal_name("Wall-1+\xc3\xa9"), "Wall-1+\xc3\xa9");
  EXPECT_EQ(unreal_name("\"' ,/.:|&!~\n\r\t@#(){}[]=;^%$`\\*?<>"), std::string(33, '_'));
}

TEST(EngineNames, WhatGodotCannotHoldBecomesUnderscores) {
  EXPECT_EQ(godot_name("group: right (1)"), "group_ right (1)");
  EXPECT_EQ(godot_name(".:@/\"%"), std::string(6, '_'));
}

}  // namespace
}  // namespace rnmbake
