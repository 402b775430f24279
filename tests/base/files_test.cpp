#include "base/files.h"

#include "base/error.h"
#include "base/leftovers.h"
#include "base/owner.h"
#include "base/read_file.h"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::io);
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

TEST(ReadText, TakesRegularFilesOfALimitedSizeOnly) {
  const TempFolder folder;
  const fs::path pipe = folder.path() / "pipe", large = folder.path() / "large";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::ofstream(large).put('x');
  fs::resize_file(large, (std::uintmax_t{1} << 32) + 1);
  for (const fs::path& path : {pipe, fs::path("/dev/zero")}) {
    const std::string said = message_of([&] { (void)read_text(path); });
    EXPECT_NE(said.find(path.string() + ": it is a pipe, a device or a socket"), std::string::npos) << said;
    EXPECT_EQ(read_tail(path, 100), "");
    EXPECT_EQ(read_part(path, 0, 100), "");
  }
  EXPECT_NE(message_of([&] { (void)read_text(folder.path()); }).find("it is a folder"), std::string::npos);
  EXPECT_NE(message_of([&] { (void)read_text(large); }).find("4294967297 bytes"), std::string::npos);
  EXPECT_EQ(read_part(large, std::uintmax_t{1} << 32, 100), std::string(1, '\0'));
  EXPECT_EQ(read_part(large, 0, 1), "x");
}

TEST(FileInside, NamesNeverLeadElsewhere) {
  EXPECT_EQ(file_inside("a", "b.exr"), fs::path("a/b.exr"));
  for (const std::string& name :
       {std::string(), std::string("."), std::string(".."), std::string("../x"), std::string("/x"),
        std::string("x/y"), std::string("x\0.exr", 6), std::string("x\ny")}) {
    EXPECT_FALSE(file_inside("a", name)) << name;
  }
}

TEST(WriteAtomically, ReplacesTheFileAndLeavesNothingElse) {
  const TempFolder folder;
  const fs::path path = folder.path() / "a.txt";
  write_atomically(path, "one");
  write_atomically(path, std::string_view("two\0three", 9));
  EXPECT_EQ(read_text(path), std::string("two\0three", 9));
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(WriteAtomically, LeavesAFileAloneThatHoldsTheSameBytes) {
  const TempFolder folder;
  const fs::path file = folder.path() / "manifest.json";
  const auto writes = [&](const std::string& bytes) {
    const auto before = fs::file_time_type::clock::now() - std::chrono::hours(1);
    fs::last_write_time(file, before);
    write_atomically(file, bytes);
    EXPECT_EQ(read_text(file), bytes);
    EXPECT_EQ(files_in(folder.path()), 1U) << "no temporary stays";
    return fs::last_write_time(file) != before;
  };
  const std::string large(200'000, 'x');
  write_atomically(file, large);
  EXPECT_FALSE(writes(large));
  EXPECT_TRUE(writes(large + "x"));
  EXPECT_FALSE(writes(large + "x"));
  EXPECT_TRUE(writes(large + "y")) << "the last byte";
  EXPECT_TRUE(writes("y" + large)) << "the first byte";
  EXPECT_TRUE(writes(""));
  EXPECT_FALSE(writes(""));
}

TEST(WriteAtomically, ReplacesALinkByAFileWhateverItLeadsTo) {
  const TempFolder folder;
  write_atomically(folder.path() / "there", "same");
  fs::create_symlink("there", folder.path() / "link");
  write_atomically(folder.path() / "link", "same");
  EXPECT_FALSE(fs::is_symlink(folder.path() / "link"));
}

TEST(WriteAtomically, FollowsTheUmask) {
  const TempFolder folder;
  const mode_t before = ::umask(0027);
  write_atomically(folder.path() / "a", "x");
  ::umask(before);
  struct stat status {};
  ASSERT_EQ(::stat((folder.path() / "a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0640u);
}

TEST(WriteAtomically, KeepsTheOldFileWhenTheWriterThrows) {
  const TempFolder folder;
  const fs::path path = folder.path() / "a.exr";
  write_atomically(path, "old");
  EXPECT_THROW(write_atomically(path,
                                [](const fs::path& temporary) {
                                  EXPECT_EQ(temporary.extension(), ".exr");
                                  std::ofstream(temporary) << "half";
                                  throw std::runtime_error("broken");
                                }),
               std::runtime_error);
  EXPECT_EQ(read_text(path), "old");
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(WriteAtomically, AWriterMayReplaceTheTemporaryFile) {
  const TempFolder folder;
  const fs::path path = folder.path() / "a";
  write_atomically(path, [](const fs::path& temporary) {
    fs::remove(temporary);
    std::ofstream(temporary) << "new";
  });
  EXPECT_EQ(read_text(path), "new");
}

TEST(WriteAtomically, NamesThePathAndTheReason) {
  const TempFolder folder;
  const std::string missing = message_of([&] { write_atomically(folder.path() / "no" / "a", "x"); });
  EXPECT_NE(missing.find((folder.path() / "no" / "a").string()), std::string::npos) << missing;
  EXPECT_NE(missing.find("No such file"), std::string::npos) << missing;
  EXPECT_NE(message_of([&] { write_atomically(folder.path(), "x"); }).find("folder"), std::string::npos);
}

TEST(WriteAtomically, SaysThatTheDiskIsFull) {
  const TempFolder folder;
  const std::string mount = "mount -t tmpfs -o size=64k none " + folder.path().string() + " 2>/dev/null";
  if (std::system(mount.c_str()) != 0) GTEST_SKIP() << "SKIPPED: a small tmpfs needs root";
  const fs::path path = folder.path() / "a";
  const std::string said = message_of([&] { write_atomically(path, std::string(1 << 20, 'x')); });
  EXPECT_NE(said.find("disk is full"), std::string::npos) << said;
  EXPECT_EQ(files_in(folder.path()), 0u);
  const std::string by_writer = message_of([&] {
    write_atomically(path, [](const fs::path& temporary) {
      std::ofstream stream(temporary);
      stream << std::string(1 << 20, 'x') << std::flush;
      if (!stream) throw std::runtime_error("write error");
    });
  });
  EXPECT_NE(by_writer.find("disk is full"), std::string::npos) << by_writer;
  EXPECT_EQ(std::system(("umount " + folder.path().string()).c_str()), 0);
}

TEST(ReadText, NamesWhatIsMissing) {
  EXPECT_NE(message_of([] { (void)read_text("/nowhere/x"); }).find("/nowhere/x"), std::string::npos);
  EXPECT_NE(message_of([] { (void)read_text("/tmp"); }).find("folder"), std::string::npos);
}

TEST(ReadTail, BeginsWithAWholeLine) {
  const TempFolder folder;
  write_atomically(folder.path() / "a", "first\nsecond\nthird\n");
  EXPECT_EQ(read_tail(folder.path() / "a", 10), "third\n");
  EXPECT_EQ(read_tail(folder.path() / "a", 100), "first\nsecond\nthird\n");
  EXPECT_EQ(read_tail(folder.path() / "b", 100), "");
}

TEST(TempFolder, IsPrivateAndGoesAway) {
  fs::path path;
  {
    const TempFolder folder;
    path = folder.path();
    struct stat status {};
    ASSERT_EQ(::stat(path.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777u, 0700u);
    write_atomically(path / "a", "x");
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(TempFolder, MovesWithItsContent) {
  TempFolder first;
  const fs::path path = first.path();
  {
    const TempFolder second = std::move(first);
    EXPECT_EQ(second.path(), path);
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(Owner, KnowsTheDeadOfItsOwnHost) {
  const std::string us = owner_word();
  EXPECT_FALSE(owner_is_gone(us));
  EXPECT_TRUE(owner_is_gone(us + '0')) << "the number is ours, the start is not";
  std::string elsewhere = us;
  elsewhere[0] = elsewhere[0] == 'x' ? 'y' : 'x';
  EXPECT_FALSE(owner_is_gone(elsewhere + '0')) << "another host";
  std::string before = us;
  before[9] = before[9] == 'x' ? 'y' : 'x';
  EXPECT_TRUE(owner_is_gone(before)) << "the machine has started anew since";
  for (const char* nonsense : {"", "-", "---", "a-b-c-d"}) EXPECT_FALSE(owner_is_gone(nonsense)) << nonsense;
}

TEST(Leftovers, OnlyWhatADeadOwnerLeftGoes) {
  const TempFolder folder;
  const std::string ours = owner_word(), dead = ours + '0';
  for (const std::string& name :
       {"rnmbake-" + dead + "-AbCdEf", "rnmbake-" + ours + "-AbCdEf", "rnmbake-" + dead + "-kept00",
        std::string("rnmbake-XyZ123"), std::string("rnmbake-x-y")}) {
    make_folders(folder.path() / name / "below");
  }
  mark_as_kept(folder.path() / ("rnmbake-" + dead + "-kept00"));
  for (const std::string& name :
       {".tmp-" + dead + "-0123456789ab.exr", ".tmp-" + ours + "-0123456789ab.exr",
        std::string(".tmp-0123456789ab.exr"), "floor-" + dead + "-0123456789ab.exr"}) {
    const std::ofstream file(folder.path() / name);
  }
  fs::create_symlink("/tmp", folder.path() / ("rnmbake-" + dead + "-symbol"));
  sweep_leftovers(folder.path());
  EXPECT_FALSE(fs::exists(folder.path() / ("rnmbake-" + dead + "-AbCdEf")));
  EXPECT_FALSE(fs::exists(folder.path() / (".tmp-" + dead + "-0123456789ab.exr")));
  EXPECT_EQ(files_in(folder.path()), 10U - 2U);
  const fs::path late = folder.path() / (".tmp-" + dead + "-late.exr");
  { const std::ofstream file(late); }
  sweep_leftovers(folder.path());
  EXPECT_TRUE(fs::exists(late)) << "once is enough";
}

TEST(TempFolder, KeptOnesAreMarked) {
  const TempFolder parent;
  fs::path path;
  {
    TempFolder folder(parent.path());
    folder.keep();
    path = folder.path();
  }
  EXPECT_TRUE(fs::exists(path / ".kept"));
  EXPECT_NE(path.filename().string().find(owner_word()), std::string::npos);
}

TEST(MakeFolders, NamesAFileInTheWay) {
  const TempFolder folder;
  write_atomically(folder.path() / "file", "x");
  make_folders(folder.path() / "a" / "b");
  EXPECT_TRUE(fs::is_directory(folder.path() / "a" / "b"));
  EXPECT_NE(message_of([&] { make_folders(folder.path() / "file"); }).find("file"), std::string::npos);
  EXPECT_NE(message_of([&] { make_folders(folder.path() / "file" / "x"); }).find("cannot create"),
            std::string::npos);
}

}  // namespace
}  // namespace rnmbake
