// Two processes, one folder: a lock held here, and the program that finds it.
#include "jobs/folder_lock.h"

#include "base/files.h"
#include "process/run.h"

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

namespace rnmbake {
namespace {

ProcessResult shaders_into(const std::string& folder) {
  ProcessOptions options;
  options.argv = {RNMBAKE_BINARY, "shaders", "sh2", "--engine", "unity", "-o", folder};
  return run_process(options);
}

TEST(FolderLockCommand, EndsWithEightAndSaysWhoHoldsTheFolder) {
  const TempFolder temp;
  const std::string out = (temp.path() / "out").string();
  make_folders(out);
  {
    const FolderLock lock(out, {"rnmbake bake hall.blend", 0, {}});
    const ProcessResult refused = shaders_into(out);
    EXPECT_EQ(refused.exit_code, 8) << refused.output;
    for (const std::string& part : {out, "process " + std::to_string(::getpid()), std::string("hall.blend")})
      EXPECT_NE(refused.output.find(part), std::string::npos) << refused.output;
  }
  const ProcessResult done = shaders_into(out);
  EXPECT_EQ(done.exit_code, 0) << done.output;
  EXPECT_FALSE(std::filesystem::exists(temp.path() / "out" / FolderLock::file_name));
  EXPECT_FALSE(std::filesystem::is_empty(out));
}

}  // namespace
}  // namespace rnmbake
