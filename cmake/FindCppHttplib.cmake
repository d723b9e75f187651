# SPDX-License-Identifier: MIT
# Debian's cpp-httplib has a package file for pkg-config only: finds its header and library, as CppHttplib::CppHttplib,
# with what the library was built with, which changes the header's classes.
find_path(CppHttplib_INCLUDE_DIR httplib.h)
find_library(CppHttplib_LIBRARY cpp-httplib)
mark_as_advanced(CppHttplib_INCLUDE_DIR CppHttplib_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CppHttplib REQUIRED_VARS CppHttplib_LIBRARY CppHttplib_INCLUDE_DIR)

if(CppHttplib_FOUND AND NOT TARGET CppHttplib::CppHttplib)
  find_package(Threads REQUIRED)
  add_library(CppHttplib::CppHttplib UNKNOWN IMPORTED)
  set_target_properties(CppHttplib::CppHttplib PROPERTIES IMPORTED_LOCATION "${CppHttplib_LIBRARY}"
                        INTERFACE_INCLUDE_DIRECTORIES "${CppHttplib_INCLUDE_DIR}")
  target_compile_definitions(CppHttplib::CppHttplib INTERFACE CPPHTTPLIB_OPENSSL_SUPPORT CPPHTTPLIB_ZLIB_SUPPORT
                             CPPHTTPLIB_BROTLI_SUPPORT)
  target_link_libraries(CppHttplib::CppHttplib INTERFACE Threads::Threads)
endif()
