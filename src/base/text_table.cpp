#include "base/text_table.h"

#include "base/text.h"

#include <algorithm>
#include <ostream>

namespace rnmbake {
namespace {

/// Characters of UTF-8, which is near enough to what a terminal shows.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

}  // namespace

void TextTable::add(Row row) {
  for (std::string& cell : row) cell = printable(cell);
  rows_.push_back(std::move(row));
}

void TextTable::write(std::ostream& out) const {
  std::vector<std::size_t> widths;
  for (const Row& row : rows_) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  }
  for (const Row& row : rows_) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += row[i] + std::string(widths[i] - width(row[i]) + 2, ' ');
    out << line.substr(0, line.find_last_not_of(' ') + 1) << '\n';
  }
}

void TextTable::write_markdown(std::ostream& out) const {
  for (const Row& row : rows_) {
    for (const std::string& cell : row) out << "| " << cell << ' ';
    out << "|\n";
    if (&row != &rows_.front()) continue;
    for (std::size_t i = 0; i < row.size(); ++i) out << (i == 0 ? "|---" : "|---:");
    out << "|\n";
  }
}

}  // namespace rnmbake
