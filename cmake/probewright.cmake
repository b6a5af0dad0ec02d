# What every target of the house is built with, and the three ways to add one.

find_package(Eigen3 3.4 REQUIRED)
find_package(fmt REQUIRED)

add_library(probewright_options INTERFACE)
target_compile_options(
  probewright_options
  INTERFACE -Wall
            -Wextra
            -Wpedantic
            -Wconversion
            -Wshadow
            -Wnon-virtual-dtor
            -Werror)
target_include_directories(probewright_options INTERFACE ${PROJECT_SOURCE_DIR}/src)
# Third-party headers are not ours to warn about.
get_target_property(eigen_include Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
target_include_directories(probewright_options SYSTEM INTERFACE ${eigen_include})
target_link_libraries(probewright_options INTERFACE fmt::fmt)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 reports false positives of these inside inlined Eigen and std code.
  target_compile_options(probewright_options INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow
                                                       -Wno-stringop-overread -Wno-restrict)
  # Up to a gigabyte the compiler looks for nothing to give back; tests compile in three quarters to nine tenths of the time.
  target_compile_options(probewright_options INTERFACE --param=ggc-min-heapsize=1000000)
endif()
if(PROBEWRIGHT_SANITIZE)
  target_compile_options(probewright_options INTERFACE -fsanitize=${PROBEWRIGHT_SANITIZE} -fno-omit-frame-pointer
                                                       -fno-sanitize-recover=all)
  target_link_options(probewright_options INTERFACE -fsanitize=${PROBEWRIGHT_SANITIZE})
  # Beyond the end of a vector, but within its memory, no sanitizer looks.
  target_compile_definitions(probewright_options INTERFACE _GLIBCXX_ASSERTIONS)
endif()
if(PROBEWRIGHT_COVERAGE)
  target_compile_options(probewright_options INTERFACE --coverage)
  target_link_options(probewright_options INTERFACE --coverage)
endif()

# Only some folders compute for long: contact, fits, frames, pictures. The others read, decide and write; the compiler's first level is
# enough for them and takes three quarters of the time.
set(PROBEWRIGHT_READING_OPTIONS $<$<CONFIG:Release>:-O1>)

# What takes time in a test is the house; optimizing the tests themselves costs a third of their build. Without any they are
# larger, and take as long to compile.
set(PROBEWRIGHT_TEST_OPTIONS $<$<CONFIG:Release>:-Og>)

# Headers that nearly every file needs are compiled once; reading them anew takes more than half of a whole build. Each
# file still includes what it uses: a build with PROBEWRIGHT_PRECOMPILE=OFF shows what was forgotten. Of the kind "cycles" is what a
# cycle is written with, for folders in which nearly every file needs it; elsewhere that costs more than it saves.
option(PROBEWRIGHT_PRECOMPILE "Compile common headers of libraries once" ON)
function(probewright_precompile target kind)
  if(NOT PROBEWRIGHT_PRECOMPILE)
    return()
  endif()
  if(NOT TARGET probewright_precompiled_${kind})
    set(empty ${PROJECT_BINARY_DIR}/precompiled_${kind}.cpp)
    file(CONFIGURE OUTPUT ${empty} CONTENT "")
    add_library(probewright_precompiled_${kind} OBJECT ${empty})
    target_link_libraries(probewright_precompiled_${kind} PRIVATE probewright_options ${ARGN})
    set(headers <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <numbers> <optional> <ranges> <span>
                <string> <string_view> <variant> <vector> <Eigen/Geometry> <fmt/format.h>)
    if(kind STREQUAL "cycles")
      list(APPEND headers <cycles/heidenhain/context.hpp> <cycles/sinumerik/context.hpp>)
    endif()
    if(kind STREQUAL "tests")
      list(APPEND headers <gmock/gmock.h> <gtest/gtest.h> <random>)
      target_compile_options(probewright_precompiled_${kind} PRIVATE ${PROBEWRIGHT_TEST_OPTIONS})
    elseif(NOT kind STREQUAL "computing")
      target_compile_options(probewright_precompiled_${kind} PRIVATE ${PROBEWRIGHT_READING_OPTIONS})
    endif()
    target_precompile_headers(probewright_precompiled_${kind} PRIVATE ${headers})
  endif()
  target_precompile_headers(${target} REUSE_FROM probewright_precompiled_${kind})
endfunction()

# Several files compiled as one take half of the time, tests a third, as most of it goes into templates that they share. Where one of
# them is changed again and again, files of their own are quicker; each file still stands alone, as a build without this shows.
option(PROBEWRIGHT_MERGE "Compile files in groups" OFF)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(PROBEWRIGHT_MERGE_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/merge_sources.py)
set(PROBEWRIGHT_SUITES_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/list_suites.py)

# probewright_merge(VARIABLE NAME COUNT): replaces the sources that the variable lists by groups of COUNT of them, if that is
# asked for. Files with properties of their own, and those that the preprocessor changes, stay out.
function(probewright_merge variable name count)
  if(NOT PROBEWRIGHT_MERGE)
    return()
  endif()
  set(single "")
  set(groups "")
  set(group "")
  set(number 0)
  foreach(file IN LISTS ${variable} ITEMS end)
    if(file STREQUAL "end")
      set(complete ON)
    else()
      get_source_file_property(options ${file} COMPILE_OPTIONS)
      get_source_file_property(definitions ${file} COMPILE_DEFINITIONS)
      file(STRINGS ${file} instructions LIMIT_COUNT 1 REGEX "^#(define|if|pragma)")
      if(options OR definitions OR instructions)
        list(APPEND single ${file})
        continue()
      endif()
      list(APPEND group ${file})
      list(LENGTH group length)
      string(COMPARE EQUAL ${length} ${count} complete)
    endif()
    if(complete AND group)
      math(EXPR number "${number} + 1")
      set(output ${PROJECT_BINARY_DIR}/merged/${name}_${number}.cpp)
      add_custom_command(
        OUTPUT ${output}
        COMMAND Python3::Interpreter ${PROBEWRIGHT_MERGE_SCRIPT} ${output} ${group}
        DEPENDS ${PROBEWRIGHT_MERGE_SCRIPT} ${group}
        VERBATIM)
      if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        # It takes what another file than the one it compiles declares for a header's.
        set_source_files_properties(${output} PROPERTIES COMPILE_OPTIONS -Wno-subobject-linkage)
      endif()
      list(APPEND groups ${output})
      set(group "")
    endif()
  endforeach()
  set(${variable} ${groups} ${single} PARENT_SCOPE)
endfunction()

# probewright_library(NAME [COMPUTES] [LINK targets...] [PRECOMPILED kind]): a static library of all .cpp files below the calling
# folder. COMPUTES: of those that compute for long.
function(probewright_library name)
  cmake_parse_arguments(ARG "COMPUTES" "PRECOMPILED" "LINK" ${ARGN})
  if(ARG_COMPUTES)
    set(ARG_PRECOMPILED computing)
  elseif(NOT ARG_PRECOMPILED)
    set(ARG_PRECOMPILED sources)
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(sources)
    probewright_merge(sources ${name} 8)
    add_library(probewright_${name} STATIC ${sources})
    target_link_libraries(probewright_${name} PUBLIC probewright_options ${ARG_LINK})
    if(NOT ARG_COMPUTES)
      target_compile_options(probewright_${name} PRIVATE ${PROBEWRIGHT_READING_OPTIONS})
    endif()
    probewright_precompile(probewright_${name} ${ARG_PRECOMPILED})
  else()
    add_library(probewright_${name} INTERFACE)
    target_link_libraries(probewright_${name} INTERFACE probewright_options ${ARG_LINK})
  endif()
endfunction()

# probewright_test(NAME [EACH] [LINK targets...] [PROPERTIES names and values...]): one test program of all *_test.cpp files in
# the calling folder; the properties are those of its entries for ctest. An entry is a suite, NAME.SUITE: a process takes longer to
# begin than most tests to run. With EACH an entry is a test: for those that take long or need something to themselves.
function(probewright_test name)
  cmake_parse_arguments(ARG "EACH" "" "LINK;PROPERTIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  probewright_merge(sources ${name}_test 12)
  add_executable(${name}_test ${sources})
  target_include_directories(${name}_test PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  if(PROBEWRIGHT_MERGE)  # what stands beside a test is no longer found beside what is compiled
    target_include_directories(${name}_test PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  endif()
  target_link_libraries(${name}_test PRIVATE ${ARG_LINK} GTest::gtest_main GTest::gmock)
  target_compile_options(${name}_test PRIVATE ${PROBEWRIGHT_TEST_OPTIONS})
  probewright_precompile(${name}_test tests GTest::gtest GTest::gmock)
  # Of the places that `ctest -j` has, an entry that computes takes two, one that waits for a real machine one.
  set(properties TIMEOUT 600 PROCESSORS 2 ${ARG_PROPERTIES})
  if(PROBEWRIGHT_SANITIZE)
    set(suppressions ${PROJECT_SOURCE_DIR}/cmake/leak_suppressions.txt)
    list(APPEND properties ENVIRONMENT LSAN_OPTIONS=suppressions=${suppressions}:print_suppressions=0)
  endif()
  set(results ${PROJECT_BINARY_DIR}/test-results/${name})
  if(ARG_EACH)
    gtest_discover_tests(${name}_test DISCOVERY_TIMEOUT 60 XML_OUTPUT_DIR ${results} PROPERTIES ${properties})
    return()
  endif()
  if(PROBEWRIGHT_SANITIZE OR PROBEWRIGHT_COVERAGE)
    list(APPEND properties TIMEOUT 3600)
  endif()
  set(entries ${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake)
  add_custom_command(
    TARGET ${name}_test POST_BUILD
    COMMAND Python3::Interpreter ${PROBEWRIGHT_SUITES_SCRIPT} $<TARGET_FILE:${name}_test> ${entries} ${results} ${name} ${properties}
    BYPRODUCTS ${entries}
    VERBATIM)
  # Entries of a program that was never built: one that fails.
  set(included ${CMAKE_CURRENT_BINARY_DIR}/${name}_entries.cmake)
  file(WRITE ${included} "if(EXISTS \"${entries}\")\n  include(\"${entries}\")\nelse()\n  add_test(${name}_test_NOT_BUILT ${name}_test_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${included})
endfunction()
