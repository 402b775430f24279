#include "jobs/folder_lock.h"

#include "base/error.h"
#include "base/files.h"
#include "jobs/store_cases.h"

#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

/// A process that holds a folder until it is told to end, or is killed.
class Holder {
 public:
  explicit Holder(const fs::path& folder) {
    int ready[2], end[2];
    EXPECT_EQ(::pipe(ready), 0);
    EXPECT_EQ(::pipe(end), 0);
    child_ = ::fork();
    if (child_ == 0) {
      ::close(end[1]);
      {
        const FolderLock lock(folder, {"rnmbake bake hall.blend -o out", 0, {}});
        const char word = lock.holds() ? 'y' : 'n';
        (void)!::write(ready[1], &word, 1);
        char ignored = 0;
        (void)!::read(end[0], &ignored, 1);
      }
      ::_exit(0);
    }
    ::close(end[0]);
    ::close(ready[1]);
    char word = 0;
    EXPECT_EQ(::read(ready[0], &word, 1), 1);
    EXPECT_EQ(word, 'y');
    ::close(ready[0]);
    end_ = end[1];
  }
  ~Holder() {
    ::close(end_);
    if (child_ > 0) ::waitpid(child_, nullptr, 0);
  }
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;

  [[nodiscard]] pid_t number() const { return child_; }
  void end() {
    (void)!::write(end_, "x", 1);
    ::waitpid(child_, nullptr, 0);
    child_ = -1;
  }
  void kill() {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
    child_ = -1;
  }

 private:
  pid_t child_ = -1;
  int end_ = -1;
};

std::string refused(const fs::path& folder, double wait_seconds = 0, std::function<bool()> stop = {}) {
  try {
    const FolderLock lock(folder, {"mine", wait_seconds, std::move(stop)});
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::lock_held);
    return error.what();
  }
  return "";
}

TEST(FolderLock, LeavesNothingBehind) {
  const TempFolder temp;
  {
    const FolderLock lock(temp.path(), {"rnmbake bake", 0, {}});
    EXPECT_TRUE(lock.holds());
    const LockHolder holder = read_holder(temp.path() / FolderLock::file_name);
    EXPECT_EQ(holder.process, std::to_string(::getpid()));
    EXPECT_EQ(holder.command, "rnmbake bake");
    EXPECT_NE(refused(temp.path()), "");  // a second one of the same process, too
  }
  EXPECT_TRUE(fs::is_empty(temp.path()));
  EXPECT_EQ(refused(temp.path()), "");
}

TEST(FolderLock, NamesTheProcessThatHoldsTheFolder) {
  const TempFolder temp;
  Holder holder(temp.path());
  const std::string why = refused(temp.path());
  for (const std::string& part :
       {temp.path().string(), "process " + std::to_string(holder.number()) + " on ", std::string("since 20"),
        std::string("(rnmbake bake hall.blend -o out)"), std::string("--lock-wait")})
    EXPECT_NE(why.find(part), std::string::npos) << part << " is not in: " << why;
  holder.end();
  EXPECT_EQ(refused(temp.path()), "");
}

TEST(FolderLock, IsFreeAgainWhenTheHolderWasKilled) {
  const TempFolder temp;
  Holder holder(temp.path());
  holder.kill();
  EXPECT_TRUE(fs::exists(temp.path() / FolderLock::file_name));
  EXPECT_EQ(refused(temp.path()), "");
}

TEST(FolderLock, WaitsForTheHolder) {
  const TempFolder temp;
  Holder holder(temp.path());
  std::thread ender([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    holder.end();
  });
  Said said;
  EXPECT_EQ(refused(temp.path(), 60), "");
  EXPECT_NE(said.take().find("waiting up to 60 seconds"), std::string::npos);
  ender.join();
}

TEST(FolderLock, GivesUpWaiting) {
  const TempFolder temp;
  const Holder holder(temp.path());
  Said said;
  EXPECT_NE(refused(temp.path(), 0.05).find("waited 0.05 seconds"), std::string::npos);
  EXPECT_NE(refused(temp.path(), 600, [] { return true; }), "");
}

TEST(FolderLock, LetsOneAtATimeIn) {
  const TempFolder temp;
  const fs::path inside = temp.path() / "inside";
  std::vector<pid_t> children;
  for (int i = 0; i < 4; ++i) {
    const pid_t child = ::fork();
    if (child == 0) {
      int clashes = 0;
      for (int k = 0; k < 25; ++k) {
        const FolderLock lock(temp.path(), {"child", 120, {}});
        if (!lock.holds() || !fs::create_directory(inside)) ++clashes;
        std::this_thread::yield();
        fs::remove(inside);
      }
      ::_exit(clashes);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  }
}

TEST(FolderLock, WarnsWhereNothingCanBeLocked) {
  const TempFolder temp;
  fs::create_directory(temp.path() / FolderLock::file_name);
  Said said;
  const FolderLock lock(temp.path(), {"mine", 0, {}});
  EXPECT_FALSE(lock.holds());
  EXPECT_NE(said.take().find("cannot lock"), std::string::npos);
  EXPECT_TRUE(fs::exists(temp.path() / FolderLock::file_name));
}

TEST(FolderLock, ReadsWhateverStandsInTheFile) {
  const TempFolder temp;
  const fs::path file = temp.path() / FolderLock::file_name;
  EXPECT_EQ(read_holder(file).process, "");
  for (const std::string text : {"", "\n\n", "process", "process 12", "x y\nhost a b\ncommand"}) {
    write_file(file, text);
    (void)read_holder(file);
  }
  EXPECT_EQ(read_holder(file).host, "a b");
  Holder holder(temp.path());  // over what was there
  EXPECT_EQ(read_holder(file).process, std::to_string(holder.number()));
  write_file(file, "");  // as in the moment after it was taken
  EXPECT_NE(refused(temp.path()).find("only just begun"), std::string::npos);
}

}  // namespace
}  // namespace rnmbake
