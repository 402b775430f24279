#include "jobs/key.h"

#include "base/hash.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {

KeyMaker& KeyMaker::add(std::string_view name, std::string_view value) {
  text_ += fmt::format("{}:{}={}:{}\n", name.size(), name, value.size(), value);
  return *this;
}

KeyMaker& KeyMaker::add(std::string_view name, std::int64_t value) {
  return add(name, std::string_view(std::to_string(value)));
}

KeyMaker& KeyMaker::add(std::string_view name, double value) {
  return add(name, std::string_view(fmt::format("{:016x}", std::bit_cast<std::uint64_t>(value))));
}

KeyMaker& KeyMaker::add(std::string_view name, const ResultKey& other) {
  return add(name, std::string_view(other.kind + "/" + other.digits));
}

bool is_result_kind(std::string_view kind) {
  const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || c == '-'; };
  return !kind.empty() && kind.size() <= 16 && kind.front() != '-' &&
         std::all_of(kind.begin(), kind.end(), fits);
}

ResultKey KeyMaker::make(std::string_view kind) const {
  if (!is_result_kind(kind)) throw std::invalid_argument("no kind of result: " + std::string(kind));
  return {std::string(kind), hash128_hex(text_)};
}

}  // namespace rnmbake
