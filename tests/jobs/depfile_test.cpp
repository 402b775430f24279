#include "jobs/depfile.h"

#include "base/files.h"
#include "support/run_words.h"

#include <fstream>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

TEST(Depfile, IsOneRuleWithEachInputOnce) {
  EXPECT_EQ(depfile_text("out/manifest.json", {"hall.blend", "hall.toml", "hall.blend", ""}),
            "out/manifest.json: \\\n  hall.blend \\\n  hall.toml\n");
  EXPECT_EQ(depfile_text("m.json", {}), "m.json:\n");
}

TEST(Depfile, EscapesWhatMakeWouldTakeApart) {
  EXPECT_EQ(depfile_text("a b.json", {"c#d", "e$f", "g:h", "i\\j", "k\\ l"}),
            "a\\ b.json: \\\n  c\\#d \\\n  e$$f \\\n  g\\:h \\\n  i\\j \\\n  k\\\\\\ l\n");
}

TEST(Depfile, LeavesOutWhatNobodyCouldRead) {
  EXPECT_EQ(depfile_text("m.json", {"a\nb", "c"}), "m.json: \\\n  c\n");
}

/// A folder with inputs of difficult names, and what `make` says to it.
class DepfileByTools : public testing::Test {
 protected:
  DepfileByTools() {
    for (const fs::path& input : inputs_) write_atomically(input, "x");
  }
  [[nodiscard]] fs::path path(const std::string& name) const { return folder_.path() / name; }

  TempFolder folder_;
  std::vector<fs::path> inputs_{path("two words.blend"), path("a#1.png"),  path("b$2.png"),
                                path("c:3.png"),         path("e(5).png"), path("f%6.png")};
  fs::path target_ = path("out dir.json");
};

TEST_F(DepfileByTools, MakeFindsEveryInput) {
  inputs_.push_back(path("d'4.png"));  // Ninja 1.11 reads no quotes, however they are escaped
  write_atomically(inputs_.back(), "x");
  write_depfile(path("sub/deps.d"), target_, inputs_);
  write_atomically(path("Makefile"),
                   "include sub/deps.d\n%.json:\n\t@echo \"made from $(words $^)\" > '$@'\n");
  const std::string dir = folder_.path().string();
  const ProcessResult first = run_words({"make", "-C", dir, "-s"});
  ASSERT_TRUE(first.succeeded()) << first.output;
  EXPECT_TRUE(fs::exists(target_)) << first.output;
  EXPECT_TRUE(run_words({"make", "-C", dir, "-q"}).succeeded()) << "all are older";
  for (const fs::path& input : inputs_) {
    fs::last_write_time(input, fs::last_write_time(target_) + std::chrono::seconds(5));
    EXPECT_EQ(run_words({"make", "-C", dir, "-q"}).exit_code, 1) << input << " was not seen";
    fs::last_write_time(input, fs::last_write_time(target_) - std::chrono::seconds(5));
  }
  fs::remove(inputs_.front());
  EXPECT_EQ(run_words({"make", "-C", dir, "-q"}).exit_code, 2) << "no rule makes it";
}

TEST_F(DepfileByTools, NinjaFindsEveryInput) {
  write_depfile(path("kept.d"), "out.json", inputs_);
  write_atomically(
      path("build.ninja"),
      "rule bake\n  command = cp kept.d out.d && echo x > out.json\n  depfile = out.d\n  deps = gcc\n"
      "build out.json: bake\n");
  const std::string dir = folder_.path().string();
  const ProcessResult first = run_words({"ninja", "-C", dir});
  ASSERT_TRUE(first.succeeded()) << first.output;
  const std::string deps = run_words({"ninja", "-C", dir, "-t", "deps"}).output;
  for (const fs::path& input : inputs_)
    EXPECT_NE(deps.find("    " + input.string() + "\n"), std::string::npos) << input << " in\n" << deps;
  EXPECT_NE(run_words({"ninja", "-C", dir}).output.find("no work to do"), std::string::npos);
}

}  // namespace
}  // namespace rnmbake
