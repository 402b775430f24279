#include "jobs/size_estimate.h"

#include "base/error.h"
#include "base/files.h"

#include <chrono>
#include <fstream>
#include <utility>

namespace rnmbake {

namespace fs = std::filesystem;

namespace {

constexpr std::int64_t seconds_valid = 60 * 60;

struct Count {
  std::int64_t bytes = 0, counted = 0;  // seconds since 1970
};

std::int64_t seconds_now() {
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std::optional<Count> read_count(const fs::path& file) {
  std::ifstream stream(file);
  Count count;
  if (!(stream >> count.bytes >> count.counted) || count.bytes < 0) return std::nullopt;
  const std::int64_t age = seconds_now() - count.counted;
  if (age > seconds_valid || age < -seconds_valid) return std::nullopt;
  return count;
}

/// Gives up silently: the store is counted again then.
void write_count(const fs::path& file, const Count& count) {
  try {
    write_atomically(file, fmt::format("{} {}\n", count.bytes, count.counted));
  } catch (const Error&) {
  }
}

}  // namespace

SizeEstimate::SizeEstimate(fs::path folder, std::int64_t limit) : folder_(std::move(folder)), limit_(limit) {}

std::optional<std::int64_t> SizeEstimate::bytes() const {
  const auto count = read_count(folder_ / file_name);
  if (!count) return std::nullopt;
  return count->bytes + added_;
}

void SizeEstimate::add(std::int64_t bytes) {
  added_ += bytes;
  if (added_ > limit_ / 64) flush();
}

void SizeEstimate::flush() {
  if (added_ == 0) return;
  const auto count = read_count(folder_ / file_name);
  if (count) write_count(folder_ / file_name, {count->bytes + added_, count->counted});
  added_ = 0;
}

void SizeEstimate::set(std::int64_t bytes) {
  added_ = 0;
  write_count(folder_ / file_name, {bytes, seconds_now()});
}

}  // namespace rnmbake
