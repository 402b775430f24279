// config/document.h - the settings as text: what is in force, and the reference for readers.
#pragma once

#include "config/resolve.h"

#include <string>

namespace rnmbake {

/// A project file that gives the same settings, those that the purpose has a use for, each line with where
/// its value came from.
[[nodiscard]] std::string print_config(const ResolvedConfig& config, Purpose purpose = Purpose::bake);

/// The tables of docs/project-file.md, in Markdown.
[[nodiscard]] std::string settings_reference();

/// One setting for --help: its help, range or choices, unit, default.
[[nodiscard]] std::string help_text(const Setting& setting);

}  // namespace rnmbake
