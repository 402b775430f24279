// report/html_parts.h - the report's page, styles and scripts: src/report/html/, embedded by the build.
#pragma once

#include <utility>
#include <vector>

namespace rnmbake {

/// Generated at build time by cmake/Embed.cmake: page.html, where {{title}}, {{style}}, {{script}} and others
/// stand to be filled in, style.css, and the scripts in the order in which the page runs them.
const std::vector<std::pair<const char*, const char*>>& embedded_report();

}  // namespace rnmbake
