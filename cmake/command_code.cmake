# limen_command_code(TARGET): TARGET reads options and prints. Instantiating CLI11 takes most of its compile time, and a
# third less with -O1; nothing in it runs long enough to notice.
function(limen_command_code target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()
