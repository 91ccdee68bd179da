# Joined sources: a compiler run takes several sources of a folder at once, for most of the time of a run goes into the
# headers that they share. -DBARYCERT_UNITY=OFF compiles each alone; `./run lint` reads each alone in any case.
if(PROJECT_IS_TOP_LEVEL)
  set(BARYCERT_UNITY ON CACHE STRING "Compile several sources of a folder in one compiler run: ON, OFF")
endif()

# barycert_join(TARGET): joins the sources of the target in each folder, by up to eight. Alone stay those
# that Highway compiles once for each processor, for they include themselves, and those that CMake leaves out: with options or
# definitions of their own, or with SKIP_UNITY_BUILD_INCLUSION. Call it from the folder of the target.
function(barycert_join target)
  if(NOT BARYCERT_UNITY)
    return()
  endif()
  set(at_once 8)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(path ${source} ABSOLUTE)
    if(NOT EXISTS ${path})
      continue()
    endif()
    get_filename_component(folder ${path} DIRECTORY)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
    file(STRINGS ${path} lanes REGEX "core/foreach_target.hpp")
    if(lanes)
      continue()
    endif()
    string(MAKE_C_IDENTIFIER ${folder} group)
    math(EXPR count_${group} "0${count_${group}} + 1")
    math(EXPR part "(${count_${group}} - 1) / ${at_once}")
    set_property(SOURCE ${source} PROPERTY UNITY_GROUP ${group}_${part})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# barycert_cold(TARGET): for code in which no time is spent, as that which reads options or writes words, and tests: -O3
# takes half as long again to compile. Not -O0, for exact judges of tests take their time.
function(barycert_cold target)
  target_compile_options(${target} PRIVATE $<$<NOT:$<CONFIG:Debug>>:-O1>)
endfunction()
