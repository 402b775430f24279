// base/json.h - JSON that others wrote: read without trust, quoted in messages without repeating it.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// What rnmbake writes nests less than ten levels deep. Copying or printing a value takes stack for each.
constexpr int deepest_json = 64;

/// Throws Error(invalid_input) that begins with `name` where it is no JSON, or nests deeper.
nlohmann::json parse_json(std::string_view text, const std::string& name);

/// The same; null where parse_json() throws.
nlohmann::json json_or_null(std::string_view text);

/// A value as a message may show it: "7", "'text'", "a list of 3". Short whatever it holds.
std::string brief(const nlohmann::json& value);

/// What went wrong in the reading of a value, short. The library's own words repeat what it read last.
std::string brief(const nlohmann::json::exception& problem);

}  // namespace rnmbake
