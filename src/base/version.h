// base/version.h - the program's version; its home is project() in CMakeLists.txt.
#pragma once

namespace rnmbake {

inline constexpr const char* version = RNMBAKE_VERSION;

}  // namespace rnmbake
