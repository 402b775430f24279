#include "pipeline/shaders/node_groups.h"

#include "base/error.h"
#include "blender/scripts.h"
#include "encoding/codecs/make_codec.h"

#include <algorithm>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

using Names = std::vector<std::string>;

// Of a new encoding: its group in blender_scripts/nodes/decoders.py.
TEST(NodeGroupNames, AreTheCodecs) {
  const auto script = std::ranges::find_if(embedded_scripts(), [](const auto& file) {
    return std::string_view(file.first) == "nodes/decoders.py";
  });
  ASSERT_NE(script, embedded_scripts().end());
  Names groups;
  const std::string text = script->second;
  const std::regex entry("\"([a-z0-9-]+)\": \\w+\\.make_");
  for (std::sregex_iterator found(text.begin(), text.end(), entry), end; found != end; ++found)
    groups.push_back((*found)[1]);
  EXPECT_EQ(groups, codec_names());
}

TEST(NodeGroupNames, AreTakenOnceInTheirOrder) {
  EXPECT_EQ(checked_node_groups({}), codec_names());
  EXPECT_EQ(checked_node_groups({"zh3", "flat", "zh3"}), (Names{"zh3", "flat"}));
}

TEST(NodeGroupNames, ThatDoNotExistAreRefused) {
  try {
    (void)checked_node_groups({"flat", "ssbump"});
    FAIL() << "was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("'ssbump'"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace rnmbake
