# cmake -DSOURCE=<repo> -DWORK=<folder> -P layers_test.cmake
# Each rule of cmake/check_layers.cmake rejects a tree of two rooms in which one line breaks it.
cmake_policy(VERSION 3.25)
set(src ${WORK}/src/heddle)
function(write_good_tree)
  file(REMOVE_RECURSE ${WORK})
  file(WRITE ${WORK}/cmake/layers.txt "low  :     : tbb\nhigh : low :\n")
  file(WRITE ${src}/low/CMakeLists.txt
    "heddle_add_module(low\n  PUBLIC_HEADERS open.h\n  SOURCES low.cpp)\n")
  file(WRITE ${src}/low/open.h "#include <vector>\n")
  file(WRITE ${src}/low/secret.h "")
  file(WRITE ${src}/low/low.cpp "#include <heddle/low/secret.h>\n#include <tbb/parallel_for.h>\n")
  file(WRITE ${src}/high/CMakeLists.txt
    "heddle_add_module(high INTERFACE\n  PUBLIC_HEADERS top.h)\n")
  file(WRITE ${src}/high/top.h "#include <heddle/low/open.h>\n")
  file(WRITE ${src}/heddle.h "#include <heddle/high/top.h>\n")
endfunction()

function(check_tree status_out words_out)
  execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${WORK} -P ${SOURCE}/cmake/check_layers.cmake
    RESULT_VARIABLE status OUTPUT_VARIABLE words ERROR_VARIABLE words)
  set(${status_out} ${status} PARENT_SCOPE)
  set(${words_out} "${words}" PARENT_SCOPE)
endfunction()

# Adds `line` to a file of the valid tree and expects the check to fail with `message`.
function(expect_refusal message file line)
  write_good_tree()
  file(APPEND ${WORK}/${file} "${line}\n")
  check_tree(status words)
  string(FIND "${words}" "${message}" found)
  if(status EQUAL 0 OR found EQUAL -1)
    message(SEND_ERROR "'${line}' in ${file}: expected '${message}', found (${status}):\n${words}")
  endif()
endfunction()

write_good_tree()
check_tree(status words)
if(NOT status EQUAL 0)
  message(SEND_ERROR "the tree without a mistake is refused:\n${words}")
endif()
set(high src/heddle/high)
expect_refusal("<heddle/low/secret.h> is private to room 'low'" ${high}/a.cpp
  "#include <heddle/low/secret.h>")
expect_refusal("a public header includes <heddle/low/secret.h>" src/heddle/low/open.h
  "#include <heddle/low/secret.h>")
expect_refusal("nothing in room 'extra' includes 'low'" cmake/layers.txt "extra : low :")
expect_refusal("nothing in room 'high' includes 'GLFW'" cmake/layers.txt "high : low : GLFW")
expect_refusal("'extra' names 'top', which is not listed above it" cmake/layers.txt
  "extra : low :\n        top\ntop : :")
expect_refusal("'extra' has no CMakeLists.txt" cmake/layers.txt "extra : :")
expect_refusal("room 'low' may not include room 'high'" src/heddle/low/low.cpp
  "#include <heddle/high/top.h>")
expect_refusal("room 'high' may not include <tbb/task.h>" ${high}/a.cpp "#include <tbb/task.h>")
expect_refusal("not quotes" ${high}/a.cpp "#include \"top.h\"")
expect_refusal("its folder is not in layers.txt" src/heddle/loose/a.h "#include <vector>")
expect_refusal("it may include public headers of the rooms alone" src/heddle/heddle.h
  "#include <heddle/low/secret.h>")
file(REMOVE_RECURSE ${WORK})
