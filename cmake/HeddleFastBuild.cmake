# Uses ccache and mold if they are installed: rebuilding and linking then take seconds.
if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
find_program(HEDDLE_CCACHE ccache)
if(HEDDLE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # A file with the same flags is also taken from the cache in another build folder: the paths in a
  # command, that of a precompiled header among them, are hashed relative to the build folder.
  # Precompiled headers need the sloppiness.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
    ${HEDDLE_CCACHE})
  set(CMAKE_CUDA_COMPILER_LAUNCHER ${CMAKE_CXX_COMPILER_LAUNCHER})
endif()
find_program(HEDDLE_MOLD mold)
if(HEDDLE_MOLD)
  include(CheckCXXSourceCompiles)
  set(CMAKE_REQUIRED_LINK_OPTIONS -fuse-ld=mold) # g++ before 12.1 does not know this option
  check_cxx_source_compiles("int main() {}" HEDDLE_MOLD_WORKS)
  unset(CMAKE_REQUIRED_LINK_OPTIONS)
  if(HEDDLE_MOLD_WORKS)
    add_link_options($<$<LINK_LANGUAGE:CXX>:-fuse-ld=mold>)
  endif()
endif()
