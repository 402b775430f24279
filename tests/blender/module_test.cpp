// Interpreters in Blender's place, with faults that no real one can be asked for. What the real module bpy
// does: ./dev matrix.
#include "blender/fixture.h"

#include <algorithm>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

/// Says that it is Python; `import_body`: what it does with a program.
fs::path fake_python(const TempFolder& folder, const std::string& import_body) {
  return shell_script(folder.path() / "python3",
                      "if [ \"$1\" = --version ]; then echo Python 3.11.2; exit 0; fi\n" + import_body);
}

std::string said_of(const fs::path& python, double limit_seconds = 60) {
  const std::string said = message_of([&] { probe_version(python, limit_seconds); }, ExitCode::environment);
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  EXPECT_TRUE(holds(said, python.string())) << said;
  EXPECT_TRUE(holds(said, "--blender")) << said;
  return said;
}

TEST(ProbeModule, SaysThatAPythonHasNone) {
  const std::string said = said_of("/usr/bin/python3");
  EXPECT_TRUE(holds(said, "/usr/bin/python3 -m pip install bpy")) << said;
}

TEST(ProbeModule, SaysWhyItCannotBeImported) {
  const TempFolder folder;
  const auto lost =
      fake_python(folder, "echo Traceback; echo 'ImportError: libSM.so.6: cannot open'; exit 1");
  EXPECT_TRUE(holds(said_of(lost), "(exit code 1: ImportError: libSM.so.6: cannot open)"));
  const auto crash = fake_python(folder, "kill -SEGV $$");
  EXPECT_TRUE(holds(said_of(crash), "SIGSEGV"));
}

TEST(ProbeModule, SaysThatItDoesNotAnswer) {
  const TempFolder folder;
  EXPECT_TRUE(holds(said_of(fake_python(folder, "sleep 60"), 0.5), "did not answer `import bpy`"));
}

TEST(ProbeModule, TakesNoGarbage) {
  const TempFolder folder;
  const auto garbage = fake_python(folder, "head -c 100000 /dev/zero | tr '\\0' x; echo; echo Blended 7");
  EXPECT_TRUE(holds(said_of(garbage), "Blended 7"));
  const auto old = fake_python(folder, "echo 'Blender 2.93.1'");
  EXPECT_TRUE(holds(said_of(old), "2.93.1, rnmbake needs"));
}

TEST(ProbeModule, KnowsVersionAndFolders) {
  const TempFolder folder;
  const auto python = fake_python(
      folder, "echo 'Blender 4.2.23 LTS'; echo 'build hash: abc'; echo 'folder: /v'; echo 'folder: /usr'");
  const BlenderInfo info = probe_version(python);
  EXPECT_TRUE(info.is_module);
  EXPECT_EQ(info.version, (BlenderVersion{4, 2, 23}));
  EXPECT_EQ(info.build, "hash: abc");
  EXPECT_EQ(info.folders, (std::vector<fs::path>{"/v", "/usr"}));
}

TEST(ProbeModule, IsLaunchedByTheRunner) {
  const ScriptFolder scripts;
  BlenderInfo info;
  info.executable = "/v/bin/python3";
  info.is_module = true;
  info.version = {4, 2, 0};
  Launch launch;
  launch.entry = "probe_entry.py";
  launch.folder = "/f";
  const std::vector<std::string> argv = launch_argv(info, scripts, {false}, launch);
  ASSERT_GT(argv.size(), 3U);
  EXPECT_EQ(argv[0], "/v/bin/python3");
  EXPECT_EQ(argv[1], (scripts.path() / "bpy_runner.py").string());
  EXPECT_EQ(argv[2], "-b");
  EXPECT_NE(std::find(argv.begin(), argv.end(), "-Y"), argv.end());
}

}  // namespace
}  // namespace rnmbake
