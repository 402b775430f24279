// base/text_table.h - columns for a terminal.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace rnmbake {

/// Columns as wide as their widest cell, two blanks between them; cells come out as printable() makes them.
class TextTable {
 public:
  using Row = std::vector<std::string>;
  void add(Row row);
  void write(std::ostream& out) const;
  /// The first row is the header; columns after the first are aligned to the right.
  void write_markdown(std::ostream& out) const;

 private:
  std::vector<Row> rows_;
};

}  // namespace rnmbake
