// report/html_parts.h - the report's page, styles and scripts: src/report/html/, embedded by the build.
#pragma once

namespace rnmbake {

/// Where {{title}}, {{finding}}, {{style}}, {{report}}, {{maps}} and {{script}} stand to be filled in.
extern const char* const html_page;
extern const char* const html_style;
extern const char* const html_script;

}  // namespace rnmbake
