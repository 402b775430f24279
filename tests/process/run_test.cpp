#include "process/run.h"

#include "base/error.h"
#include "base/files.h"
#include "base/owner.h"
#include "process/stop.h"
#include "process/tree.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): kill
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rnmbake {
namespace {

using EndedBy = ProcessResult::EndedBy;

ProcessOptions sh(const std::string& script) {
  ProcessOptions options;
  options.argv = {"sh", "-c", script};
  options.grace_seconds = 0.3;
  options.tick_seconds = 0.05;
  return options;
}

/// Gone, or dead and only waiting for its parent to notice.
bool is_gone(pid_t id) {
  std::ifstream stream("/proc/" + std::to_string(id) + "/stat");
  std::string text;
  if (!std::getline(stream, text)) return true;
  return text.compare(text.rfind(')') + 2, 1, "Z") == 0;
}

bool is_gone_soon(pid_t id) {
  for (int i = 0; i < 200; ++i) {
    if (is_gone(id)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

pid_t number_in(const std::filesystem::path& file) {
  return std::stoi(read_text(file));
}

TEST(RunProcess, TellsTheExitCodeAndTheOutput) {
  const ProcessResult result = run_process(sh("echo out; echo err >&2; exit 7"));
  EXPECT_EQ(result.exit_code, 7);
  EXPECT_EQ(result.signal, 0);
  EXPECT_EQ(result.ended_by, EndedBy::itself);
  EXPECT_FALSE(result.succeeded());
  EXPECT_EQ(result.output, "out\nerr\n");
  EXPECT_TRUE(run_process(sh("true")).succeeded());
}

TEST(RunProcess, TellsTheSignal) {
  EXPECT_EQ(run_process(sh("kill -SEGV $$")).signal, SIGSEGV);
  EXPECT_EQ(run_process(sh("kill -9 $$")).signal, SIGKILL);
  EXPECT_EQ(signal_name(SIGSEGV), "SIGSEGV");
  EXPECT_EQ(signal_name(99), "signal 99");
}

TEST(RunProcess, PassesArgumentsUntouched) {
  ProcessOptions options;
  options.argv = {"printf", "%s|", "a b", "", "$HOME", "*"};
  EXPECT_EQ(run_process(options).output, "a b||$HOME|*|");
}

TEST(RunProcess, ChangesEnvironmentAndFolder) {
  const TempFolder folder;
  ASSERT_EQ(::setenv("RNMBAKE_TEST_GONE", "x", 1), 0);
  ProcessOptions options = sh("echo $RNMBAKE_TEST_NEW-$RNMBAKE_TEST_GONE-; pwd; cat");
  options.environment = {{"RNMBAKE_TEST_NEW", "new"}, {"RNMBAKE_TEST_GONE", std::nullopt}};
  options.folder = folder.path();
  const std::string physical = std::filesystem::canonical(folder.path()).string();
  EXPECT_EQ(run_process(options).output, "new--\n" + physical + "\n");  // and cat found stdin empty
  ::unsetenv("RNMBAKE_TEST_GONE");
}

TEST(RunProcess, BeginsWithAnEmptyEnvironmentWhereAskedTo) {
  ASSERT_EQ(::setenv("RNMBAKE_TEST_OURS", "x", 1), 0);
  ProcessOptions options;
  options.argv = {"/usr/bin/env"};
  options.environment = {{"A", "b"}};
  options.bare = true;
  const std::string variables = run_process(options).output;
  EXPECT_EQ(std::count(variables.begin(), variables.end(), '\n'), 2) << variables << "A and our own mark";
  EXPECT_TRUE(variables.starts_with("A=b\n")) << variables;
  ::unsetenv("RNMBAKE_TEST_OURS");
}

TEST(RunProcess, PassesNoFilesOn) {
  const int leak = ::open("/dev/zero", O_RDONLY);  // without O_CLOEXEC, as libraries open theirs
  ASSERT_GE(leak, 3);
  const std::string file = "/proc/self/fd/" + std::to_string(leak);
  EXPECT_EQ(run_process(sh("test -e " + file + " && echo open || echo closed")).output, "closed\n");
  ::close(leak);
}

TEST(RunProcess, EndsWhatUsesTooMuchMemory) {
  ProcessOptions options =
      sh("trap '' TERM; exec python3 -c 'b = []\nwhile True: b.append(b\"x\" * (1 << 24))'");
  options.memory_bytes = std::size_t{300} << 20;
  const ProcessResult result = run_process(options);
  EXPECT_EQ(result.ended_by, EndedBy::memory_limit);
  EXPECT_EQ(result.signal, SIGKILL) << "without a grace period: it would go on";
  EXPECT_GT(result.peak_bytes, options.memory_bytes);
  options = sh("sleep 0.3");
  options.memory_bytes = std::size_t{300} << 20;
  EXPECT_EQ(run_process(options).ended_by, EndedBy::itself);
}

TEST(RunProcess, WritesToAFile) {
  const TempFolder folder;
  ProcessOptions options = sh("echo out; echo err >&2");
  options.output = folder.path() / "log";
  EXPECT_EQ(run_process(options).output, "");
  EXPECT_EQ(read_text(options.output), "out\nerr\n");
}

TEST(RunProcess, SaysWhatCannotBeStarted) {
  ProcessOptions options;
  options.argv = {"/nowhere/blender"};
  try {
    run_process(options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::environment);
    EXPECT_STREQ(error.what(), "cannot start /nowhere/blender: No such file or directory");
  }
}

TEST(RunProcess, EndsWhatTakesTooLong) {
  ProcessOptions options = sh("sleep 60");
  options.total_seconds = 0.2;
  const ProcessResult result = run_process(options);
  EXPECT_EQ(result.ended_by, EndedBy::total_limit);
  EXPECT_EQ(result.signal, SIGTERM);
  EXPECT_LT(result.wall_seconds, 5);
}

TEST(RunProcess, KillsWhatIgnoresSigterm) {
  ProcessOptions options = sh("trap '' TERM; while :; do sleep 0.05; done");
  options.total_seconds = 0.2;
  const ProcessResult result = run_process(options);
  EXPECT_EQ(result.ended_by, EndedBy::total_limit);
  EXPECT_EQ(result.signal, SIGKILL);
  EXPECT_GE(result.wall_seconds, 0.5);
}

TEST(RunProcess, GrandchildrenEndToo) {
  const TempFolder folder;
  ProcessOptions options =
      sh("(trap '' TERM; sh -c 'echo $$ > grandchild; trap \"\" TERM; while :; do sleep 0.05; done' & wait) "
         "& sleep 60");
  options.folder = folder.path();
  options.total_seconds = 2;
  run_process(options);
  EXPECT_TRUE(is_gone_soon(number_in(folder.path() / "grandchild")));
}

TEST(RunProcess, NothingIsLeftBehindAfterANormalEnd) {
  const TempFolder folder;
  ProcessOptions options = sh("sleep 60 & echo $! > left");
  options.folder = folder.path();
  EXPECT_TRUE(run_process(options).succeeded());
  EXPECT_TRUE(is_gone_soon(number_in(folder.path() / "left")));
}

TEST(RunProcess, DescendantsThatLeaveTheGroupEndToo) {
  const TempFolder folder;
  ProcessOptions options = sh("setsid sh -c 'echo $$ > far; sleep 60' & sleep 60");
  options.folder = folder.path();
  options.total_seconds = 2;
  run_process(options);
  EXPECT_TRUE(is_gone_soon(number_in(folder.path() / "far")));
}

// The daemon's way out: a session of its own, a parent that ends at once, an environment without a mark or
// with it, a fork after each look.
TEST(RunProcess, DaemonsEndToo) {
  const TempFolder folder;
  ProcessOptions options =
      sh("setsid sh -c 'sleep 60 & echo $! > marked' & wait\n"
         "env -i setsid sh -c 'sleep 0.5; sleep 60 & echo $! > nameless' & sleep 0.3; echo $! > before; "
         "sleep 0.6");
  options.folder = folder.path();
  EXPECT_TRUE(run_process(options).succeeded());
  EXPECT_TRUE(is_gone(number_in(folder.path() / "marked")));
  EXPECT_TRUE(is_gone(number_in(folder.path() / "nameless"))) << "its parent was seen";
}

TEST(RunProcess, OrphansOfOthersAreLeftAlone) {
  const TempFolder folder;
  ProcessOptions slow = sh("setsid sh -c 'sleep 60 & echo $! > orphan' & wait; : > ready; read x < go");
  slow.folder = folder.path();
  ASSERT_EQ(::mkfifo((folder.path() / "go").c_str(), 0600), 0);
  std::thread other([&] { EXPECT_TRUE(run_process(slow).succeeded()); });
  for (int i = 0; i < 500 && !std::filesystem::exists(folder.path() / "ready"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  run_process(sh("setsid sh -c 'sleep 60 &' & wait"));
  EXPECT_FALSE(is_gone(number_in(folder.path() / "orphan")));
  std::ofstream(folder.path() / "go") << "go\n";
  other.join();
  EXPECT_TRUE(is_gone(number_in(folder.path() / "orphan")));
}

TEST(RunProcess, CpuTimeAndOutputAreNoProgress) {
  ProcessOptions options = sh("while :; do echo x; done");
  options.output = "/dev/null";
  options.stall_seconds = 1.2;
  const ProcessResult busy = run_process(options);
  EXPECT_EQ(busy.ended_by, EndedBy::stall);
  EXPECT_GE(busy.cpu_seconds, 1.1) << "it was given that much, however crowded the machine";
  options.argv = {"sleep", "60"};
  EXPECT_EQ(run_process(options).ended_by, EndedBy::stall);
  options.argv = {"sleep", "3"};
  EXPECT_TRUE(run_process(options, [](const ProcessStatus&) { return true; }).succeeded()) << "it progressed";
}

TEST(RunProcess, EndsWhatPrintsWithoutEnd) {
  ProcessOptions options = sh("while :; do echo 0123456789; done");
  options.output_bytes = 10000;
  EXPECT_EQ(run_process(options).ended_by, EndedBy::output_limit);
}

TEST(RunProcess, CountsTheTreesCpuTime) {
  // Ends by its own CPU time, so that a busy machine makes no difference.
  const ProcessResult result = run_process(sh("sh -c 'ulimit -t 1; while :; do :; done'; true"));
  EXPECT_GT(result.cpu_seconds, 0.9);
  EXPECT_LE(result.cpu_seconds, result.wall_seconds + 0.1);
  EXPECT_LT(run_process(sh("sleep 0.3")).cpu_seconds, 0.2);
}

TEST(RunProcess, PeakIsTheChildsNotOurs) {
  std::vector<char> ours(std::size_t{200} << 20, 1);  // resident while the child is forked
  const ProcessResult small = run_process(sh("sleep 0.3"));
  EXPECT_EQ(ours[std::size_t{100} << 20], 1);
  EXPECT_GT(small.peak_bytes, std::size_t{100} << 10);
  EXPECT_LT(small.peak_bytes, std::size_t{100} << 20);
  const ProcessResult large = run_process(sh("head -c 150m /dev/zero | tail -n 1 | sleep 0.5"));
  EXPECT_GT(large.peak_bytes, std::size_t{140} << 20);
}

TEST(RunProcess, AnExceptionOfTheTickEndsTheProcess) {
  const TempFolder folder;
  ProcessOptions options = sh("echo $$ > self; sleep 60");
  options.folder = folder.path();
  EXPECT_THROW(run_process(options,
                           [&](const ProcessStatus&) -> bool {
                             if (std::filesystem::exists(folder.path() / "self"))
                               throw std::runtime_error("enough");
                             return false;
                           }),
               std::runtime_error);
  EXPECT_TRUE(is_gone_soon(number_in(folder.path() / "self")));
}

TEST(StopRequest, EndsTheRunningProcess) {
  std::thread user([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    StopRequest::request(SIGINT);
  });
  const ProcessResult result = run_process(sh("sleep 60"));
  user.join();
  StopRequest::reset();
  EXPECT_EQ(result.ended_by, EndedBy::stop_request);
  EXPECT_LT(result.wall_seconds, 5);
}

/// Forks a program that runs a child which ignores SIGTERM; returns once that child runs.
pid_t start_driver(const std::filesystem::path& folder) {
  const pid_t driver = ::fork();
  if (driver == 0) {
    StopRequest::install();
    ProcessOptions options =
        sh("trap '' TERM; echo $$ > child.part; mv child.part child; while :; do sleep 0.05; done");
    options.folder = folder;
    options.grace_seconds = 60;
    run_process(options);
    ::_exit(StopRequest::requested() ? 128 + StopRequest::signal() : 0);
  }
  for (int i = 0; i < 500 && !std::filesystem::exists(folder / "child"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return driver;
}

TEST(StopRequest, TheSecondSignalKillsAtOnce) {
  const TempFolder folder;
  const pid_t driver = start_driver(folder.path());
  const pid_t child = number_in(folder.path() / "child");
  ::kill(driver, SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_FALSE(is_gone(driver)) << "the first signal is polite";
  ::kill(driver, SIGINT);
  int status = 0;
  ASSERT_EQ(::waitpid(driver, &status, 0), driver);
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_TRUE(is_gone_soon(child));
}

pid_t start_marked(const std::string& owner) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::setenv(launch_variable, (owner + "/0").c_str(), 1);
  ::execlp("sleep", "sleep", "60", nullptr);
  ::_exit(127);
}

TEST(LeftoverProcesses, EndWhereTheirOwnerIsGone) {
  const pid_t ours = start_marked(owner_word());
  const pid_t orphan = start_marked(owner_word() + '0');  // our number, but another start time
  for (int i = 0; i < 500 && !is_gone(orphan); ++i) {     // until exec has put the mark where others see it
    (void)end_leftover_processes();                       // counts what other tests left, too
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(is_gone(orphan));
  EXPECT_FALSE(is_gone(ours));
  ::kill(ours, SIGKILL);
  for (const pid_t child : {ours, orphan}) ::waitpid(child, nullptr, 0);
}

TEST(StopRequest, ChildrenDieWithUs) {
  const TempFolder folder;
  const pid_t driver = start_driver(folder.path());
  const pid_t child = number_in(folder.path() / "child");
  ::kill(driver, SIGKILL);
  ::waitpid(driver, nullptr, 0);
  EXPECT_TRUE(is_gone_soon(child));
}

}  // namespace
}  // namespace rnmbake
