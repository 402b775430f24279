// report/html_parts.h - the report's page, styles and scripts: src/report/html/, embedded by the build.
#pragma once

#include <utility>
#include <vector>

namespace rnmbake {

using EmbeddedFiles = std::vector<std::pair<const char*, const char*>>;  // name, text

/// Generated at build time by cmake/Embed.cmake: head.html and page.html, where {{title}}, {{style}},
/// {{script}} and others stand to be filled in, style.css, and the scripts in the order in which the page
/// runs them.
const EmbeddedFiles& embedded_report();

/// study.html and study.js, which take head.html, style.css, format.js and charts.js from the report.
const EmbeddedFiles& embedded_study();

}  // namespace rnmbake
