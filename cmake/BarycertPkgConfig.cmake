# barycert.pc and barycert-audit.pc, for builds that do not use CMake. What a static library calls, whoever links it must
# link, too; of a shared one that is nobody's business.
get_target_property(barycert_type barycert TYPE)

# barycert_pkg_config(NAME DESCRIPTION LIBRARIES REQUIRES PRIVATE_REQUIRES PRIVATE_LIBRARIES)
function(barycert_pkg_config name description libraries requires private_requires private_libraries)
  # The prefix is found from the place of the file, so that an installation can be moved.
  file(RELATIVE_PATH up /p/${CMAKE_INSTALL_LIBDIR}/pkgconfig /p)
  string(REGEX REPLACE "/$" "" up ${up})
  set(text "prefix=\${pcfiledir}/${up}\nlibdir=\${prefix}/${CMAKE_INSTALL_LIBDIR}\nincludedir=\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}\n\n")
  string(APPEND text "Name: ${name}\nDescription: ${description}\nVersion: ${PROJECT_VERSION}\nCflags: -I\${includedir}\n")
  if(barycert_type STREQUAL "SHARED_LIBRARY")
    string(APPEND text "Requires: ${requires}\nRequires.private: ${private_requires}\nLibs: -L\${libdir} ${libraries}\n")
    string(APPEND text "Libs.private: ${private_libraries}\n")
  else()
    string(APPEND text "Requires: ${requires} ${private_requires}\nLibs: -L\${libdir} ${libraries} ${private_libraries}\n")
  endif()
  string(REGEX REPLACE " +(\n| )" "\\1" text "${text}")
  file(WRITE ${PROJECT_BINARY_DIR}/${name}.pc "${text}")
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
endfunction()

set(barycert_dl ${CMAKE_DL_LIBS})
list(TRANSFORM barycert_dl PREPEND -l)
barycert_pkg_config(barycert "${PROJECT_DESCRIPTION}" -lbarycert "" "libhwy tbb fmt cairo freetype2 libpng zlib expat libdeflate liblzma liblz4"
  "-pthread ${barycert_dl}")
if(TARGET barycert_audit)
  barycert_pkg_config(barycert-audit "Audits of kernels for barycentric weights, and the oracle" -lbarycert_audit barycert
    "tbb fmt mpfr gmp" "")
endif()
