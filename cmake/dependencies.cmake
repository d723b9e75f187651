# SPDX-License-Identifier: MIT
# Every dependency, in one place: what, the version of Debian 12, its licence, what for. Nothing is ever downloaded.
#
#   Eigen         3.4.0    MPL-2.0     linear algebra                                  runtime, library
#   FlatBuffers   2.0.8    Apache-2.0  the model file (headers; flatc at build time)   runtime
#   oneTBB        2021.8   Apache-2.0  threads while learning                          library
#   toml++        3.3.0    MIT         pair lists                                      library
#   SQLite        3.40.1   public dom. the database of fragments and labels            library
#   LIBSVM        3.24     BSD-3       support vector regression                       library
#   fmt           9.1.0    MIT         text on the terminal                            program
#   CLI11         2.1.2    BSD-3       command line                                    program
#   nlohmann-json 3.11.2   MIT         --json, provenance                              program
#   cpp-httplib   0.11.4   MIT         the viewer's server                             program
#   GoogleTest    1.12.1   BSD-3       tests                                           developers
#   RapidCheck    2023-03  BSD-2       property tests                                  developers
#   SLICOT        5.0      GPL-2.0+    tests: an oracle; never linked into the rest    developers, optional
#   Benchmark     1.7.1    Apache-2.0  benchmarks                                      developers
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(flatbuffers REQUIRED NO_MODULE NAMES flatbuffers FlatBuffers Flatbuffers)
find_program(STRUT_FLATC flatc REQUIRED)

if(NOT STRUT_RUNTIME_ONLY)
  find_package(TBB REQUIRED)
  find_package(tomlplusplus REQUIRED)
  find_package(SQLite3 REQUIRED)
  list(PREPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
  find_package(LibSVM REQUIRED)
  list(POP_FRONT CMAKE_MODULE_PATH)
  if(STRUT_BUILD_CLI)
    find_package(fmt REQUIRED)
    find_package(CLI11 REQUIRED)
    find_package(nlohmann_json REQUIRED)
    list(PREPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
    find_package(CppHttplib REQUIRED)
    list(POP_FRONT CMAKE_MODULE_PATH)
  endif()
  if(STRUT_BUILD_TESTS)
    find_package(GTest REQUIRED)
    find_package(rapidcheck REQUIRED)
    find_package(nlohmann_json REQUIRED)
    find_library(STRUT_SLICOT slicot)
  endif()
  if(STRUT_BUILD_BENCH)
    find_package(benchmark REQUIRED)
  endif()
endif()
