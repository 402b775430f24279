#include "cli/ssbump/ssbump_tools.h"

namespace rnmbake {

std::vector<std::function<std::function<int()>(CLI::App& ssbump)>> ssbump_tools() {
  return {add_ssbump_info, add_ssbump_to_normal, add_ssbump_from_normal,   add_ssbump_combine,
          add_ssbump_flip, add_ssbump_mip,       add_ssbump_compress_check};
}

}  // namespace rnmbake
