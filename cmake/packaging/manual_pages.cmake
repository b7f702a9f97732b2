# Writes PREFIX/share/man/man1/PROGRAM.1.gz for each of `programs` and for limen. Needs: programs, source, version, and
# what an install script has.
set(prefix "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")
find_program(help2man help2man)
find_program(gzip gzip)
if(NOT help2man OR NOT gzip)
  message(FATAL_ERROR "Manual pages are made by help2man: apt-get install help2man")
endif()
file(MAKE_DIRECTORY "${prefix}/share/man/man1")

# manual_page(PROGRAM FILE WORDS): `help` and `version` are the arguments that make it print these.
function(manual_page name file words help version)
  execute_process(
    COMMAND ${help2man} --no-info --no-discard-stderr --section=1 "--name=${words}" "--help-option=${help}"
            "--version-option=${version}" --source=Limen "--output=${prefix}/share/man/man1/${name}.1" "${file}"
    COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${gzip} -9nf "${prefix}/share/man/man1/${name}.1" COMMAND_ERROR_IS_FATAL ANY)
endfunction()

manual_page(limen "${prefix}/bin/limen" "how much quality real-time rendering needs" --help --version)
foreach(program IN LISTS programs)
  # The first line that a program prints of itself.
  execute_process(COMMAND "${prefix}/lib/limen/${program}" --help OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "^[^\n]+" words "${text}")
  manual_page(${program} "${prefix}/lib/limen/${program}" "${words}" --help --version)
endforeach()
