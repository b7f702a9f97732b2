# Headers that are read once and not in every file: what nearly all of Limen includes, none of its own, so that no change
# of Limen makes everything compile again. Sources still name every header that they use; the presets that
# leave this off (debug, and clang for groups of sources) find those that do not.
set(limen_headers
    <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory> <optional> <set> <sstream>
    <string> <vector> <nlohmann/json.hpp>)

# limen_header_library(TARGET HEADERS...): an empty library with the common headers and HEADERS precompiled. It links no
# more than those need: what is defined for it must be defined for whoever reuses them.
function(limen_header_library target)
  add_library(${target} STATIC ${PROJECT_SOURCE_DIR}/cmake/headers_only.cpp)
  target_link_libraries(${target} PRIVATE limen_options)
  target_precompile_headers(${target} PRIVATE ${limen_headers} ${ARGN})
endfunction()

# limen_precompile(FOLDER): the targets below FOLDER that compile something and have no precompiled headers yet take those
# of limen_common_headers, or of limen_command_headers if they are compiled with its options. Called once every folder has been read.
function(limen_precompile folder)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    get_target_property(own ${target} PRECOMPILE_HEADERS)
    get_target_property(taken ${target} PRECOMPILE_HEADERS_REUSE_FROM)
    if(type MATCHES "^(STATIC_LIBRARY|EXECUTABLE)$" AND NOT own AND NOT taken)
      get_target_property(command ${target} LIMEN_COMMAND_CODE)
      if(command)
        target_precompile_headers(${target} REUSE_FROM limen_command_headers)
      else()
        target_precompile_headers(${target} REUSE_FROM limen_common_headers)
      endif()
    endif()
  endforeach()
  get_property(children DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(child IN LISTS children)
    limen_precompile(${child})
  endforeach()
endfunction()
