#include "blender/probe.h"

#include "blender/fixture.h"

namespace rnmbake {
namespace {

TEST(ParseVersion, ReadsWhatBlendersPrint) {
  BlenderInfo info;
  ASSERT_TRUE(parse_version(
      "00:00.1 system | WARNING x\nBlender 5.2.2 LTS\n\tbuild date: 2026-01-02\n\tbuild hash: abc\n", info));
  EXPECT_EQ(info.version, (BlenderVersion{5, 2, 2}));
  EXPECT_EQ(info.version_text, "5.2.2");
  EXPECT_EQ(info.build, "date: 2026-01-02, hash: abc");
  ASSERT_TRUE(parse_version("Blender 2.79 (sub 0)\n", info));
  EXPECT_EQ(info.version, (BlenderVersion{2, 79, 0}));
  EXPECT_FALSE(parse_version("GNU bash 5.2\n", info));
  EXPECT_FALSE(parse_version("", info));
}

TEST(ProbeVersion, NamesWhatIsTooOld) {
  const TempFolder folder;
  const auto old = shell_script(folder.path() / "blender", "echo 'Blender 3.3.21'");
  const std::string said = message_of([&] { probe_version(old); }, ExitCode::environment);
  EXPECT_TRUE(holds(said, "Blender 3.3.21, rnmbake needs 3.4")) << said;
  EXPECT_TRUE(holds(said, old.string())) << said;
}

TEST(ProbeVersion, NamesWhatIsNoBlender) {
  const TempFolder folder;
  const auto crash = shell_script(folder.path() / "crash", "kill -SEGV $$");
  EXPECT_TRUE(holds(message_of([&] { probe_version(crash); }, ExitCode::environment), "SIGSEGV"));
  EXPECT_TRUE(holds(message_of([] { probe_version("/bin/false"); }, ExitCode::environment), "exit code 1"));
  EXPECT_TRUE(holds(message_of([] { probe_version("/nowhere/b"); }, ExitCode::environment),
                    "cannot start /nowhere/b"));
}

TEST(ProbeVersion, OfTheInstalledBlender) {
  REQUIRE_BLENDER(blender);
  EXPECT_GE(blender->version, oldest_blender);
  EXPECT_TRUE(blender->devices.empty()) << "devices cost a launch";
}

TEST(ProbeDevices, OfTheInstalledBlender) {
  REQUIRE_BLENDER(found);
  BlenderInfo blender = *found;
  probe_devices(blender, ScriptFolder());
  EXPECT_NE(std::find(blender.devices.begin(), blender.devices.end(), "CPU"), blender.devices.end());
}

TEST(ProbeDevices, SaysThatABlenderDoesNotRun) {
  const TempFolder folder;
  BlenderInfo broken;
  broken.executable = shell_script(folder.path() / "blender", "exit 3");
  broken.version = {4, 0, 0};
  broken.version_text = "4.0.0";
  const std::string said = message_of([&] { probe_devices(broken, ScriptFolder()); }, ExitCode::environment);
  EXPECT_TRUE(holds(said, "exit code 3")) << said;
}

TEST(ScriptFolder, HoldsTheEmbeddedScripts) {
  std::filesystem::path path;
  {
    const ScriptFolder scripts;
    path = scripts.path();
    for (const char* name : {"probe_entry.py", "core/task.py"}) {
      EXPECT_EQ(read_text(path / name),
                read_text(std::filesystem::path(RNMBAKE_SOURCE_DIR) / "blender_scripts" / name));
    }
    EXPECT_TRUE(holds(message_of([&] { (void)scripts.entry("none.py"); }, ExitCode::environment), "none.py"));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(ScriptFolder, AnotherFolderMustBeThere) {
  EXPECT_TRUE(holds(message_of([] { const ScriptFolder scripts("/nowhere"); }, ExitCode::usage), "/nowhere"));
}

}  // namespace
}  // namespace rnmbake
