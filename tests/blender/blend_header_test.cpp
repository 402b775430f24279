#include "blender/blend_header.h"

#include "base/error.h"
#include "base/files.h"
#include "blender/launch_watch.h"
#include "blender/outcome.h"

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): SIGSEGV
#include <sys/stat.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

class BlendFile : public testing::Test {
 protected:
  fs::path write(std::string_view bytes) const {
    write_atomically(folder_.path() / "a.blend", bytes);
    return folder_.path() / "a.blend";
  }
  [[nodiscard]] std::string version(std::string_view bytes) const {
    const auto header = read_blend_header(write(bytes));
    return header ? fmt::format("{}.{}", header->major, header->minor) : "none";
  }
  static BlenderInfo blender(const BlenderVersion& version) {
    BlenderInfo info;
    info.version = version;
    info.version_text = fmt::format("{}.{}.{}", version.major, version.minor, version.patch);
    return info;
  }
  TempFolder folder_;
};

TEST_F(BlendFile, SaysWhichBlenderSavedIt) {
  EXPECT_EQ(version("BLENDER-v304REND"), "3.4");
  EXPECT_EQ(version("BLENDER_V279REND"), "2.79");
  EXPECT_EQ(version("BLENDER-v403"), "4.3");
  EXPECT_EQ(version("BLENDER17-01v0502REND"), "5.2");
  for (const char* text : {"", "BLENDER", "BLENDER-v30", "BLENDER-vabc", "Dear diary,\n", "BLENDER17-01v05"})
    EXPECT_EQ(version(text), "none") << text;
}

TEST_F(BlendFile, MayBeCompressed) {
  const fs::path plain = write("BLENDER-v402" + std::string(100000, 'x'));
  const auto compressed = [&](const std::string& program) {
    const std::string line = program + " -c < " + plain.string() + " > " + plain.string() + ".z";
    return std::system(line.c_str()) == 0;
  };
  ASSERT_TRUE(compressed("gzip"));
  EXPECT_EQ(read_blend_header(plain.string() + ".z")->minor, 2);
  if (!compressed("zstd")) GTEST_SKIP() << "SKIPPED: there is no program zstd";
  EXPECT_EQ(read_blend_header(plain.string() + ".z")->major, 4);
  EXPECT_EQ(version("\x28\xb5\x2f\xfd rubbish"), "none");
  EXPECT_EQ(version("\x1f\x8b rubbish"), "none");
}

TEST_F(BlendFile, OfALaterFormIsRefusedByVersion) {
  const fs::path file = write("BLENDER17-01v0502");
  const std::string said = unreadable_blend(file, blender({3, 4, 1}));
  EXPECT_NE(said.find("a.blend was saved by Blender 5.2, this is 3.4.1"), std::string::npos) << said;
  EXPECT_NE(said.find("--blender"), std::string::npos) << said;
  EXPECT_EQ(unreadable_blend(file, blender({4, 5, 0})), "");
  EXPECT_NE(newer_blend(file, blender({4, 5, 0}), "which"), "");
  EXPECT_EQ(newer_blend(file, blender({5, 2, 2}), "which"), "");
  EXPECT_EQ(unreadable_blend(write("BLENDER-v403"), blender({3, 4, 1})), "") << "it may open";
}

TEST_F(BlendFile, PipesAreNotOpened) {
  const fs::path pipe = folder_.path() / "pipe.blend";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW((void)read_blend_header(pipe), Error);
}

/// A launch that ended by SIGSEGV, on `scene`, after Blender printed `words`.
LaunchFailure crash(const fs::path& folder, const fs::path& scene, const BlenderInfo& info,
                    const std::string& words) {
  Launch launch;
  launch.scene = BlendPath(scene);
  launch.folder = folder;
  write_atomically(folder / "stdout.log", words);
  ProcessResult process;
  process.signal = SIGSEGV;
  return std::get<LaunchFailure>(judge(launch, info, {}, "nonce", process, LaunchWatch(launch.folder, {})));
}

TEST_F(BlendFile, ACrashOverANewerFileIsThatFiles) {
  const fs::path scene = write("BLENDER-v403");
  const LaunchFailure failure = crash(folder_.path(), scene, blender({3, 4, 1}), "");
  EXPECT_EQ(failure.kind, LaunchFailure::Kind::refused);
  EXPECT_EQ(failure.code, static_cast<int>(ExitCode::environment));
  EXPECT_NE(failure.message.find("saved by Blender 4.3, this is 3.4.1"), std::string::npos)
      << failure.message;
  EXPECT_NE(failure.message.find("SIGSEGV"), std::string::npos) << failure.message;
  EXPECT_EQ(crash(folder_.path(), scene, blender({4, 3, 2}), "").kind, LaunchFailure::Kind::crashed);
}

TEST_F(BlendFile, ACrashOverANewerLibraryIsThatLibrarys) {
  const fs::path scene = write("BLENDER-v304"), library = folder_.path() / "library.blend";
  write_atomically(library, "BLENDER-v403");
  const std::string words =
      "Info: Read library:  '" + library.string() + "', '//library.blend', parent '<direct>'\n";
  const LaunchFailure failure = crash(folder_.path(), scene, blender({3, 4, 1}), words);
  EXPECT_NE(failure.message.find("library.blend was saved by Blender 4.3"), std::string::npos)
      << failure.message;
}

TEST_F(BlendFile, ForeignAnswersNeitherCrashNorSucceed) {
  Launch launch;
  launch.folder = folder_.path();
  const auto judged = [&](const std::string& answer) {
    write_atomically(folder_.path() / "result.json", answer);
    ProcessResult process;
    return std::get<LaunchFailure>(
        judge(launch, blender({3, 4, 1}), {}, "n", process, LaunchWatch(launch.folder, {})));
  };
  using Kind = LaunchFailure::Kind;
  EXPECT_EQ(
      judged(R"({"nonce": "n", "ok": )" + std::string(100000, '[') + std::string(100000, ']') + "}").kind,
      Kind::no_result);
  EXPECT_EQ(judged(R"({"nonce": "n", "refused": {"code": 0, "message": "x"}})").code, 3);
  EXPECT_LT(
      judged(R"({"nonce": "n", "failed": {"message": ")" + std::string(1 << 20, 'x') + "\"}}").message.size(),
      30000U);
  fs::resize_file(folder_.path() / "result.json", std::uintmax_t{3} << 30);
  ProcessResult process;
  const auto huge = std::get<LaunchFailure>(
      judge(launch, blender({3, 4, 1}), {}, "n", process, LaunchWatch(launch.folder, {})));
  EXPECT_EQ(huge.kind, Kind::no_result);
  EXPECT_NE(huge.message.find("3221225472 bytes"), std::string::npos) << huge.message;
}

}  // namespace
}  // namespace rnmbake
