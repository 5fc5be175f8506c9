# SPDX-License-Identifier: Apache-2.0
# Finds what the library needs; used by the build and, installed, by find_package(vdbounce).
include(CMakeFindDependencyMacro)

find_dependency(Threads)
find_dependency(Eigen3 3.4)
find_dependency(TBB)
find_dependency(PNG)
find_dependency(hwy 1.0)

# OpenVDB comes with a find module, not a package configuration; Debian puts it beside the library.
if(NOT TARGET OpenVDB::openvdb)
  find_path(VDBOUNCE_OPENVDB_MODULE FindOpenVDB.cmake
            PATHS ${CMAKE_SYSTEM_LIBRARY_PATH} PATH_SUFFIXES cmake/OpenVDB ${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB
            HINTS /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
  if(VDBOUNCE_OPENVDB_MODULE)
    list(APPEND CMAKE_MODULE_PATH ${VDBOUNCE_OPENVDB_MODULE})
  endif()
  find_dependency(OpenVDB 10)
endif()
