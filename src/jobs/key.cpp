#include "jobs/key.h"

#include "base/hash.h"

#include <bit>

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

ResultKey KeyMaker::make(std::string_view kind) const {
  return {std::string(kind), hash128_hex(text_)};
}

}  // namespace rnmbake
