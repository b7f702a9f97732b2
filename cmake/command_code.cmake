# limen_command_code(TARGET): TARGET reads options and files and prints. Instantiating CLI11 and JSON takes most of its compile time;
# with -Og it takes half of what it takes with -O2, and nothing in it runs long enough to notice. GCC optimises by the options of the
# precompiled headers, whatever those of the file are, so that such targets have precompiled headers of their own
# (cmake/precompiled.cmake).
function(limen_command_code target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-Og>)
  set_target_properties(${target} PROPERTIES LIMEN_COMMAND_CODE ON)
endfunction()
