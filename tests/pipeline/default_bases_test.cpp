#include "config/resolve.h"
#include "encoding/encodings.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Settings know no encodings (rooms on one floor do not meet); both lists are held together here.
TEST(DefaultBases, AreTheLayersOfFlatAndRnm) {
  std::vector<std::string> wanted(flat_layers.begin(), flat_layers.end());
  wanted.insert(wanted.end(), rnm_layers.begin(), rnm_layers.end());
  EXPECT_EQ(resolve({}, {}, {}).globals.bake.bases, wanted);
}

}  // namespace
}  // namespace rnmbake
