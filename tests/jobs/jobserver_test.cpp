#include "jobs/jobserver.h"

#include "base/files.h"
#include "process/stop.h"
#include "support/run_words.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rnmbake {
namespace {

/// A pipe with tokens in it, as make has it; each token is a letter of its own.
class Tokens {
 public:
  explicit Tokens(const std::string& tokens) {
    EXPECT_EQ(::pipe(ends_.data()), 0);
    EXPECT_EQ(::write(ends_[1], tokens.data(), tokens.size()), std::ssize(tokens));
  }
  ~Tokens() {
    ::close(ends_[0]);
    ::close(ends_[1]);
  }
  Tokens(const Tokens&) = delete;
  Tokens& operator=(const Tokens&) = delete;

  [[nodiscard]] std::string flags() const {
    return " -j --jobserver-auth=" + std::to_string(ends_[0]) + "," + std::to_string(ends_[1]) + " -- X=1";
  }
  /// What is in the pipe now, which is empty then.
  [[nodiscard]] std::string drain() const {
    ::fcntl(ends_[0], F_SETFL, O_NONBLOCK);
    std::array<char, 64> bytes{};
    const ssize_t count = ::read(ends_[0], bytes.data(), bytes.size());
    return count > 0 ? std::string(bytes.data(), std::size_t(count)) : "";
  }
  [[nodiscard]] bool blocks() const { return (::fcntl(ends_[0], F_GETFL) & O_NONBLOCK) == 0; }

 private:
  std::array<int, 2> ends_{};
};

TEST(Jobserver, TakesWhatIsThereAndNeverWaits) {
  const Tokens pipe("ab");
  Jobserver server(pipe.flags());
  ASSERT_TRUE(server.connected());
  EXPECT_TRUE(server.try_acquire());
  EXPECT_TRUE(server.try_acquire());
  EXPECT_FALSE(server.try_acquire());
  EXPECT_EQ(server.held(), 2);
  EXPECT_TRUE(pipe.blocks()) << "make's other children wait on it";
  server.release();
  EXPECT_EQ(server.held(), 1);
  EXPECT_TRUE(server.try_acquire());
}

TEST(Jobserver, GivesBackTheSameTokens) {
  const Tokens pipe("xyz");
  {
    Jobserver server(pipe.flags());
    EXPECT_EQ(jobs_granted(server, 3), 3);
    EXPECT_EQ(server.held(), 2) << "the first process has make's own slot";
  }
  std::string left = pipe.drain();
  std::ranges::sort(left);
  EXPECT_EQ(left, "xyz");
}

TEST(Jobserver, GivesBackWhereAnExceptionPasses) {
  const Tokens pipe("a");
  try {
    Jobserver server(pipe.flags());
    EXPECT_TRUE(server.try_acquire());
    throw std::runtime_error("a launch failed");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(pipe.drain(), "a");
}

TEST(Jobserver, GrantsNoMoreThanThereIs) {
  const Tokens pipe("a");
  Jobserver server(pipe.flags());
  EXPECT_EQ(jobs_granted(server, 8), 2);
  server.release();
  server.release();
  server.release();
  EXPECT_EQ(server.held(), 0);
  EXPECT_EQ(pipe.drain(), "a") << "no token out of nothing";
}

TEST(Jobserver, WithoutAMakeEveryJobIsGranted) {
  for (const char* flags :
       {"", "-k", "-j4", "--jobserver-auth=-2,-2", "--jobserver-auth=", "--jobserver-auth=fifo:/nowhere",
        "--jobserver-auth=1000,1001", "--jobserver-auth=0", "--jobserver-auth=x,y"}) {
    Jobserver server(flags);
    EXPECT_FALSE(server.connected()) << flags;
    EXPECT_FALSE(server.try_acquire()) << flags;
    EXPECT_EQ(jobs_granted(server, 5), 5) << flags;
  }
}

TEST(Jobserver, TheLastOfSeveralCounts) {
  const Tokens outer("a"), inner("bc");
  Jobserver server(outer.flags() + inner.flags());
  EXPECT_EQ(jobs_granted(server, 9), 3);
}

TEST(Jobserver, TakesTheNamedPipeOfNewerMakes) {
  const TempFolder folder;
  const std::string fifo = (folder.path() / "GMfifo7").string();
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  const int end = ::open(fifo.c_str(), O_RDWR | O_NONBLOCK);
  ASSERT_EQ(::write(end, "++", 2), 2);
  {
    Jobserver server("-j3 --jobserver-auth=fifo:" + fifo);
    EXPECT_EQ(jobs_granted(server, 8), 3);
  }
  std::array<char, 8> bytes{};
  EXPECT_EQ(::read(end, bytes.data(), bytes.size()), 2);
  ::close(end);
}

// The second signal ends the process at once, without destructors.
TEST(Jobserver, GivesBackWhenTheSecondSignalKills) {
  const Tokens pipe("pq");
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    StopRequest::install();
    Jobserver server(pipe.flags());
    if (jobs_granted(server, 3) != 3) ::_exit(1);
    std::raise(SIGTERM);
    if (server.held() != 2) ::_exit(2);  // the first one is polite
    std::raise(SIGTERM);
    ::_exit(3);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGTERM);
  std::string left = pipe.drain();
  std::ranges::sort(left);
  EXPECT_EQ(left, "pq");
}

// What a recipe of a real make sees. This very test program is started again and says what it was granted.
TEST(Jobserver, OfARealMake) {
  const TempFolder folder;
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string call =
      self +
      " --gtest_also_run_disabled_tests --gtest_filter=Jobserver.DISABLED_SaysWhatItWasGranted > $@.log; "
      "grep '^granted' $@.log\n";
  write_atomically(folder.path() / "Makefile",
                   ".PHONY: with without\nwith:\n\t@+" + call + "without:\n\t@" + call);
  const std::string dir = folder.path().string();
  const auto granted = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"make", "--no-print-directory", "-C", dir});
    const ProcessResult done = run_words(words);
    EXPECT_TRUE(done.succeeded()) << done.output;
    EXPECT_EQ(done.output.find("INTERNAL"), std::string::npos) << "make counts its tokens: " << done.output;
    return done.output;
  };
  EXPECT_EQ(granted({"-j3", "with"}), "granted 3\n");
  EXPECT_EQ(granted({"-j1", "with"}), "granted 8\n")
      << "no jobserver where make runs one job: --jobs is the user's own";
  EXPECT_EQ(granted({"-j3", "without"}), "granted 8\n") << "make closed its pipe: the line has no +";
}

TEST(Jobserver, DISABLED_SaysWhatItWasGranted) {
  Jobserver server;
  std::printf("granted %d\n", jobs_granted(server, 8));
}

}  // namespace
}  // namespace rnmbake
