# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
# Man pages, shell completion, and Debian packages of what was built: `cpack --preset porttool` packs the gate alone as
# porttool_VERSION_ARCH.deb, `cpack --preset release` all of it as porttool-suite_VERSION_ARCH.deb, into build/PRESET/packages/;
# where there is MPI the program that needs it is a package of its own, pathtracer-mpi_VERSION_ARCH.deb.
include_guard()

find_package(Python3 COMPONENTS Interpreter QUIET)
if(Python3_FOUND AND NOT PORTTOOL_SANITIZE)
    # manuals_of(PROGRAM): what its command table says, as man pages and completion. Made when the program is linked.
    function(manuals_of program)
        set(folder ${PROJECT_BINARY_DIR}/manuals/${program})
        add_custom_command(OUTPUT ${folder}/made
            COMMAND ${CMAKE_COMMAND} -E rm -rf ${folder}
            COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/packaging/manuals.py $<TARGET_FILE:${program}> ${folder}/share
            COMMAND ${CMAKE_COMMAND} -E touch ${folder}/made
            DEPENDS ${program} ${PROJECT_SOURCE_DIR}/packaging/manuals.py
            COMMENT "Writing the manual of ${program}" VERBATIM)
        add_custom_target(manual_of_${program} ALL DEPENDS ${folder}/made)
        install(DIRECTORY ${folder}/share/ DESTINATION ${CMAKE_INSTALL_DATADIR})
    endfunction()
    manuals_of(porttool)
    if(TARGET pathtracer)
        manuals_of(pathtracer)
    endif()
else()
    message(STATUS "packaging: no Python 3, or a build with sanitizers; man pages and completion are left out")
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The porttool authors <maintainers@users.noreply.h-seed-e2a13570.example>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE gzip)
if(PORTTOOL_WITH_RENDERER)
    set(CPACK_PACKAGE_NAME porttool-suite)
    set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "porting maintenance: porttool, and the path tracer it was made for")
    set(CPACK_DEBIAN_PACKAGE_PROVIDES porttool)
    set(CPACK_DEBIAN_PACKAGE_CONFLICTS porttool)
    set(CPACK_DEBIAN_PACKAGE_REPLACES porttool)
    set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "mesa-vulkan-drivers, git")
    if(TARGET pathtracer-mpi)
        set(CPACK_DEB_COMPONENT_INSTALL ON)
        set(CPACK_COMPONENTS_ALL Unspecified mpi)
        set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_NAME porttool-suite)
        set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_SUGGESTS pathtracer-mpi)
        set(CPACK_DEBIAN_MPI_PACKAGE_NAME pathtracer-mpi)
        set(CPACK_DEBIAN_MPI_DESCRIPTION "pathtracer of porttool-suite on many machines, under mpirun")
        set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "porttool-suite (= ${PROJECT_VERSION}), openmpi-bin")
        foreach(relation PROVIDES CONFLICTS REPLACES RECOMMENDS)
            set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_${relation} "${CPACK_DEBIAN_PACKAGE_${relation}}")
            unset(CPACK_DEBIAN_PACKAGE_${relation})
        endforeach()
    endif()
else()
    set(CPACK_PACKAGE_NAME porttool)
    set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "finds what was not ported between two code bases")
    set(CPACK_DEBIAN_PACKAGE_CONFLICTS porttool-suite)
    set(CPACK_DEBIAN_PACKAGE_RECOMMENDS git)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_PACKAGE_NAME} RENAME copyright)
if(TARGET pathtracer-mpi)
    install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/pathtracer-mpi RENAME copyright
        COMPONENT mpi)
endif()
include(CPack)
