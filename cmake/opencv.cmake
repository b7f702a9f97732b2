# The parts of OpenCV that Limen uses, as targets limen_opencv_PART. Debian ships OpenCV's own CMake package only with
# libopencv-dev, which pulls in Qt, VTK and Java.
include_guard(GLOBAL)

find_path(LIMEN_OPENCV_INCLUDE opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)

# limen_opencv(PART...): core, imgproc, video, videoio
function(limen_opencv)
  foreach(part ${ARGN})
    if(TARGET limen_opencv_${part})
      continue()
    endif()
    find_library(LIMEN_OPENCV_${part} opencv_${part} REQUIRED)
    mark_as_advanced(LIMEN_OPENCV_${part})
    add_library(limen_opencv_${part} UNKNOWN IMPORTED GLOBAL)
    set_target_properties(
      limen_opencv_${part} PROPERTIES IMPORTED_LOCATION ${LIMEN_OPENCV_${part}} INTERFACE_INCLUDE_DIRECTORIES
                                                                                ${LIMEN_OPENCV_INCLUDE})
  endforeach()
endfunction()
