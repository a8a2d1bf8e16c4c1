# heddle_add_module(<room> [INTERFACE] [NO_INSTALL] PUBLIC_HEADERS ... [SOURCES ...]
#                   [CUDA_SOURCES ...] [TESTS ...] [DEPS ...] [PRIVATE_DEPS ...] [TEST_DEPS ...])
# One call per folder: target heddle_<room>, alias heddle::<room>, test binary heddle_<room>_test.
# cmake/HeddleLibrary.cmake and HeddleInstall.cmake make and install heddle::heddle from global
# properties that the calls record: the installed rooms, their public headers and the foreign
# libraries that they link.
# the core: a C++20 compiler, and oneTBB or std::thread
set(HEDDLE_CORE_ROOMS base executor geom sggx voxel leaf_table flake yarn surface voxelize/block
  voxelize/chord voxelize/fiber
  voxelize/triangle voxelize lod device/level device)
add_library(heddle_flags INTERFACE)
set(_w -Wall -Wextra -Wshadow -Wconversion -Wdouble-promotion -Wundef -Wnon-virtual-dtor
  -Woverloaded-virtual -ffp-contract=off
  -fno-semantic-interposition) # lets g++ -fPIC inline exported functions
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  list(APPEND _w -Wno-restrict) # false at -O3 for "text" + std::string (GCC bug 105651)
endif()
# For the core, whose bits must not depend on what is inlined where: g++ 12 vectorizes neighbouring
# statements (double)(float)x, from -O2 on, and leaves both conversions out. Loops are not affected.
set(HEDDLE_CORE_OPTIONS
  "$<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fno-tree-slp-vectorize>"
  "$<$<COMPILE_LANGUAGE:CUDA>:-Xcompiler=-fno-tree-slp-vectorize>")
target_compile_options(heddle_flags INTERFACE
  "$<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>:${_w}>"
  "$<$<AND:$<BOOL:${HEDDLE_WERROR}>,$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>>:-Werror>"
  "$<$<COMPILE_LANGUAGE:CUDA>:--fmad=false;--expt-relaxed-constexpr;-lineinfo;-Xcompiler=-Wall,-Wextra,-ffp-contract=off>"
  "$<$<AND:$<BOOL:${HEDDLE_WERROR}>,$<COMPILE_LANGUAGE:CUDA>>:-Werror=all-warnings>")
function(heddle_add_module path)
  string(REPLACE "/" "_" room ${path}) # io/vdb is target heddle_io_vdb
  cmake_parse_arguments(A "INTERFACE;NO_INSTALL" ""
    "PUBLIC_HEADERS;SOURCES;CUDA_SOURCES;TESTS;DEPS;PRIVATE_DEPS;TEST_DEPS" ${ARGN})
  if(A_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "heddle_add_module(${room}): unknown argument(s): ${A_UNPARSED_ARGUMENTS}")
  endif()
  set(scope PUBLIC)
  if(A_INTERFACE)
    set(scope INTERFACE)
    add_library(heddle_${room} INTERFACE)
  else()
    add_library(heddle_${room} STATIC ${A_SOURCES})
    if(HEDDLE_CUDA)
      target_sources(heddle_${room} PRIVATE ${A_CUDA_SOURCES})
    endif()
  endif()
  add_library(heddle::${room} ALIAS heddle_${room})
  target_sources(heddle_${room} ${scope} FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src FILES
    ${A_PUBLIC_HEADERS})
  target_compile_definitions(heddle_${room} ${scope} HEDDLE_HAS_CUDA=$<BOOL:${HEDDLE_CUDA}>)
  target_compile_features(heddle_${room} ${scope} cxx_std_20)
  # our warnings are for us: a project that links an installed heddle does not get them
  target_link_libraries(heddle_${room} ${scope} $<BUILD_INTERFACE:heddle_flags> ${A_DEPS})
  if(NOT A_INTERFACE AND path IN_LIST HEDDLE_CORE_ROOMS)
    target_compile_options(heddle_${room} PRIVATE ${HEDDLE_CORE_OPTIONS})
  endif()
  if(NOT A_INTERFACE)
    target_link_libraries(heddle_${room} PRIVATE ${A_PRIVATE_DEPS})
  endif()
  set_target_properties(heddle_${room} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON EXPORT_NAME
    ${room})
  if(NOT A_NO_INSTALL)
    set_property(GLOBAL APPEND PROPERTY HEDDLE_ROOMS heddle_${room})
    list(TRANSFORM A_PUBLIC_HEADERS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE headers)
    set_property(GLOBAL APPEND PROPERTY HEDDLE_HEADERS ${headers})
    set(foreign ${A_DEPS} ${A_PRIVATE_DEPS})
    list(FILTER foreign EXCLUDE REGEX "^heddle::")
    set_property(GLOBAL APPEND PROPERTY HEDDLE_FOREIGN ${foreign})
    if(path IN_LIST HEDDLE_CORE_ROOMS)
      set_property(GLOBAL APPEND PROPERTY HEDDLE_CORE_TARGETS heddle_${room})
    endif()
  endif()
  if(HEDDLE_TESTS AND A_TESTS)
    find_package(GTest REQUIRED)
    include(GoogleTest)
    add_executable(heddle_${room}_test ${A_TESTS})
    target_link_libraries(heddle_${room}_test PRIVATE heddle::${room} ${A_TEST_DEPS}
      GTest::gtest_main)
    target_compile_options(heddle_${room}_test PRIVATE ${HEDDLE_TEST_FLAGS})
    # of real data
    target_compile_definitions(heddle_${room}_test
      PRIVATE HEDDLE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    gtest_discover_tests(heddle_${room}_test TEST_PREFIX "${room}." PROPERTIES LABELS
      "unit\;${room}")
  endif()
endfunction()
