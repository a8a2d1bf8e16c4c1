# heddle::heddle: all installed rooms at once. With HEDDLE_SHARED it is one libheddle.so with the
# objects of all rooms; else it is a name for the static rooms. The heddle command and the tests
# link the static rooms in both cases.
get_property(HEDDLE_ROOMS GLOBAL PROPERTY HEDDLE_ROOMS)
get_property(HEDDLE_HEADERS GLOBAL PROPERTY HEDDLE_HEADERS)
get_property(HEDDLE_FOREIGN GLOBAL PROPERTY HEDDLE_FOREIGN)
list(REMOVE_DUPLICATES HEDDLE_FOREIGN)
set(HEDDLE_UMBRELLA ${PROJECT_SOURCE_DIR}/src/heddle/heddle.h)
if(NOT HEDDLE_SHARED)
  add_library(heddle_library INTERFACE)
  target_link_libraries(heddle_library INTERFACE ${HEDDLE_ROOMS})
else()
  add_library(heddle_library SHARED)
  foreach(room IN LISTS HEDDLE_ROOMS)
    get_target_property(type ${room} TYPE)
    if(type STREQUAL "STATIC_LIBRARY")
      target_sources(heddle_library PRIVATE $<TARGET_OBJECTS:${room}>)
    endif()
  endforeach()
  target_sources(heddle_library PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src
    FILES ${HEDDLE_UMBRELLA} ${HEDDLE_HEADERS})
  target_compile_definitions(heddle_library PUBLIC HEDDLE_HAS_CUDA=$<BOOL:${HEDDLE_CUDA}>)
  target_compile_features(heddle_library PUBLIC cxx_std_20)
  target_link_libraries(heddle_library PRIVATE ${HEDDLE_FOREIGN})
  # before 1.0, a minor version may change the binary interface
  set_target_properties(heddle_library PROPERTIES OUTPUT_NAME heddle EXPORT_NAME heddle
    LINKER_LANGUAGE CXX
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
endif()
add_library(heddle::heddle ALIAS heddle_library)
