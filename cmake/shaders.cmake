# limen_shaders(TARGET FILE...): makes the shader files known to the program builder under their path from the
# repository root. With LIMEN_EMBED_SHADERS they become part of TARGET; otherwise they are read from the source tree
# at run time, so that a changed shader needs no build. May be called several times for one target.
function(limen_shaders target)
  if(NOT LIMEN_EMBED_SHADERS)
    return()
  endif()
  set(files)
  foreach(file IN LISTS ARGN)
    list(APPEND files ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  endforeach()
  get_target_property(calls ${target} LIMEN_SHADER_CALLS)
  if(NOT calls)
    set(calls 0)
  endif()
  math(EXPR calls "${calls} + 1")
  set_target_properties(${target} PROPERTIES LIMEN_SHADER_CALLS ${calls})
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${target}_shaders_${calls}.cpp)
  list(JOIN files "|" joined)
  add_custom_command(
    OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DROOT=${PROJECT_SOURCE_DIR} "-DFILES=${joined}" -P
            ${PROJECT_SOURCE_DIR}/cmake/embed_shaders.cmake
    DEPENDS ${files} ${PROJECT_SOURCE_DIR}/cmake/embed_shaders.cmake
    VERBATIM)
  set_source_files_properties(${out} PROPERTIES SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
  target_sources(${target} PRIVATE ${out})
endfunction()

# limen_technique(TARGET NAME): a technique in the usual form, NAME/NAME.cpp with NAME/NAME.comp.glsl beside it.
function(limen_technique target name)
  target_sources(${target} PRIVATE ${name}/${name}.cpp)
  limen_shaders(${target} ${name}/${name}.comp.glsl)
endfunction()
