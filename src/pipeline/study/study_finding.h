// pipeline/study/study_finding.h - what a table of errors says about the Half-Life 2 basis, in words.
#pragma once

#include "pipeline/study/encoding_study.h"

#include <string>
#include <vector>

namespace rnmbake {

/// Where Source's RNM (rnm-vrad) should give way to another encoding that takes no more bakes and no more
/// bytes: from which tilt on, to which, and by how much. "" where RNM was not studied.
[[nodiscard]] std::string rnm_finding(const std::vector<EncodingErrors>& errors);

}  // namespace rnmbake
