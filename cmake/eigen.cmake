# limen_eigen(TARGET): for what uses Eigen. With sanitizers Eigen allocates in a way of its own, but Ceres, which is built without them,
# exports the same functions the usual way, and memory of the one reaches the other. malloc() aligns well enough for both.
function(limen_eigen target)
  if(LIMEN_SANITIZE)
    target_compile_definitions(${target} PRIVATE EIGEN_MALLOC_ALREADY_ALIGNED=1)
  endif()
endfunction()
