# limen_embed_text(TARGET SYMBOL FILE): makes the text of FILE part of TARGET as
# `extern const char* const limen::embedded::SYMBOL`.
function(limen_embed_text target symbol file)
  set(source ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${target}_${symbol}.cpp)
  add_custom_command(
    OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DSYMBOL=${symbol} -DFILE=${source} -P
            ${PROJECT_SOURCE_DIR}/cmake/write_embedded_text.cmake
    DEPENDS ${source} ${PROJECT_SOURCE_DIR}/cmake/write_embedded_text.cmake
    VERBATIM)
  set_source_files_properties(${out} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
  target_sources(${target} PRIVATE ${out})
endfunction()
