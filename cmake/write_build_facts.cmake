# Writes OUT, a header with the commit of SOURCE and what the build is made of; unchanged facts leave the file alone,
# so that nothing is compiled again.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=40 --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE result)
if(NOT result EQUAL 0 OR commit STREQUAL "")
  set(commit "unknown")
endif()
set(text "// Written by the build.
#pragma once

namespace limen::generated {

inline constexpr const char* kCommit = \"${commit}\";
inline constexpr const char* kProjectVersion = \"${VERSION}\";
inline constexpr const char* kBuildType = \"${BUILD_TYPE}\";

}  // namespace limen::generated
")
set(old "")
if(EXISTS ${OUT})
  file(READ ${OUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUT} "${text}")
endif()
