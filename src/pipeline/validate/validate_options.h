// pipeline/validate/validate_options.h - options of a validation beside the settings.
#pragma once

#include <string>
#include <vector>

namespace rnmbake {

struct ValidateOptions {
  std::vector<std::string> decompose{"*"};  // objects (glob patterns) that the published recipe bakes too
  bool split_study = false;
  int view = 480;     // pixels along the longer side of the camera's view in the report; 0: none
  int probes = 0;     // light probes in a box around the scene, by Blender and by the reference
  bool anew = false;  // nothing that was kept is used
};

}  // namespace rnmbake
