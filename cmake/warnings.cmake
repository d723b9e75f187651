# SPDX-License-Identifier: MIT
# The warnings every target of the project is built with. That they are errors is said by the presets only
# (CMAKE_COMPILE_WARNING_AS_ERROR), so that a newer compiler's new warning never breaks somebody's build.
add_library(strut_warnings INTERFACE)
target_compile_options(strut_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                       -Wnon-virtual-dtor -Wold-style-cast -Wcast-qual -Woverloaded-virtual)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # g++ 12 warns of an impossible overlap inside std::string's own operator+ (GCC bug 105651).
  target_compile_options(strut_warnings INTERFACE -Wno-restrict)
endif()
