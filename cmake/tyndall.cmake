# How Tyndall's folders say what they build. Each tyndall/<folder>/CMakeLists.txt uses only these:
#
#   tyndall_library(NAME n SOURCES a.cc.. [LINK targets..])          static library of floors 5 and 6
#   tyndall_test(NAME n SOURCES a_test.cc.. [LINK targets..] [LABELS ..] [TIMEOUT seconds])
#   tyndall_bench(NAME n SOURCES a_bench.cc.. [LINK targets..])
#   tyndall_kernels(NAME n SOURCE k.cc [HEADER k.h..] [LINK targets..])   see kernels.cmake
#
# All four skip a target, saying so, when something it links is an optional part that this build lacks
# (components.cmake) or was itself skipped for that reason.
include_guard(GLOBAL)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(PROJECT_IS_TOP_LEVEL)
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo" FORCE)
  endif()
  # Looked for once: were it found later, every command would change and everything be compiled again.
  if(NOT DEFINED CACHE{TYNDALL_CCACHE})
    find_program(TYNDALL_CCACHE ccache)
    if(NOT TYNDALL_CCACHE)
      set(TYNDALL_CCACHE "" CACHE FILEPATH "ccache, if it was there at first" FORCE)
    endif()
  endif()
  if(TYNDALL_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${TYNDALL_CCACHE}")
  endif()
  # Release: -O3 buys nothing measurable outside the kernels (which ask for it) and costs build time. Debug keeps the
  # asserts on domains, libstdc++'s own checks, and enough optimisation for statistical tests to finish.
  set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
  set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g -D_GLIBCXX_ASSERTIONS")
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
endif()

# Floors 0 to 4: headers only, nothing but the standard library.
add_library(tyndall_headers INTERFACE)
add_library(tyndall::tyndall ALIAS tyndall_headers)
set_target_properties(tyndall_headers PROPERTIES EXPORT_NAME tyndall)
target_compile_features(tyndall_headers INTERFACE cxx_std_20)

function(tyndall_floors_of_headers)
  set(headers "")
  foreach(folder IN LISTS ARGN)
    file(GLOB found CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tyndall/${folder}/*.h")
    list(APPEND headers ${found})
  endforeach()
  # Tests, and what belongs to a compiled library, are not installed.
  list(FILTER headers EXCLUDE REGEX "_(test|bench|kernels?)\\.h$")
  target_sources(tyndall_headers INTERFACE FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}" FILES ${headers})
  target_include_directories(tyndall_headers INTERFACE "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>")
endfunction()

# How we compile; private to this build, never exported. Contraction is off so that the same text gives the same bits
# under both compilers and every instruction set: a fused multiply-add is written as one.
add_library(tyndall_flags INTERFACE)
target_compile_options(tyndall_flags INTERFACE
  -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wconversion -Wno-sign-conversion -ffp-contract=off -fno-math-errno
  $<$<BOOL:${TYNDALL_WERROR}>:-Werror>)
if(TYNDALL_SANITIZE OR TYNDALL_COVERAGE)
  set(TYNDALL_INSTRUMENTED ON)
endif()
if(TYNDALL_SANITIZE)
  target_compile_options(tyndall_flags INTERFACE
    -fsanitize=${TYNDALL_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)  # guesses wrongly among the checks it has put in itself
  target_link_options(tyndall_flags INTERFACE -fsanitize=${TYNDALL_SANITIZE})
endif()
if(TYNDALL_COVERAGE)
  target_compile_options(tyndall_flags INTERFACE --coverage)
  target_link_options(tyndall_flags INTERFACE --coverage)
endif()

# Sets `out` to the things `name` links that this build does not have; remembers `name` as missing if there are any.
function(tyndall_missing name out)
  get_property(missing GLOBAL PROPERTY TYNDALL_MISSING)
  set(lacks "")
  foreach(target IN LISTS ARGN)
    if(target IN_LIST missing)
      list(APPEND lacks "${target}")
    endif()
  endforeach()
  if(lacks)
    set_property(GLOBAL APPEND PROPERTY TYNDALL_MISSING "${name}" "tyndall::${name}")
    list(JOIN lacks ", " words)
    set_property(GLOBAL APPEND PROPERTY TYNDALL_NOT_BUILT "${name} (needs ${words})")
  endif()
  set(${out} "${lacks}" PARENT_SCOPE)
endfunction()

function(tyndall_library)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME" "SOURCES;LINK")
  tyndall_missing(${arg_NAME} lacks ${arg_LINK})
  if(lacks)
    return()
  endif()
  add_library(${arg_NAME} STATIC ${arg_SOURCES})
  add_library(tyndall::${arg_NAME} ALIAS ${arg_NAME})
  target_link_libraries(${arg_NAME} PUBLIC tyndall_headers ${arg_LINK} PRIVATE tyndall_flags)
endfunction()

# A gtest executable. Test suites whose name contains Soak get the label soak: long runs, `make soak` only.
function(tyndall_test)
  if(NOT TYNDALL_BUILD_TESTS)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME;TIMEOUT" "SOURCES;LINK;LABELS")
  tyndall_missing(${arg_NAME} lacks ${arg_LINK})
  if(lacks)
    return()
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  add_executable(${arg_NAME} ${arg_SOURCES})
  target_link_libraries(${arg_NAME} PRIVATE tyndall_headers tyndall_flags ${arg_LINK} GTest::gmock GTest::gtest_main)
  target_compile_definitions(${arg_NAME} PRIVATE
    TYNDALL_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared"
    TYNDALL_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    TYNDALL_PROGRAM="${PROJECT_BINARY_DIR}/tyndall")
  set(common WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}" DISCOVERY_TIMEOUT 120)
  gtest_discover_tests(${arg_NAME} ${common} TEST_FILTER "-*Soak*" TEST_LIST ${arg_NAME}_tests
    PROPERTIES TIMEOUT ${arg_TIMEOUT} LABELS "${arg_LABELS}")
  gtest_discover_tests(${arg_NAME} ${common} TEST_FILTER "*Soak*" TEST_LIST ${arg_NAME}_soak_tests
    PROPERTIES TIMEOUT 7200 LABELS "soak")
endfunction()

# A Google Benchmark executable. Ours is -O2 without automatic vectorisation, so that a scalar figure is scalar and a
# Lanes figure owes nothing to the compiler's guesses.
function(tyndall_bench)
  if(NOT TYNDALL_BUILD_BENCH)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME" "SOURCES;LINK")
  tyndall_missing(${arg_NAME} lacks ${arg_LINK})
  if(lacks)
    return()
  endif()
  add_executable(${arg_NAME} ${arg_SOURCES})
  target_link_libraries(${arg_NAME} PRIVATE tyndall_headers tyndall_flags ${arg_LINK} benchmark::benchmark_main)
  target_compile_definitions(${arg_NAME} PRIVATE TYNDALL_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_compile_options(${arg_NAME} PRIVATE
    $<IF:$<CXX_COMPILER_ID:Clang>,-fno-vectorize;-fno-slp-vectorize,-fno-tree-vectorize>)
  set_property(GLOBAL APPEND PROPERTY TYNDALL_BENCHES ${arg_NAME})
endfunction()

include(kernels)

# Last lines of configure: what this build has and has not.
function(tyndall_report)
  get_property(off GLOBAL PROPERTY TYNDALL_NOT_BUILT)
  foreach(line IN LISTS off)
    message(STATUS "Not built: ${line}")
  endforeach()
  get_property(benches GLOBAL PROPERTY TYNDALL_BENCHES)
  string(REPLACE ";" "\n" benches "${benches}")
  file(WRITE "${PROJECT_BINARY_DIR}/benches.txt" "${benches}\n")
endfunction()
