# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
# What reads foreign files is tested once more under ASan and UBSan, in the same build: its libraries are compiled a
# second time and linked with the objects that the tests have anyway. So a test is compiled once. The sanitized objects
# come first on the link line: of a template that both sides instantiate, theirs is taken.
include_guard()
option(PORTTOOL_SANITIZED_TESTS "Build the libraries that read foreign files a second time, under ASan and UBSan" OFF)
# What is compiled quickly runs slowly: a long run of the fuzzers is done in half of the time with -O2.
set(PORTTOOL_SANITIZED_LEVEL -Og CACHE STRING "How far what runs under sanitizers is optimised")
if(PORTTOOL_SANITIZE)
    set(PORTTOOL_SANITIZED_TESTS OFF)  # everything is sanitized already
endif()
# Undefined behaviour ends in a trap, which ASan reports with the file and line of each call on the stack: without the
# texts of UBSan's messages a sixth less is compiled.
set(sanitizers -fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=all
    -fsanitize-undefined-trap-on-error)

# add_sanitized(LIBRARY [FOLDER...]) adds LIBRARY_sanitized: the objects of a library, or of those of its folders that
# are named, compiled under sanitizers. The other folders' objects come from the library itself.
function(add_sanitized library)
    if(NOT PORTTOOL_SANITIZED_TESTS)
        return()
    endif()
    foreach(property SOURCES LINK_LIBRARIES COMPILE_OPTIONS)
        get_target_property(${property} ${library} ${property})
        if(NOT ${property})
            set(${property} "")
        endif()
    endforeach()
    if(ARGN)
        list(JOIN ARGN "|" folders)
        list(FILTER SOURCES INCLUDE REGEX "^(${folders})/")
    endif()
    add_library(${library}_sanitized OBJECT EXCLUDE_FROM_ALL ${SOURCES})
    target_link_libraries(${library}_sanitized PRIVATE ${LINK_LIBRARIES})
    # Looking for what deserves a warning takes a fourteenth of the time, and the library's own optimizer sees more of it:
    # warnings are errors there, in all of its folders, and looked for once.
    set_target_properties(${library} PROPERTIES COMPILE_WARNING_AS_ERROR ON)
    target_compile_options(${library}_sanitized PRIVATE ${COMPILE_OPTIONS} ${PORTTOOL_SANITIZED_LEVEL} -g1 -UNDEBUG -w
        ${sanitizers})
    compile_by_folder(${library}_sanitized)
endfunction()

# Adds PROGRAM_sanitized: the objects of a program with the sanitized objects of the libraries named after it.
function(add_sanitized_program program)
    if(NOT PORTTOOL_SANITIZED_TESTS)
        return()
    endif()
    set(objects "")
    foreach(library ${ARGN})
        list(APPEND objects $<TARGET_OBJECTS:${library}_sanitized>)
    endforeach()
    get_target_property(links ${program} LINK_LIBRARIES)
    add_executable(${program}_sanitized EXCLUDE_FROM_ALL ${objects} $<TARGET_OBJECTS:${program}>)
    target_link_libraries(${program}_sanitized PRIVATE ${links})
    target_link_options(${program}_sanitized PRIVATE -fsanitize=address,undefined)
    set_target_properties(${program}_sanitized PROPERTIES LINKER_LANGUAGE CXX OUTPUT_NAME ${program}
        RUNTIME_OUTPUT_DIRECTORY ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/sanitized)
endfunction()
