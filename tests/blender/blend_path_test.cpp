#include "blender/blend_path.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(BlendPath, IsNoFileThatHasToBeImported) {
  for (const char* file : {"hall.glb", "hall.gltf", "hall.obj", "hall", ".blend", "hall.blend1", "blend"})
    EXPECT_THROW(BlendPath{file}, std::invalid_argument) << file;
}

TEST(BlendPath, IsAbsoluteWhateverTheCase) {
  const BlendPath path("hall.BLEND");
  EXPECT_TRUE(path.path().is_absolute());
  EXPECT_EQ(path.path().filename(), "hall.BLEND");
}

}  // namespace
}  // namespace rnmbake
