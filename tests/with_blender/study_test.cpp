// rnmbake study encodings over a scene: traced and studied in one command, as by two.
#include "base/error.h"
#include "base/files.h"
#include "closed_forms/workbench.h"
#include "process/run.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

ProcessResult rnmbake_with(Words words) {
  ProcessOptions options;
  options.argv = {RNMBAKE_BINARY, "-q"};
  options.argv.insert(options.argv.end(), words.begin(), words.end());
  return run_process(options);
}

TEST(StudyOfAScene, IsThatOfItsTruth) {
  const TempFolder folder;
  Workbench bench(RNMBAKE_BINARY, {});
  const std::string scene = bench.exported(bench.build({"cornell", {}})).string();
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  const ProcessResult once =
      rnmbake_with({"study", "encodings", scene, "--resolution", "4", "--error", "20", "-o", path("once")});
  ASSERT_EQ(once.exit_code, 0) << once.output;
  ASSERT_EQ(rnmbake_with({"reference", scene, "--basis-set", "study", "--resolution", "4", "--error", "20",
                          "--depth", "float", "-o", path("truth")})
                .exit_code,
            0);
  ASSERT_EQ(rnmbake_with({"study", "encodings", path("truth"), "-o", path("twice")}).exit_code, 0);
  const auto figures = [&](const char* name) {
    return nlohmann::json::parse(read_text(folder.path() / name / "encodings.json"));
  };
  const auto found = figures("once"), expected = figures("twice");
  EXPECT_GT(found.at("lights"), 20);
  EXPECT_EQ(found.at("lights"), expected.at("lights"));
  ASSERT_EQ(found.at("encodings").size(), expected.at("encodings").size());
  for (std::size_t i = 0; i < found.at("encodings").size(); ++i) {
    const auto& one = found.at("encodings")[i];
    ASSERT_TRUE(one.contains("rms")) << one;         // the set feeds every encoding
    for (std::size_t limit = 0; limit < 4; ++limit)  // sums of threads, in any order
      EXPECT_NEAR(one.at("rms")[limit], expected.at("encodings")[i].at("rms")[limit], 1e-12) << one;
  }
}

TEST(StudyOfAScene, WantsAFolderForTheTruth) {
  const ProcessResult refused = rnmbake_with({"study", "encodings", "hall.blend"});
  EXPECT_EQ(refused.exit_code, static_cast<int>(ExitCode::usage));
  EXPECT_NE(refused.output.find("pass -o DIR"), std::string::npos) << refused.output;
}

}  // namespace
}  // namespace rnmbake
