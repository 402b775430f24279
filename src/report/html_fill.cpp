#include "report/html_fill.h"

#include <algorithm>

namespace rnmbake {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string for_script(const nlohmann::ordered_json& document) {
  const std::string text = document.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string out;
  for (const char c : text) out += c == '<' ? "\\u003c" : std::string(1, c);
  return out;
}

std::string filled(std::string_view page, const std::vector<std::pair<std::string, std::string>>& parts) {
  std::string out;
  for (std::size_t at = 0; at < page.size();) {
    const std::size_t open = std::min(page.find("{{", at), page.size());
    out += page.substr(at, open - at);
    if (open == page.size()) break;
    const std::size_t close = page.find("}}", open);
    const std::string_view name = page.substr(open + 2, close - open - 2);
    const auto part = std::ranges::find(parts, name, &std::pair<std::string, std::string>::first);
    if (part != parts.end()) out += part->second;
    at = close + 2;
  }
  return out;
}

std::string embedded_files(const EmbeddedFiles& files, std::string_view ending) {
  std::string text;
  for (const auto& [name, content] : files) {
    if (std::string_view(name).ends_with(ending)) text += content;
  }
  return text;
}

std::string page_head(std::string_view title, const std::string& images) {
  return filled(
      embedded_files(embedded_report(), "head.html"),
      {{"title", escaped(title)}, {"images", images}, {"style", embedded_files(embedded_report(), ".css")}});
}

std::string unbroken(std::string text) {
  for (auto at = text.find(" %"); at != std::string::npos; at = text.find(" %", at))
    text.replace(at, 1, "\u00a0");
  return text;
}

}  // namespace rnmbake
