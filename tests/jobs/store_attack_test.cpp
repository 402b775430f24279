// Several processes put into, read, trim and verify one store while they are killed.
#include "jobs/store_cases.h"
#include "jobs/upkeep.h"

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

constexpr const char* folder_variable = "STORE_ATTACK_FOLDER";
constexpr std::int64_t attack_limit = 300'000;
constexpr int attack_results = 200;

std::string attack_bytes(int number) {
  std::string bytes(std::size_t(100 + number * 37 % 5000), '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 31 + std::size_t(number));
  return bytes;
}

/// Until it is killed. Ends by itself where something is wrong: 1: other bytes than were put, 2: damage.
[[noreturn]] void attack(const fs::path& folder) {
  std::mt19937 random{static_cast<unsigned>(::getpid())};
  Store store(folder, attack_limit);
  for (int round = 1;; ++round) {
    const int number = static_cast<int>(random() % attack_results);
    const ResultKey key = pass_key(number);
    if (const auto bytes = store.get(key)) {
      if (*bytes != attack_bytes(number)) ::_exit(1);
    } else {
      store.put(key, attack_bytes(number));
    }
    if (round % 17 == 0) trim_store(folder, {attack_limit / 2, {}});
    if (round % 31 == 0 && verify_store(folder).damaged > 0) ::_exit(2);
    if (round % 41 == 0) store.remove(pass_key(static_cast<int>(random() % attack_results)));
  }
}

/// This program, started again by the test below, is one of the attackers: a process of its own, not a fork
/// of one that lives on.
const bool is_test = [] {
  if (const char* folder = std::getenv(folder_variable); folder != nullptr) attack(folder);
  return true;
}();

pid_t start_attacker(const fs::path& folder) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::setenv(folder_variable, folder.c_str(), 1);
    ::execl("/proc/self/exe", "attacker", static_cast<char*>(nullptr));
    ::_exit(127);
  }
  return child;
}

TEST_F(StoreCase, OutlivesProcessesThatAreKilled) {
  ASSERT_TRUE(is_test);
  std::mt19937 random{7};
  std::array<pid_t, 2> attackers{start_attacker(cache()), start_attacker(cache())};
  std::size_t left_behind = 0;
  for (int kills = 0; kills < 50; ++kills) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + random() % 60));
    pid_t& one = attackers[std::size_t(kills) % 2];
    ::kill(one, SIGKILL);
    int status = 0;
    ::waitpid(one, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "an attacker gave up: " << WEXITSTATUS(status);
    left_behind = std::max(left_behind, list_store(cache()).temporary.size());
    one = start_attacker(cache());
  }
  for (const pid_t one : attackers) {
    ::kill(one, SIGKILL);
    ::waitpid(one, nullptr, 0);
  }
  RecordProperty("temporary_files_seen", static_cast<int>(left_behind));
  const VerifyCounts counts = verify_store(cache());
  EXPECT_EQ(counts.damaged, 0U);
  EXPECT_TRUE(counts.unreadable.empty());
  EXPECT_GT(counts.whole, 0U);
  EXPECT_TRUE(list_store(cache()).temporary.empty()) << "what the dead left is swept";
  EXPECT_EQ(list_store(cache()).others, 0U);
  // What each of the killed had put and not told is missing from the estimate, so that the limit may be
  // passed now, but not once the store is counted again.
  Store store(cache(), attack_limit);
  fs::remove(cache() / SizeEstimate::file_name);  // as after an hour
  store.put(pass_key(attack_results), "one more");
  EXPECT_TRUE(store.has(pass_key(attack_results)));
  EXPECT_LE(list_store(cache()).bytes, attack_limit);
  for (int i = 0; i < attack_results; ++i) {
    EXPECT_EQ(store.get(pass_key(i)).value_or(attack_bytes(i)), attack_bytes(i));
  }
}

}  // namespace
}  // namespace rnmbake
