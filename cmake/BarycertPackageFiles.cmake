# Run by CPack when the files of all packages lie in CPACK_TEMPORARY_DIRECTORY/COMPONENT/usr and before they are packed.
cmake_minimum_required(VERSION 3.25)
set(build ${CPACK_BARYCERT_BUILD})
set(source ${CPACK_BARYCERT_SOURCE})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${said}")
  endif()
endfunction()

# The day of the packages is that of the source, not that of the build: the same source gives the same packages.
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND git -C ${source} log -1 --format=%ct OUTPUT_VARIABLE seconds OUTPUT_STRIP_TRAILING_WHITESPACE
    ERROR_QUIET)
  if(seconds)
    set(ENV{SOURCE_DATE_EPOCH} ${seconds})
  endif()
endif()
string(TIMESTAMP day "%a, %d %b %Y %H:%M:%S +0000" UTC)

file(STRINGS ${build}/debian/parts lines)
foreach(line IN LISTS lines)
  string(REPLACE " " ";" words "${line}")
  list(POP_FRONT words component package)
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component})
  set(doc ${root}/usr/share/doc/${package})
  file(MAKE_DIRECTORY ${doc})
  configure_file(${source}/cmake/debian/copyright.in ${doc}/copyright @ONLY)
  set(copyright_of ${source}/cmake/debian/copyright.${package})
  if(EXISTS ${copyright_of})
    file(READ ${copyright_of} more)
    file(APPEND ${doc}/copyright "${more}")
  endif()
  file(WRITE ${doc}/changelog.Debian "barycert (${CPACK_BARYCERT_VERSION}) unstable; urgency=medium

  * Packages of barycert ${CPACK_PACKAGE_VERSION}; its changes stand in changelog.gz.

 -- ${CPACK_PACKAGE_CONTACT}  ${day}
")
  file(COPY_FILE ${source}/CHANGELOG.md ${doc}/changelog)
  run(${CPACK_BARYCERT_PYTHON} ${source}/cmake/sbom.py --build ${build} --ninja ${CPACK_BARYCERT_NINJA} --package ${package}
    --notices ${doc}/notices --version ${CPACK_BARYCERT_VERSION} --output ${doc}/${package}.spdx.json ${words})
  file(COPY_FILE ${doc}/${package}.spdx.json ${CPACK_PACKAGE_DIRECTORY}/${package}.spdx.json)
  if(component STREQUAL "cli")
    # With the pages that these, the help and the manual pages name.
    file(COPY ${source}/README.md ${source}/SECURITY.md ${source}/doc DESTINATION ${doc})
  endif()
  file(GLOB packed ${root}/usr/share/man/man1/*.1 ${doc}/changelog ${doc}/changelog.Debian)
  foreach(file IN LISTS packed)
    run(gzip -9n ${file})
  endforeach()
  file(GLOB_RECURSE archives ${root}/usr/lib/*.a)
  foreach(archive IN LISTS archives)
    run(strip --strip-debug --remove-section=.comment --remove-section=.note --enable-deterministic-archives ${archive})
  endforeach()
endforeach()
