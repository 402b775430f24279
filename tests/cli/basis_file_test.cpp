#include "cli/bases/basis_file.h"

#include "base/error.h"
#include "base/files.h"

#include <string_view>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

class BasisFileTest : public testing::Test {
 protected:
  BasisFile read(std::string_view text) {
    write_atomically(folder_.path() / "b.toml", text);
    return read_basis_file(folder_.path() / "b.toml");
  }

  /// The message of the refusal, without the folder.
  std::string refusal(std::string_view text) {
    try {
      (void)read(text);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::invalid_input);
      const std::string message = error.what();
      return message.substr(message.find("b.toml"));
    }
    return "accepted";
  }

  TempFolder folder_;
};

TEST_F(BasisFileTest, ReadsDirectionsInOrder) {
  const BasisFile file = read(R"(
[[basis]]
name = "up_left"
direction = [-0.6, 0, 0.8]
[[basis]]
name = "flat"
direction = [0, 0, 1]
)");
  ASSERT_EQ(file.set.directions.size(), 2U);
  EXPECT_EQ(file.set.directions[0].name, "up_left");
  EXPECT_EQ(file.set.directions[0].direction, Vec3(-0.6F, 0, 0.8F));
  EXPECT_EQ(file.set.directions[1].name, "flat");
  EXPECT_TRUE(file.warnings.empty());
}

TEST_F(BasisFileTest, RefusesWithTheLine) {
  EXPECT_TRUE(refusal("[[basis]\n").starts_with("b.toml:1: not TOML"));
  EXPECT_TRUE(refusal("[[basis]]\nname = 'a'\ndirection = [0, 0, 1]\ncolour = 1\n")
                  .starts_with("b.toml:4: unknown key 'colour'"));
  EXPECT_TRUE(refusal("[[basis]]\ndirection = [0, 0, 1]\n").find("needs name") != std::string::npos);
  EXPECT_TRUE(refusal("[[basis]]\nname = 'a'\n").find("needs direction") != std::string::npos);
  EXPECT_TRUE(refusal("[[basis]]\nname = 'a'\ndirection = [0, 1]\n").find("needs direction") !=
              std::string::npos);
  EXPECT_TRUE(refusal("[[basis]]\nname = 'a'\ndirection = [0, 'x', 1]\n").find("not a number") !=
              std::string::npos);
  EXPECT_TRUE(refusal("[basis]\nname = 'a'\n").find("[[basis]], not [basis]") != std::string::npos);
  EXPECT_TRUE(refusal("").find("is empty") != std::string::npos);
}

TEST_F(BasisFileTest, RejectsTheMisprintByName) {
  const std::string said = refusal("[[basis]]\nname = 'rnm0'\ndirection = [0.904534, 0, 0.426401]\n");
  EXPECT_NE(said.find("misprinted Half-Life 2 basis"), std::string::npos) << said;
}

TEST_F(BasisFileTest, MissingFileIsIo) {
  try {
    (void)read_basis_file(folder_.path() / "none.toml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::io);
  }
}

}  // namespace
}  // namespace rnmbake
