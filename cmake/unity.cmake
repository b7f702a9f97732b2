# Several sources compiled as one file, which saves half of the time: what they instantiate is instantiated once. The
# preset without it (debug) finds sources that lean on an include or a name of a neighbour.

# Targets whose files repeat names.
set(limen_separate_targets limen_metrics_cpu limen_ui)
# Files that share a name of their own with a neighbour, and may.
set(limen_separate_files
    analysis/statistics/log_math.cpp analysis/psychometric/objective.cpp
    analysis/study/scenario_spread.cpp analysis/sweep/switch_distances.cpp experiments/expectation_reader.cpp
    perception/popping/gpu/regions_gpu.cpp perception/popping/weights_gpu.cpp
    perception/threshold_maps/threshold_tables.cpp perception/vision/csf.cpp perception/vision/csf_models.cpp
    perception/vision/spatial_csfs.cpp study/application/page_view.cpp
    study/observers/true_threshold.cpp study/procedures/quest.cpp study/procedures/staircase.cpp
    tests/perception/pixel_errors_test.cpp tests/perception/popping_test.cpp tests/perception/shadow_defects_test.cpp
    tests/perception/ssim_test.cpp tests/perception/vision_display_test.cpp tests/perception/vision_response_test.cpp
    tests/study/observers/observer_test.cpp)

# limen_unity(FOLDER): for the targets below FOLDER. Called once every folder has been read.
function(limen_unity folder)
  # Larger groups in what the first `./limen sweep` compiles: 40 CPU seconds less of 315.
  set(size 8)
  cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE place)
  if(place MATCHES "^(experiments|renderer|perception)")
    set(size 16)
  endif()
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(NOT type MATCHES "^(STATIC_LIBRARY|EXECUTABLE)$" OR target IN_LIST limen_separate_targets)
      continue()
    endif()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${size})
    get_target_property(sources ${target} SOURCES)
    foreach(source IN LISTS sources)
      cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder} NORMALIZE OUTPUT_VARIABLE file)
      cmake_path(RELATIVE_PATH file BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE name)
      if(name IN_LIST limen_separate_files)
        set_source_files_properties(${file} TARGET_DIRECTORY ${target} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      endif()
    endforeach()
  endforeach()
  get_property(children DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(child IN LISTS children)
    limen_unity(${child})
  endforeach()
endfunction()
