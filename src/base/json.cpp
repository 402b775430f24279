#include "base/json.h"

#include "base/error.h"
#include "base/text.h"

namespace rnmbake {
namespace {

using nlohmann::json;

constexpr std::size_t shown_text = 60, shown_problem = 160;

/// Brackets that are open at once, at most; those in texts do not count.
bool is_too_deep(std::string_view text) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') in_text = !in_text;
    if (in_text) {
      i += c == '\\' ? 1 : 0;  // what it escapes may be a quote
      continue;
    }
    if ((c == '[' || c == '{') && ++depth > deepest_json) return true;
    if (c == ']' || c == '}') --depth;
  }
  return false;
}

}  // namespace

json parse_json(std::string_view text, const std::string& name) {
  if (is_too_deep(text)) {
    fail(ExitCode::invalid_input, "{}: lists nest deeper than {} levels, which rnmbake never writes", name,
         deepest_json);
  }
  try {
    return json::parse(text);
  } catch (const json::exception& problem) {
    fail(ExitCode::invalid_input, "{}: not JSON: {}", name, brief(problem));
  }
}

json json_or_null(std::string_view text) {
  if (is_too_deep(text)) return nullptr;
  json value = json::parse(text, nullptr, false);
  return value.is_discarded() ? json() : value;
}

std::string brief(const json& value) {
  if (const auto* text = value.get_ptr<const json::string_t*>())
    return fmt::format("'{}'", shortened(*text, shown_text));
  if (value.is_array()) return fmt::format("a list of {}", value.size());
  if (value.is_object()) return fmt::format("an object of {}", value.size());
  return value.dump();
}

std::string brief(const json::exception& problem) {
  return shortened(problem.what(), shown_problem);
}

}  // namespace rnmbake
