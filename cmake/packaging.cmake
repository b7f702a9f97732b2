# What `cmake --install` and `cpack` make of a build: programs that need no source tree. PREFIX/lib/limen has programs and
# the modules that they load, PREFIX/share/limen the files that they read, laid out like the source tree.
set(programs limen-sweep limen-view limen-perceive limen-study limen-analyse limen-report limen-export)
set(modules limen_image_codec limen_image_analysis_opencv limen_video_codec)

if(NOT LIMEN_EMBED_SHADERS)
  install(CODE "message(FATAL_ERROR \"These programs read their shaders from the source tree. Install those of a build \"
                \"with LIMEN_EMBED_SHADERS=ON, such as the preset release.\")")
endif()
install(TARGETS ${programs} limen_import_mesh RUNTIME DESTINATION lib/limen)
install(TARGETS ${modules} LIBRARY DESTINATION lib/limen)
install(PROGRAMS limen DESTINATION bin)
install(FILES experiments/features.yaml DESTINATION share/limen/experiments)
install(DIRECTORY experiments/descriptors DESTINATION share/limen/experiments)
install(DIRECTORY study/protocols study/words study/examples DESTINATION share/limen/study)
install(FILES cmake/packaging/limen.bash RENAME limen DESTINATION share/bash-completion/completions)
install(FILES cmake/packaging/_limen DESTINATION share/zsh/vendor-completions)
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION share/doc/limen)
install(DIRECTORY docs DESTINATION share/doc/limen)
install(FILES LICENSE RENAME copyright DESTINATION share/doc/limen)

# Pages for `man limen` and `man limen-sweep`, made by help2man from what the installed programs say of themselves.
install(CODE "set(programs \"${programs}\")\nset(source \"${PROJECT_SOURCE_DIR}\")\nset(version \"${PROJECT_VERSION}\")")
install(SCRIPT cmake/packaging/manual_pages.cmake)

# Libraries are found by dpkg-shlibdeps; what programs start or load by name is what packages.txt lists for running.
set(depends "")
file(STRINGS packages.txt lines REGEX "^[^#]")
foreach(line IN LISTS lines)
  if(line MATCHES "^([^ ]+) +run ")
    list(APPEND depends ${CMAKE_MATCH_1})
  endif()
endforeach()
list(JOIN depends ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME limen)
set(CPACK_PACKAGE_CONTACT "The Limen authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "research bench: how much quality real-time rendering needs")
set(CPACK_PACKAGE_DESCRIPTION "Renders with the techniques of four theses, measures each one's speed against its error,
predicts what a viewer would see, runs studies with people and analyses their answers.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The Limen authors <limen@localhost>")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
include(CPack)
