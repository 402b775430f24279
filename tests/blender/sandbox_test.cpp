// The words that bubblewrap is given, and who is refused; what they keep out: with_blender/sandbox/.
#include "blender/sandbox/sandbox.h"

#include "base/error.h"
#include "base/files.h"
#include "process/run.h"

#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

TEST(Sandbox, MountsWhatLiesAboveFirst) {
  const TempFolder folder;
  Sandbox sandbox;
  const fs::path scene = folder.path() / "scene", launch = scene / "launch";
  make_folders(launch);
  sandbox.read = {launch / "nowhere", scene};
  sandbox.write = launch;
  const std::vector<std::string> words = sandboxed({"blender", "-b"}, sandbox);
  const auto at = [&](const std::string& word) { return std::find(words.begin(), words.end(), word); };
  EXPECT_EQ(words.front(), "bwrap");
  EXPECT_EQ(*(at(scene.string()) - 1), "--ro-bind");
  EXPECT_EQ(*(at(launch.string()) - 1), "--bind");
  EXPECT_LT(at(scene.string()), at(launch.string()));
  EXPECT_EQ(at((launch / "nowhere").string()), words.end());
  for (const char* wall : {"--unshare-all", "--die-with-parent", "--new-session", "--disable-userns"})
    EXPECT_NE(at(wall), words.end()) << wall;
  EXPECT_EQ(std::vector<std::string>(at("--") + 1, words.end()), (std::vector<std::string>{"blender", "-b"}));
}

TEST(Sandbox, HidesGpusUnlessAskedFor) {
  const TempFolder folder;
  Sandbox sandbox;
  sandbox.write = folder.path();
  const auto has = [&](const char* word) {
    const auto words = sandboxed({"true"}, sandbox);
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  EXPECT_FALSE(has("/dev/dri"));
  sandbox.gpu = true;
  EXPECT_TRUE(has("/dev/dri"));
}

TEST(Sandbox, TellsFewVariables) {
  ::setenv("A_SECRET_TOKEN", "x", 1);
  ::setenv("LC_NUMERIC", "C", 1);
  bool language = false;
  for (const auto& [name, value] : sandbox_environment(false)) {
    EXPECT_NE(name, "A_SECRET_TOKEN");
    EXPECT_NE(name, "HOME");
    language = language || name == "LC_NUMERIC";
  }
  EXPECT_TRUE(language);
  ::unsetenv("A_SECRET_TOKEN");
  ::unsetenv("LC_NUMERIC");
}

TEST(Sandbox, RefusesFoldersThatHoldAHome) {
  const TempFolder folder;
  const char* home = std::getenv("HOME");
  for (const fs::path& broad : {fs::path("/"), fs::path(home != nullptr ? home : "/root"), temp_root()})
    EXPECT_THROW(refuse_broad_folder(broad, "s.blend"), Error) << broad;
  EXPECT_NO_THROW(refuse_broad_folder(folder.path(), "s.blend"));
  EXPECT_NO_THROW(refuse_broad_folder("/srv/scenes", "s.blend"));
}

TEST(Sandbox, LeavesNoLinksToBeFollowed) {
  const TempFolder folder;
  make_folders(folder.path() / "a");
  write_atomically(folder.path() / "a" / "result", "x");
  EXPECT_EQ(remove_links(folder.path()), std::nullopt);
  ASSERT_EQ(::symlink("/etc/passwd", (folder.path() / "a" / "link").c_str()), 0);
  ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  EXPECT_NE(remove_links(folder.path()), std::nullopt);
  EXPECT_FALSE(fs::is_symlink(folder.path() / "a" / "link"));
  EXPECT_FALSE(fs::exists(folder.path() / "pipe"));
  EXPECT_TRUE(fs::exists(folder.path() / "a" / "result"));
  EXPECT_TRUE(fs::exists("/etc/passwd"));
}

/// What it is asked to run sees its own folder and nothing of others'.
TEST(Sandbox, HoldsAProgram) {
  if (const auto obstacle = sandbox_obstacle()) GTEST_SKIP() << "SKIPPED: no sandbox here: " << *obstacle;
  const TempFolder inside, outside;
  write_atomically(outside.path() / "secret", "x");
  Sandbox sandbox;
  sandbox.write = inside.path();
  ProcessOptions options;
  const std::string other = outside.path().string();
  options.argv = sandboxed(
      {"/bin/sh", "-c", "touch here; touch /new; cat " + other + "/secret; ls /home /root"}, sandbox);
  const ProcessResult result = run_process(options);
  EXPECT_TRUE(fs::exists(inside.path() / "here"));
  EXPECT_NE(result.output.find("Read-only file system"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("/secret: No such file"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("'/root': No such file"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace rnmbake
