# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
# Cores as modules, which pathtracer loads when it needs them (docs/decisions/0031-cores-are-modules.md).
include_guard()

# Where modules lie, as installed and as built.
set(PATHTRACER_MODULES ${CMAKE_INSTALL_LIBDIR}/porttool)

# What program and module both include: a module of other texts is refused.
set(seam_headers core_api.h core_data.h core_module.h embree_probe.h hot_kernels.h path_watch.h pixel_sum.h status.h)
list(TRANSFORM seam_headers PREPEND ${PROJECT_SOURCE_DIR}/render_system/)
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${seam_headers})
set(seam "")
foreach(header ${seam_headers})
    file(SHA256 ${header} digest)
    string(APPEND seam ${digest})
endforeach()
string(SHA256 seam "${seam}")
string(SUBSTRING ${seam} 0 12 PATHTRACER_SEAM)

# goes_into_modules(LIBRARY): a static library whose objects are linked into modules as well as into programs, so that
# nothing is compiled twice. Hidden, so that no module takes a function of another, and calls stay direct.
function(goes_into_modules library)
    set_target_properties(${library} PROPERTIES POSITION_INDEPENDENT_CODE ON
        CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# add_core_module(ID SOURCE...): pathtracer-core-ID.so, as target ID_core_module. One of the sources defines
# pathtracer_core() (render_system/core_module.h). What the module lacks is told by the linker, not at its first call.
function(add_core_module id)
    add_library(${id}_core_module MODULE ${ARGN})
    goes_into_modules(${id}_core_module)
    target_link_libraries(${id}_core_module PRIVATE project_options render_system)
    target_compile_definitions(${id}_core_module PRIVATE PATHTRACER_SEAM="${PATHTRACER_SEAM}")
    set_target_properties(${id}_core_module PROPERTIES PREFIX "" OUTPUT_NAME pathtracer-core-${id}
        LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/${PATHTRACER_MODULES})
    target_link_options(${id}_core_module PRIVATE -Wl,-z,now -Wl,--exclude-libs,ALL)
    if(NOT PORTTOOL_SANITIZE)
        target_link_options(${id}_core_module PRIVATE -Wl,-z,defs)
    endif()
endfunction()
