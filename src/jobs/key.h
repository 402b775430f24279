// jobs/key.h - names of results by what they were made from.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

namespace rnmbake {

/// Name of a result: its kind ("survey", "pass") and 128 bits of hash over
/// everything that it depends on, as 32 hexadecimal digits.
struct ResultKey {
  std::string kind, digits;
  auto operator<=>(const ResultKey&) const = default;
};

/// Whether it may be a ResultKey's kind: at most 16 of a to z and dashes, the first one no dash.
[[nodiscard]] bool is_result_kind(std::string_view kind);

/// Collects what a result depends on: names with values, in the order in which they are added. Never paths of
/// this machine, command lines, or times.
class KeyMaker {
 public:
  KeyMaker& add(std::string_view name, std::string_view value);
  KeyMaker& add(std::string_view name, std::int64_t value);
  /// The bits of the number.
  KeyMaker& add(std::string_view name, double value);
  KeyMaker& add(std::string_view name, const ResultKey& other);

  /// Throws std::invalid_argument where it is no kind.
  [[nodiscard]] ResultKey make(std::string_view kind) const;

 private:
  std::string text_;  // lengths stand before names and values, so that no two lists are alike
};

}  // namespace rnmbake
