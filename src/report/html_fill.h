// report/html_fill.h - an embedded page with its places filled in. Private to the report room.
#pragma once

#include "report/html_parts.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// Text for an element or an attribute.
[[nodiscard]] std::string escaped(std::string_view text);

/// JSON that may stand within <script>: no text of it can end the element or begin a comment.
[[nodiscard]] std::string for_script(const nlohmann::ordered_json& document);

/// The page with each {{name}} replaced, once: {{name}} in a replacement stays.
[[nodiscard]] std::string filled(std::string_view page,
                                 const std::vector<std::pair<std::string, std::string>>& parts);

/// The head of a page, to be filled in as {{head}}. `images`: what the page's policy adds for pictures, with
/// "; " at its end, or "".
[[nodiscard]] std::string page_head(std::string_view title, const std::string& images);

/// Text of all embedded files whose names end so, in their order.
[[nodiscard]] std::string embedded_files(const EmbeddedFiles& files, std::string_view ending);

/// Numbers stay on one line with their sign.
[[nodiscard]] std::string unbroken(std::string text);

}  // namespace rnmbake
