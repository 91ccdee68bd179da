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
# Everything is rounded as written, whatever CMAKE_CXX_FLAGS allow the compiler: a target's options come after these and
# take back what changes results. Only the kernel variants that show what such flags do have them again, as options of
# their sources. (Clang takes -fno-unsafe-math-optimizations for a wish for exceptions that trap, and gets slow; its
# -fno-fast-math takes back that flag, too.)
set(barycert_strict_math -fno-fast-math -fno-associative-math -fno-reciprocal-math -fsigned-zeros -fno-finite-math-only
  -ffp-contract=off)
set(barycert_strict_math_GNU ${barycert_strict_math} -fno-unsafe-math-optimizations -fno-single-precision-constant)
set(barycert_strict_math_Clang ${barycert_strict_math} -fno-approx-func -fhonor-nans -fhonor-infinities
  -fdenormal-fp-math=ieee)
if(DEFINED barycert_strict_math_${CMAKE_CXX_COMPILER_ID})
  target_compile_options(barycert_flags INTERFACE ${barycert_strict_math_${CMAKE_CXX_COMPILER_ID}})
else()
  target_compile_options(barycert_flags INTERFACE ${barycert_strict_math})
endif()
target_compile_options(barycert_flags INTERFACE -Wall -Wextra -Wpedantic -Wconversion)
# Joined sources (barycert_join) see each other's names: a local name may be one of theirs.
set(joined $<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>)
target_compile_options(barycert_flags INTERFACE $<$<NOT:${joined}>:-Wshadow> $<$<AND:${joined},$<CXX_COMPILER_ID:GNU>>:-Wshadow=local>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 warns of overlaps and overflows that are not there in `"text" + std::string` (its bug 105651).
  # At -O3 it also sees std::array::fill of small structures write past their end, which it does not.
  # At -O2 it sees std::vector free what it did not allocate.
  target_compile_options(barycert_flags INTERFACE -Wno-restrict -Wno-stringop-overflow -Wno-free-nonheap-object)
endif()
if(BARYCERT_WERROR)
  target_compile_options(barycert_flags INTERFACE -Werror)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  # GCC 14 is wrong about inlined code of the standard library: told, not an error. And it takes every reference into JSON
  # for one to the name that was asked for.
  target_compile_options(barycert_flags INTERFACE -Wno-error=array-bounds -Wno-error=free-nonheap-object $<$<COMPILE_LANGUAGE:CXX>:-Wno-dangling-reference>)
endif()
if(BARYCERT_SANITIZE)
  target_compile_options(barycert_flags INTERFACE -fsanitize=${BARYCERT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(barycert_flags INTERFACE -fsanitize=${BARYCERT_SANITIZE})
endif()
if(BARYCERT_FUZZ STREQUAL "FAST")
  target_compile_options(barycert_flags INTERFACE -fsanitize=fuzzer-no-link -D_GLIBCXX_ASSERTIONS
    -fsanitize-coverage-ignorelist=${PROJECT_SOURCE_DIR}/tests/fuzz/not_counted.txt)
elseif(BARYCERT_FUZZ)
  # The standard library's checks of its callers are on, too.
  target_compile_options(barycert_flags INTERFACE -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all
    -fno-omit-frame-pointer -D_GLIBCXX_ASSERTIONS
    -fsanitize-coverage-ignorelist=${PROJECT_SOURCE_DIR}/tests/fuzz/not_counted.txt)
  target_link_options(barycert_flags INTERFACE -fsanitize=address,undefined)
endif()

# Lanes are compiled for three kinds of processors of x86-64, and chosen at run time (core/simd_targets.hpp). A third of their time of
# compiling goes into one that this machine does not use.
if(PROJECT_IS_TOP_LEVEL)
  set(BARYCERT_SIMD ALL CACHE STRING "Processors that lanes are compiled for: ALL; THIS, but for what this machine does not use")
  set_property(CACHE BARYCERT_SIMD PROPERTY STRINGS ALL THIS)
endif()
if(BARYCERT_SIMD STREQUAL "THIS" AND EXISTS /proc/cpuinfo)
  file(STRINGS /proc/cpuinfo processor REGEX "^flags" LIMIT_COUNT 1)
  set(has_avx512 TRUE)
  foreach(flag avx512f avx512cd avx512bw avx512dq avx512vl)
    if(NOT processor MATCHES " ${flag}( |$)")
      set(has_avx512 FALSE)
    endif()
  endforeach()
  if(has_avx512)
    target_compile_definitions(barycert_flags INTERFACE BARYCERT_WITHOUT_AVX2)
  elseif(processor MATCHES " avx2( |$)")
    target_compile_definitions(barycert_flags INTERFACE BARYCERT_WITHOUT_AVX512)
  endif()
endif()
