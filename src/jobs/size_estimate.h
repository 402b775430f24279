// jobs/size_estimate.h - bytes of a store as far as known without counting them again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace rnmbake {

/// The number that processes share in the file `size` of the store's folder. Nobody locks it: what two
/// processes add at one moment may be lost, and what a process that is killed had not told yet, so it holds
/// for an hour, then the store is to be counted again.
class SizeEstimate {
 public:
  static constexpr const char* file_name = "size";

  explicit SizeEstimate(std::filesystem::path folder, std::int64_t limit);

  /// With what this process added; nothing where nobody has counted within the last hour.
  [[nodiscard]] std::optional<std::int64_t> bytes() const;

  /// Something was put into the store. Others hear of it once it is 1/64 of the limit, or by flush().
  void add(std::int64_t bytes);
  void flush();

  /// All of the store was counted.
  void set(std::int64_t bytes);

 private:
  std::filesystem::path folder_;
  std::int64_t limit_;
  std::int64_t added_ = 0;  // by this process and not in the file
};

}  // namespace rnmbake
