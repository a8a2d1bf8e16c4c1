# Precompiled headers: what most files include is parsed once and not 500 times, which takes a third
# off a build. One for each set of flags, since g++ refuses one that was made with others: the
# libraries, those without errno in their mathematics, the commands (with JSON), and the tests (with
# GoogleTest).
# A file must still include what it uses: tools/tidy.sh and the CUDA compiler read it without these.
option(HEDDLE_PRECOMPILE "Precompile the headers that most files include (g++ alone)"
  ${PROJECT_IS_TOP_LEVEL})
if(NOT HEDDLE_PRECOMPILE OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  return()
endif()
set(_flags -fpch-preprocess) # for ccache
if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # false for std::string::insert, as -Wrestrict is (GCC bug 105651): g++ warns of system headers
  # too where they are precompiled
  list(APPEND _flags -Wno-stringop-overflow -Wno-array-bounds)
endif()
set(_common <heddle/base/error.h> <heddle/base/vec.h> <algorithm> <array> <atomic> <bit> <chrono>
  <cmath>
  <cstddef> <cstdint> <cstring> <filesystem> <functional> <limits> <map> <memory> <mutex> <optional>
  <set>
  <span> <sstream> <stdexcept> <string> <string_view> <type_traits> <utility> <vector>)
# CMake makes the header of a target with a source
file(WRITE ${PROJECT_BINARY_DIR}/precompile.cpp "")
function(heddle_precompile name)
  cmake_parse_arguments(A "" "" "HEADERS;OPTIONS;LIBRARIES" ${ARGN})
  add_library(heddle_precompile_${name} OBJECT EXCLUDE_FROM_ALL
    ${PROJECT_BINARY_DIR}/precompile.cpp)
  target_compile_definitions(heddle_precompile_${name}
    PRIVATE HEDDLE_HAS_CUDA=$<BOOL:${HEDDLE_CUDA}>)
  target_include_directories(heddle_precompile_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(heddle_precompile_${name} PRIVATE heddle_flags ${A_LIBRARIES})
  target_compile_options(heddle_precompile_${name} PRIVATE ${A_OPTIONS} ${_flags})
  target_precompile_headers(heddle_precompile_${name} PRIVATE ${_common} ${A_HEADERS})
endfunction()

get_property(_folders DIRECTORY PROPERTY SUBDIRECTORIES)
foreach(_folder IN LISTS _folders)
  get_property(_targets DIRECTORY ${_folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(_target IN LISTS _targets)
    get_target_property(_type ${_target} TYPE)
    if(NOT _target MATCHES "^heddle_" OR _type STREQUAL "INTERFACE_LIBRARY"
       OR _type STREQUAL "UTILITY")
      continue()
    endif()
    get_target_property(_options ${_target} COMPILE_OPTIONS)
    set(_set library)
    if(_target MATCHES "_test$")
      set(_set test)
    elseif(_target MATCHES "^heddle_cli")
      set(_set command)
    elseif("-fno-math-errno" IN_LIST _options)
      set(_set no_errno)
    endif()
    if(NOT TARGET heddle_precompile_${_set})
      if(_set STREQUAL "test")
        heddle_precompile(test HEADERS <fstream> <gtest/gtest.h>
          OPTIONS ${CMAKE_CXX_COMPILE_OPTIONS_PIE} ${HEDDLE_TEST_FLAGS} LIBRARIES GTest::gtest_main)
        set_target_properties(heddle_precompile_test PROPERTIES POSITION_INDEPENDENT_CODE OFF)
      elseif(_set STREQUAL "command")
        heddle_precompile(command HEADERS <nlohmann/json.hpp>)
      elseif(_set STREQUAL "no_errno")
        heddle_precompile(no_errno OPTIONS -fno-math-errno -fno-trapping-math)
      else()
        heddle_precompile(library)
      endif()
    endif()
    target_precompile_headers(${_target} REUSE_FROM heddle_precompile_${_set})
    target_compile_options(${_target} PRIVATE "$<$<COMPILE_LANGUAGE:CXX>:${_flags}>")
  endforeach()
endforeach()
