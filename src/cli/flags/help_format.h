// cli/flags/help_format.h - layout of --help: two columns, wrapped, --[no-]flag for switches.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace rnmbake {

class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat() { column_width(left_column); }
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;

 private:
  static constexpr std::size_t left_column = 30, columns = 100;
};

/// Breaks `text` between words so that no line is longer than `width`, unless one word is.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t width);

}  // namespace rnmbake
