# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
# What every target of ours is compiled with, as one interface target: no global flags.
include_guard()

list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

# -O3 where it pays, in the kernels and what they stand on (hot_code); a cheaper optimiser for what runs once. Sanitizer
# builds look for faults, not for speed; with them -Og compiles in about half the time of -O1.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-Og -g1")

if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release)
endif()

find_program(CCACHE ccache)
if(CCACHE)
    # The two allowances that ccache asks for to keep objects built with a precompiled header.
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
endif()

add_library(project_options INTERFACE)
target_include_directories(project_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(project_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wno-missing-field-initializers
    # The two cores promise the same bits: no fused multiply-add unless the text says so.
    -ffp-contract=off
    # GCC collects garbage from 128 MiB on, a tenth of its time; its largest run here holds less than 1 GiB.
    $<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-heapsize=1048576>)
if(PORTTOOL_WERROR)
    target_compile_options(project_options INTERFACE -Werror)
endif()
if(PORTTOOL_SANITIZE)
    # Tests look for faults in what they test, not in themselves: without UBSan they compile in two thirds of the time.
    # The price: a template that both a test and a library instantiate is linked from the test, without UBSan.
    define_property(TARGET PROPERTY PORTTOOL_TEST INITIALIZE_FROM_VARIABLE PORTTOOL_TEST)
    target_compile_options(project_options INTERFACE -fsanitize=${PORTTOOL_SANITIZE} -fno-omit-frame-pointer
        -fno-sanitize-recover=all $<$<BOOL:$<TARGET_PROPERTY:PORTTOOL_TEST>>:-fno-sanitize=undefined>)
    target_link_options(project_options INTERFACE -fsanitize=${PORTTOOL_SANITIZE})
endif()

# Link it where every cycle counts.
add_library(hot_code INTERFACE)
target_compile_options(hot_code INTERFACE $<$<CONFIG:Release>:-O3>)
