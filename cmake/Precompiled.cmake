# Precompiled headers: what most files include anyway, read once for all rooms of the same flags. Files still include what they
# use; `./dev lint` compiles them without (preset tidy).
set(RNM_COMMON_HEADERS <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <string>
                       <string_view> <utility> <vector> <Imath/ImathMatrix.h> <Imath/ImathVec.h> <spdlog/fmt/fmt.h>)

# rnm_precompile(OWNER HEADERS headers... FOR targets...) - OWNER's headers, for it and for targets with the very same flags.
function(rnm_precompile OWNER)
  cmake_parse_arguments(PRECOMPILED "" "" "HEADERS;FOR" ${ARGN})
  target_precompile_headers(${OWNER} PRIVATE ${RNM_COMMON_HEADERS} ${PRECOMPILED_HEADERS})
  foreach(TARGET IN LISTS PRECOMPILED_FOR)
    target_precompile_headers(${TARGET} REUSE_FROM ${OWNER})
  endforeach()
endfunction()
