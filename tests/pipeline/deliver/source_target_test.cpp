#include "base/error.h"
#include "base/files.h"
#include "pipeline/deliver/engines/source.h"

#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(SourceTarget, TexturesAreNamedByTheirFolderBelowMaterials) {
  EXPECT_EQ(source_texture_folder("/mod/materials/models/level"), "models/level/");
  EXPECT_EQ(source_texture_folder("/materials/old/Materials/level/."), "level/");
  EXPECT_EQ(source_texture_folder("/mod/materials"), "");
  EXPECT_EQ(source_texture_folder("/home/out/level/"), "level/");
}

/// 2048 x 2048 half floats are 32 MiB, and the header is too much.
TEST(SourceTarget, PagesThatSourceDoesNotLoadAreRefused) {
  const TempFolder folder;
  DeliveryFiles files(folder.path(), folder.path());
  try {
    (void)Source().write_page(files, 1, {{}, FloatImage(2048, 2048, 1)});
    FAIL() << "a page of 32 MiB";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unsupported);
    EXPECT_NE(std::string(error.what()).find("page 1 is 2048 x 2048"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(files.names().empty());
  EXPECT_TRUE(Source().write_page(files, 0, {{}, FloatImage(2048, 1024, 1)}).empty());
}

}  // namespace
}  // namespace rnmbake
