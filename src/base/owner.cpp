#include "base/owner.h"

#include "base/hash.h"
#include "base/process_stat.h"

#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

namespace rnmbake {

namespace {

std::string first_line(const char* file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

/// Processes that do not see each other's numbers have different ones, e.g. two containers on one folder.
const std::string& host() {
  static const std::string word = [] {
    char name[256] = {};
    ::gethostname(name, sizeof name - 1);
    std::error_code none;
    const auto numbers = std::filesystem::read_symlink("/proc/self/ns/pid", none);
    return short_hash(first_line("/etc/machine-id") + '/' + name + '/' + numbers.string());
  }();
  return word;
}

const std::string& start_of_machine() {
  static const std::string word = short_hash(first_line("/proc/sys/kernel/random/boot_id"));
  return word;
}

std::string process_word(const std::string& number) {
  const auto stat = read_process_stat("/proc/" + number);
  if (!stat || stat->state == 'Z') return "";
  return fmt::format("{}-{:x}", number, stat->start_ticks);
}

std::vector<std::string> parts_of(std::string_view word) {
  std::vector<std::string> parts(1);
  for (const char c : word) {
    if (c == '-') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

}  // namespace

const std::string& owner_word() {
  static const std::string word =
      host() + '-' + start_of_machine() + '-' + process_word(std::to_string(::getpid()));
  return word;
}

bool owner_is_gone(std::string_view word) {
  const std::vector<std::string> parts = parts_of(word);
  if (parts.size() != 4 || parts[0] != host()) return false;
  if (parts[2].empty() || parts[2].find_first_not_of("0123456789") != std::string::npos) return false;
  return parts[1] != start_of_machine() || process_word(parts[2]) != parts[2] + '-' + parts[3];
}

}  // namespace rnmbake
