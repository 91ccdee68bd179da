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
# A package for each folder of libraries: their archives, public headers, and what CMake and pkg-config need to find them. It depends on the
# packages of what they need, in this project and elsewhere.
set(summary_core "exact predicates and weights of simplices")
set(words_core "Exact signs, orientations and in-sphere tests, correctly rounded barycentric
weights, values and gradients, inverse maps of cells.")
set(summary_files "files that appear whole, for barycert")
set(words_files "Files that appear complete or not at all, packed files unpacked: what
barycert's other libraries read and write with. Without public headers.")
set(summary_mesh "exact checks, location and sampling of meshes")
set(words_mesh "Checks whether a mesh is a partition, finds the cell of a point, samples
fields at points and on grids, cuts iso-surfaces, verifies other tools' values.")
set(summary_io "files of meshes, points and values for barycert")
set(words_io "Reads and writes the files of TetGen, Triangle, Gmsh, Medit and VTK, surfaces,
CSV and NumPy's files.")
set(summary_draw "pictures of meshes and fields by barycert")
set(words_draw "Figures of meshes, slices and iso-surfaces with axes and colour bars, scenes
with textures, as PNG, PDF and SVG.")
set(summary_audit "audits of floating-point kernels by exact arithmetic")
set(words_audit "A catalogue of formulas for barycentric weights with their faults, an exact
oracle, and audits of one by the other.")
set(summary_app "jobs and reports of barycert, files to files")
set(words_app "What barycert's subcommands do, as functions: sample, resample, check, verify
and render files; reports as text, JSON and pages.")
# Debian's names of what pkg-config calls otherwise than lib...-dev of its own name.
set(debian_libhwy libhwy-dev)
set(debian_zlib zlib1g-dev)
set(debian_libdeflate libdeflate-dev)
set(debian_expat libexpat1-dev)
set(debian_liblzma liblzma-dev)
set(debian_liblz4 liblz4-dev)
set(debian_libpng libpng-dev)
set(debian_cairo libcairo2-dev)
set(debian_freetype2 libfreetype-dev)
foreach(folder ${barycert_folders})
  set(archives "")
  set(depends "")
  foreach(library ${barycert_libraries})
    get_property(folder_of_library GLOBAL PROPERTY barycert_folder_${library})
    if(NOT folder_of_library STREQUAL folder)
      continue()
    endif()
    list(APPEND archives $<PATH:RELATIVE_PATH,$<TARGET_FILE:barycert_${library}>,${PROJECT_BINARY_DIR}>)
    get_property(needs GLOBAL PROPERTY barycert_needs_${library})
    foreach(need ${needs})
      get_property(other GLOBAL PROPERTY barycert_folder_${need})
      if(NOT other STREQUAL folder)
        list(APPEND depends "libbarycert-${other}-dev (= ${package_version})")
      endif()
    endforeach()
    get_property(modules GLOBAL PROPERTY barycert_modules_${library})
    foreach(module ${modules})
      if(NOT debian_${module})
        set(debian_${module} lib${module}-dev)
      endif()
      list(APPEND depends ${debian_${module}})
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES depends)
  barycert_deb(${folder} libbarycert-${folder}-dev libdevel "${summary_${folder}}, C++ library" "${words_${folder}}"
    DEPENDS ${depends} PARTS ${archives})
endforeach()
if(TARGET barycert)
  barycert_deb(dev libbarycert-dev libdevel "exact interpolation over meshes, C++ libraries"
    "What CMake and pkg-config call barycert: exact predicates and weights, checks
and sampling of meshes, and their files."
    DEPENDS "libbarycert-core-dev (= ${package_version})" "libbarycert-mesh-dev (= ${package_version})"
      "libbarycert-io-dev (= ${package_version})")
endif()
if(TARGET barycert_vtk)
  barycert_deb(vtk libbarycert-vtk-dev libdevel "exact cell locator and probe for VTK"
    "vtkBarycertLocator, a cell locator whose owners are exact, and
vtkBarycertProbe, with correctly rounded values, for VTK 9: a static library
and headers, for CMake as barycert::vtk."
    DEPENDS "libbarycert-app-dev (= ${package_version})" libvtk9-dev PARTS src/vtk/libbarycert_vtk.a)
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
