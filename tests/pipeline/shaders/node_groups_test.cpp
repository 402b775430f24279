#include "pipeline/shaders/node_groups.h"

#include "base/error.h"
#include "encoding/codecs/make_codec.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

using Names = std::vector<std::string>;

// Of a new encoding: its group in blender_scripts/nodes/decoders.py, its name in node_group_names().
TEST(NodeGroupNames, AreTheCodecs) {
  EXPECT_EQ(node_group_names(), codec_names());
}

TEST(NodeGroupNames, AreTakenOnceInTheirOrder) {
  EXPECT_EQ(checked_node_groups({}), node_group_names());
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
