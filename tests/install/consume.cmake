# SPDX-License-Identifier: MIT
# Builds and runs one consumer project against what strut's build tree installs (or, as a subproject, against its source).
#   cmake -D CONSUMER=<folder here> -D COMPONENTS=<to install> -D ABSENT=<find_package names that must not be needed>
#         -D BUILD=<strut's build tree> -D SOURCE=<strut's source> -D WORK=<folder> -D CXX=<compiler> -D LAUNCHER=<or "">
#         -P consume.cmake
function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGN}\n${said}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
foreach(component ${COMPONENTS})
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix --component ${component})
endforeach()

set(absent "")
foreach(package ${ABSENT})
  list(APPEND absent -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
run(${CMAKE_COMMAND} -G Ninja -S ${CMAKE_CURRENT_LIST_DIR}/${CONSUMER} -B ${WORK}/build ${absent}
    -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_STANDARD=20 -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
    -DCMAKE_C_COMPILER_LAUNCHER=${LAUNCHER} -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF -DSTRUT_SOURCE=${SOURCE})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
if(EXISTS ${WORK}/build/consumer_by_pkg_config)
  run(${WORK}/build/consumer_by_pkg_config)
endif()

# The runtime half alone must not have brought the learning half along.
if(COMPONENTS STREQUAL runtime)
  file(GLOB_RECURSE learning ${WORK}/prefix/*learn* ${WORK}/prefix/*n4sid* ${WORK}/prefix/*strut_library*)
  file(GLOB_RECURSE runtime ${WORK}/prefix/*libstrut_runtime.a ${WORK}/prefix/include/strut/translate/translator.h)
  list(LENGTH runtime found)
  if(learning OR NOT found EQUAL 2)
    message(FATAL_ERROR "the runtime component holds ${learning} beside ${runtime}")
  endif()
endif()
