# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
# What porttool stands on, with no shared library among it: for the preset `static`, on Debian 12.
include_guard()

# Debian has no static archive of these two; both are whole in their headers.
set(porttool_fmt fmt::fmt-header-only)
find_path(tomlplusplus_headers toml++/toml.h REQUIRED)
add_library(tomlplusplus_headers_only INTERFACE)
target_include_directories(tomlplusplus_headers_only SYSTEM INTERFACE ${tomlplusplus_headers})
target_compile_definitions(tomlplusplus_headers_only INTERFACE TOML_HEADER_ONLY=1)
set(porttool_tomlplusplus tomlplusplus_headers_only)

# libgit2 and what its local half calls: SHA-256, regular expressions, zlib, and http_parser to take addresses apart.
# What only its networking calls is left out, see packaging/no_network.cpp.
find_path(libgit2_headers git2.h REQUIRED)
add_library(libgit2_archive INTERFACE)
target_include_directories(libgit2_archive SYSTEM INTERFACE ${libgit2_headers})
foreach(archive git2 http_parser mbedcrypto pcre2-8 z)
    find_library(static_${archive} lib${archive}.a REQUIRED)
    target_link_libraries(libgit2_archive INTERFACE ${static_${archive}})
endforeach()
set(porttool_libgit2 libgit2_archive)
set(porttool_zlib ${static_z})
