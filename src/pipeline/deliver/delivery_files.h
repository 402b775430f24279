// pipeline/deliver/delivery_files.h - the files of a delivery: made in a private folder, put in place
// together.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

class DeliveryFiles {
 public:
  static constexpr const char* record_name = "lightmaps.json";

  /// `making`: an empty folder of this run's own. `folder`: where the files are to be in the end.
  DeliveryFiles(std::filesystem::path making, std::filesystem::path folder)
      : making_(std::move(making)), folder_(std::move(folder)) {}

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  /// Where a file of that name is to be made.
  [[nodiscard]] std::filesystem::path add(const std::string& name);
  void add(const std::string& name, std::string_view text);

  /// Where a file that was added lies until it is put in place.
  [[nodiscard]] std::filesystem::path made(const std::string& name) const { return making_ / name; }

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

  /// Puts all files into the folder, `record` last, whose "files" names them; removes those that an earlier
  /// record of the folder names and this one does not. Files with the same bytes keep their time. Returns how
  /// many were written. Throws Error(io).
  std::size_t put_in_place(nlohmann::ordered_json record);

 private:
  std::filesystem::path making_, folder_;
  std::vector<std::string> names_;
};

}  // namespace rnmbake
