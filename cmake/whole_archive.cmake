# limen_link_whole(TARGET): programs that link static library TARGET, directly or not, take all its objects. Needed where
# objects register themselves (scenes, techniques, metrics, embedded shaders) and no symbol asks for them.
function(limen_link_whole target)
  target_link_options(${target} INTERFACE "LINKER:--whole-archive,$<TARGET_FILE:${target}>,--no-whole-archive")
endfunction()
