# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
# OpenImageIO by its pkg-config file. The CMake file of Debian's package names a folder (opencv4) and programs that the
# package does not bring, and fails on a machine without them.
find_package(PkgConfig REQUIRED)
pkg_check_modules(OpenImageIO QUIET IMPORTED_TARGET GLOBAL OpenImageIO)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenImageIO
    REQUIRED_VARS OpenImageIO_LINK_LIBRARIES
    VERSION_VAR OpenImageIO_VERSION)
if(OpenImageIO_FOUND AND NOT TARGET OpenImageIO::OpenImageIO)
    add_library(OpenImageIO::OpenImageIO ALIAS PkgConfig::OpenImageIO)
endif()
