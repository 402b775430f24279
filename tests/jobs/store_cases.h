// tests/jobs/store_cases.h - a store in a folder of its own, and ways to harm it.
#pragma once

#include "base/files.h"
#include "jobs/store.h"
#include "jobs/store_folder.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

namespace rnmbake {

inline ResultKey pass_key(int number) {
  return KeyMaker().add("number", std::int64_t{number}).make("pass");
}

inline void write_file(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

inline void set_used(const std::filesystem::path& file, std::chrono::hours ago) {
  std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now() - ago);
}

inline std::chrono::hours age_of(const std::filesystem::path& file) {
  return std::chrono::duration_cast<std::chrono::hours>(std::filesystem::file_time_type::clock::now() -
                                                        std::filesystem::last_write_time(file));
}

/// What is logged while it lives.
class Said {
 public:
  Said() { testing::internal::CaptureStderr(); }
  ~Said() {
    if (!taken_) (void)take();
  }
  Said(const Said&) = delete;
  Said& operator=(const Said&) = delete;
  std::string take() {
    taken_ = true;
    return testing::internal::GetCapturedStderr();
  }

 private:
  bool taken_ = false;
};

inline std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

class StoreCase : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path cache() const { return temp_.path() / "cache"; }
  [[nodiscard]] std::filesystem::path file(const ResultKey& key) const { return entry_path(cache(), key); }
  /// Of `count` results of `bytes` bytes each, with their headers.
  [[nodiscard]] static std::int64_t total(int count, int bytes) {
    return count * (std::int64_t{bytes} + 100);
  }

  TempFolder temp_;
};

}  // namespace rnmbake
