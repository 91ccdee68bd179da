# The libraries of src, one or a few a folder: what each is, needs and builds stands in its README.md and CMakeLists.txt.

# barycert_declare(FOLDER NAME [LIBRARY...]): the library NAME of a folder of src needs those LIBRARIES.
function(barycert_declare folder name)
  set_property(GLOBAL APPEND PROPERTY barycert_declared ${name})
  set_property(GLOBAL PROPERTY barycert_folder_${name} ${folder})
  set_property(GLOBAL PROPERTY barycert_needs_${name} ${ARGN})
endfunction()

# barycert_choose(): sets barycert_chosen, those of the declared libraries that are built, and barycert_folders, which have them; both in
# the order of their needs.
function(barycert_choose)
  get_property(declared GLOBAL PROPERTY barycert_declared)
  set(wanted ${BARYCERT_LIBRARIES})
  foreach(name IN LISTS wanted)
    if(NOT name IN_LIST declared)
      list(JOIN declared ", " names)
      message(FATAL_ERROR "BARYCERT_LIBRARIES: there is no library ${name}; there are ${names}")
    endif()
  endforeach()
  if(NOT wanted)
    set(wanted ${declared})
    if(NOT BARYCERT_AUDIT)
      list(FILTER wanted EXCLUDE REGEX "^(audit|rules)")
    endif()
  endif()
  list(REVERSE declared)
  set(chosen "")
  set(folders "")
  foreach(name IN LISTS declared)
    if(name IN_LIST wanted)
      get_property(needs GLOBAL PROPERTY barycert_needs_${name})
      list(APPEND wanted ${needs})
      get_property(folder GLOBAL PROPERTY barycert_folder_${name})
      list(PREPEND chosen ${name})
      list(REMOVE_ITEM folders ${folder})
      list(PREPEND folders ${folder})
    endif()
  endforeach()
  set(barycert_chosen ${chosen} PARENT_SCOPE)
  set(barycert_folders ${folders} PARENT_SCOPE)
endfunction()

# barycert_library(NAME ABOUT SOURCES... [COLD] [LINKS ...] [PACKAGES ...] [MODULES ...] [OTHERS ...]): the target barycert_NAME, as
# barycert::NAME, of the folder that calls it; nothing where the library is not chosen. The libraries that it was declared to need
# are those whose public headers its own include. COLD: see barycert_cold. LINKS: what its sources alone use. Once installed, who
# links it finds what that is by PACKAGES of CMake, by MODULES of pkg-config, and by flags of OTHERS. Public headers stand in
# include/barycert; all others are found below src by their path, in this project alone.
function(barycert_library name about)
  if(NOT name IN_LIST barycert_chosen)
    return()
  endif()
  cmake_parse_arguments(ARG "COLD" "" "LINKS;PACKAGES;MODULES;OTHERS" ${ARGN})
  set(target barycert_${name})
  add_library(${target} ${ARG_UNPARSED_ARGUMENTS})
  add_library(barycert::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/include)
    target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>)
  endif()
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>)
  get_property(needed GLOBAL PROPERTY barycert_needs_${name})
  list(TRANSFORM needed PREPEND barycert_)
  target_link_libraries(${target} PUBLIC ${needed} PRIVATE $<BUILD_INTERFACE:barycert_flags> ${ARG_LINKS})
  if(BARYCERT_FUZZ)
    barycert_fuzzed(${ARG_UNPARSED_ARGUMENTS})
  endif()
  set(kind LIBRARY)
  if(ARG_COLD)
    barycert_cold(${target})
    set(kind COLD_LIBRARY)
  endif()
  barycert_join(${target})
  # At the end of the folder: sources get options after this call.
  cmake_language(EVAL CODE "cmake_language(DEFER CALL barycert_precompile ${target} ${kind})")
  set_property(GLOBAL APPEND PROPERTY barycert_libraries ${name})
  set_property(GLOBAL PROPERTY barycert_about_${name} ${about})
  set_property(GLOBAL PROPERTY barycert_packages_${name} ${ARG_PACKAGES})
  set_property(GLOBAL PROPERTY barycert_modules_${name} ${ARG_MODULES})
  set_property(GLOBAL PROPERTY barycert_others_${name} ${ARG_OTHERS})
endfunction()

# barycert_fuzzed(SOURCE...): how sources are instrumented for the fuzzer. What Highway compiles once for each processor takes
# Clang a quarter of an hour a source under UndefinedBehaviorSanitizer or without -O2, and core/lanes.cpp as long under any
# instrumentation: ./run asan has them under both sanitizers.
function(barycert_fuzzed)
  foreach(source ${ARGN})
    set(path ${CMAKE_CURRENT_SOURCE_DIR}/${source})
    file(STRINGS ${path} lanes REGEX "core/foreach_target.hpp")
    if(path MATCHES "/core/lanes.cpp$")
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -O2 -fno-sanitize=all)
    elseif(path MATCHES "/fill_lanes.cpp$")
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -O2 -fno-sanitize=undefined)
    elseif(lanes)
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -fno-sanitize=undefined)
    endif()
    # To tell the fuzzer what is compared helps it past the words and counts of a file; where numbers are computed and errors
    # written it teaches nothing, and takes half of the time.
    if(path MATCHES "/src/(core|files|mesh/(index|check|locate|sample))/")
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -O2 -fno-sanitize-coverage=trace-cmp)
    endif()
  endforeach()
endfunction()

# barycert_embed(TARGET SOURCE MACRO FILE): the file is part of the library, by BARYCERT_EMBED(name, macro) in the source.
function(barycert_embed target source macro file)
  set_property(SOURCE ${source} APPEND PROPERTY COMPILE_DEFINITIONS ${macro}="${PROJECT_SOURCE_DIR}/${file}")
  set_property(SOURCE ${source} APPEND PROPERTY OBJECT_DEPENDS ${PROJECT_SOURCE_DIR}/${file})
endfunction()

# barycert_scheduled(SOURCE...): lanes are long sequences with many independent parts. GCC schedules them before it allocates
# registers only if asked: 10 % for weights and values. No influence on results.
function(barycert_scheduled)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "-fschedule-insns;-fsched-pressure")
  endif()
endfunction()
