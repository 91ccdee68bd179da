# barycert_flags: what every target of this project is compiled with.
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
if(PROJECT_IS_TOP_LEVEL)
  find_program(CCACHE ccache)
  if(CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
    set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE})
  endif()
endif()

add_library(barycert_flags INTERFACE)
target_compile_features(barycert_flags INTERFACE cxx_std_20)
# A fused multiply-add that the source does not ask for changes results: contraction is off everywhere but in the
# kernel variants that exist to show what it does.
target_compile_options(barycert_flags INTERFACE -ffp-contract=off)
target_compile_options(barycert_flags INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 warns of overlaps and overflows that are not there in `"text" + std::string` (its bug 105651).
  # At -O3 it also sees std::array::fill of small structures write past their end, which it does not.
  target_compile_options(barycert_flags INTERFACE -Wno-restrict -Wno-stringop-overflow)
endif()
if(BARYCERT_WERROR)
  target_compile_options(barycert_flags INTERFACE -Werror)
endif()
if(BARYCERT_SANITIZE)
  target_compile_options(barycert_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(barycert_flags INTERFACE -fsanitize=address,undefined)
endif()
