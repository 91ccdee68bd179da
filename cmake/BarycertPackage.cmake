# Debian packages by CPack, one for each component of the installation: `./run package`.
include(GNUInstallDirs)
# Whoever passes packages on signs them, as Debian's tools do; else the address is nobody's.
set(maintainer "barycert developers <developers@barycert.invalid>")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(BARYCERT_MAINTAINER "${maintainer}" CACHE STRING "Maintainer of the packages: NAME <ADDRESS>")
set(BARYCERT_PACKAGE_REVISION 1 CACHE STRING "Debian revision of the packages")
set(BARYCERT_HOMEPAGE "" CACHE STRING "Home page of the packages")
set(package_version ${PROJECT_VERSION}-${BARYCERT_PACKAGE_REVISION})

set(CPACK_GENERATOR DEB)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each has its own
set(CPACK_PACKAGE_NAME barycert)
set(CPACK_PACKAGE_CONTACT "${BARYCERT_MAINTAINER}")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_HOMEPAGE_URL "${BARYCERT_HOMEPAGE}")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${BARYCERT_PACKAGE_REVISION})
set(CPACK_DEBIAN_PACKAGE_SOURCE barycert)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_COMPONENTS_ALL "")

# The interpreter that the module was built for.
if(BARYCERT_PYTHON_INTERPRETER)
  set(Python3_EXECUTABLE ${BARYCERT_PYTHON_INTERPRETER})
endif()
find_package(Python3 REQUIRED COMPONENTS Interpreter)

# barycert_deb(COMPONENT PACKAGE SECTION SUMMARY DESCRIPTION [DEPENDS ...] [RECOMMENDS ...] [SUGGESTS ...] [PARTS ...])
# PARTS: the targets whose objects it holds; what they are made of stands in its bill of materials.
set(package_parts "")
macro(barycert_deb component package section summary description)
  cmake_parse_arguments(DEB "" "" "DEPENDS;RECOMMENDS;SUGGESTS;PARTS" ${ARGN})
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} COMPONENT)
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_SECTION ${section})
  set(CPACK_COMPONENT_${COMPONENT}_DESCRIPTION "${summary}\n${description}")
  foreach(field DEPENDS RECOMMENDS SUGGESTS)
    list(JOIN DEB_${field} ", " CPACK_DEBIAN_${COMPONENT}_PACKAGE_${field})
  endforeach()
  list(JOIN DEB_PARTS " " parts)
  string(APPEND package_parts "${component} ${package} ${parts}\n")
endmacro()

if(TARGET barycert_cli)
  barycert_deb(cli barycert science "exact interpolation over meshes, audits of kernels"
    "Interpolates fields over meshes of tetrahedra or triangles: the cell of every
point is exact, every value is correctly rounded. Checks in exact arithmetic
whether meshes are partitions, draws meshes, slices and iso-surfaces, verifies
results of other tools, and audits floating-point kernels for barycentric
weights against exact arithmetic."
    SUGGESTS barycert-tetgen python3-meshio PARTS bin/barycert)
endif()
get_property(barycert_libraries GLOBAL PROPERTY barycert_libraries)
foreach(library ${barycert_libraries})
  list(APPEND archives $<PATH:RELATIVE_PATH,$<TARGET_FILE:barycert_${library}>,${PROJECT_BINARY_DIR}>)
endforeach()
barycert_deb(dev libbarycert-dev libdevel "exact interpolation over meshes, C++ library"
  "Static libraries, headers, and what CMake and pkg-config need to find them:
barycert::barycert with exact predicates, weights, sampling and checks of
meshes, and barycert::audit with audits of kernels and the oracle."
  DEPENDS libhwy-dev libtbb-dev libfmt-dev libpng-dev libcairo2-dev libfreetype-dev zlib1g-dev libexpat1-dev libdeflate-dev liblzma-dev liblz4-dev libgmp-dev libmpfr-dev
  PARTS ${archives})
if(TARGET barycert_vtk)
  barycert_deb(vtk libbarycert-vtk-dev libdevel "exact cell locator and probe for VTK"
    "vtkBarycertLocator, a cell locator whose owners are exact, and
vtkBarycertProbe, with correctly rounded values, for VTK 9: a static library
and headers, for CMake as barycert::vtk."
    DEPENDS "libbarycert-dev (= ${package_version})" libvtk9-dev PARTS src/vtk/libbarycert_vtk.a)
endif()
if(TARGET barycert-tetgen)
  barycert_deb(tetgen barycert-tetgen science "meshes for barycert by TetGen"
    "Fills a surface with tetrahedra by TetGen: .poly .smesh .off .stl .ply in,
TetGen's files out. Of barycert's packages this one alone is under the AGPL,
as TetGen is; \"barycert mesh\" runs it."
    SUGGESTS barycert PARTS bin/barycert-tetgen)
endif()
if(TARGET barycert_python)
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  file(RELATIVE_PATH module ${PROJECT_BINARY_DIR} ${PROJECT_BINARY_DIR}/python/barycert)
  barycert_deb(python python3-barycert python "exact interpolation over meshes, for Python"
    "Interpolators with the call of SciPy's LinearNDInterpolator, exact location of
points, correctly rounded samples and gradients, checks of meshes, exact
predicates over arrays, audits of kernels and verification of results.
Takes meshes of meshio, pyvista, VTK and SciPy as they are."
    DEPENDS "python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR})"
      "python3 (<< ${Python3_VERSION_MAJOR}.${next_minor})" python3-numpy
    RECOMMENDS python3-scipy SUGGESTS python3-meshio python3-tqdm python3-vtk9
    PARTS ${module}/$<TARGET_FILE_NAME:barycert_python>)
  foreach(script postinst prerm)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/debian/python3-barycert.${script} ${PROJECT_BINARY_DIR}/debian/${script} COPYONLY)
    list(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/debian/${script})
  endforeach()
endif()
# ParaView's headers and VTK's exclude each other in Debian: its plug-in is built in a root of its own, and is all that is
# packed there.
if(TARGET Barycert)
  set(CPACK_COMPONENTS_ALL "")
  set(package_parts "")
  get_property(plugin_folder GLOBAL PROPERTY barycert_paraview_folder)
  barycert_deb(paraview barycert-paraview science "exact resampling and checks of meshes in ParaView"
    "A plug-in for ParaView: a cell locator with exact owners, the filters Barycert
Resample and Barycert Check, and a reader of TetGen's files."
    DEPENDS paraview PARTS ${plugin_folder}/Barycert.so)
endif()

file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/debian/parts CONTENT "${package_parts}")
# Parts that CPack does not make: change logs, copyright, bills of materials, compressed manual pages.
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/BarycertPackageFiles.cmake)
set(CPACK_BARYCERT_SOURCE ${PROJECT_SOURCE_DIR})
set(CPACK_BARYCERT_BUILD ${PROJECT_BINARY_DIR})
set(CPACK_BARYCERT_VERSION ${package_version})
set(CPACK_BARYCERT_LIBDIR ${CMAKE_INSTALL_LIBDIR})
set(CPACK_BARYCERT_PYTHON ${Python3_EXECUTABLE})
set(CPACK_BARYCERT_NINJA ${CMAKE_MAKE_PROGRAM})
include(CPack)
