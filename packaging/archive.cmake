# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
# The release archive porttool-VERSION-linux-ARCH.tar.gz with its SHA256SUMS: `cmake --workflow --preset static` leaves
# both in build/static/release/.
include_guard()

install(FILES LICENSE README.md DESTINATION .)
foreach(page porttool ci metrics security)
    if(EXISTS ${PROJECT_SOURCE_DIR}/docs/${page}.md)
        install(FILES docs/${page}.md DESTINATION docs)
    endif()
endforeach()

# What the program carries within itself asks that its licence goes with it.
foreach(package libgit2-dev libhttp-parser-dev libmbedtls-dev libpcre2-dev zlib1g-dev libjemalloc-dev libc6-dev libstdc++-12-dev
        libfmt-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev glslang-dev spirv-tools)
    if(NOT EXISTS /usr/share/doc/${package}/copyright)
        message(FATAL_ERROR "The licence of ${package}, which the static porttool holds, is not in /usr/share/doc: install the package")
    endif()
    install(FILES /usr/share/doc/${package}/copyright DESTINATION licenses RENAME ${package}.txt)
endforeach()

set(CPACK_GENERATOR TGZ)
set(CPACK_PACKAGE_FILE_NAME porttool-${PROJECT_VERSION}-linux-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/release)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_POST_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/packaging/same_bytes.cmake)
set(CPACK_PORTTOOL_SOURCE ${PROJECT_SOURCE_DIR})
include(CPack)
