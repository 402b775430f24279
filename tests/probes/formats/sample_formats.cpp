// Writes volumes with a known light in a format, for formats_check.py and threejs_check.py.
//   sample_formats FORMAT FOLDER boxes|all
#include "probes/formats/formats.h"
#include "probes/formats/sample_volumes.h"

#include <exception>
#include <iostream>

int main(int count, char** arguments) try {
  if (count != 4) return 1;
  std::vector<rnmbake::ProbeVolume> volumes = rnmbake::sample_boxes();
  if (std::string(arguments[3]) == "all") volumes.push_back(rnmbake::sample_points());
  rnmbake::write_probe_format(arguments[1], volumes, arguments[2]);
  return 0;
} catch (const std::exception& problem) {
  std::cerr << problem.what() << "\n";
  return 2;
}
