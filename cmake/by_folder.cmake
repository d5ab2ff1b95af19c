# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
# Most of what a small file costs to compile is parsing headers and the templates that it uses of them, so in a release
# build the files of a folder are compiled together. In all other builds each file stands alone, which shows an #include
# that is missing.
include_guard()

# What nearly every file includes, parsed once for all files of a target: a second less for each. In other builds each
# file parses what it includes, for the reason above.
set(usual_headers <algorithm> <array> <charconv> <cmath> <deque> <filesystem> <functional> <map> <memory> <optional>
    <set> <span> <string> <string_view> <unordered_map> <unordered_set> <utility> <vector>)

# precompile(TARGET [HEADER...]): headers that are parsed once beside the usual ones. For a target of many folders.
function(precompile target)
    if(CMAKE_BUILD_TYPE STREQUAL "Release")
        target_precompile_headers(${target} PRIVATE ${usual_headers} ${ARGN})
    endif()
endfunction()

# FOLDER=NEIGHBOUR: folders whose own code is less than what they include are compiled with the files of another.
set(neighbours bias=locate cluster=locate comparison=locate history=effort language=scan live=lsp spirv=lsp
    value_graph=normal)

# compile_by_folder(TARGET): names in unnamed namespaces must then be unique among the target's files of one folder and
# its neighbours, which tests/one_definition_test.py holds.
function(compile_by_folder target)
    if(NOT CMAKE_BUILD_TYPE STREQUAL "Release")
        return()
    endif()
    set(most_files 8)  # so that building again after an edit stays short
    if(PORTTOOL_SANITIZED_TESTS)
        set(most_files 25)  # most build everything then, and once
    endif()
    get_target_property(sources ${target} SOURCES)
    list(FILTER sources INCLUDE REGEX "[.]cpp$")
    set(folders "")
    foreach(source ${sources})
        cmake_path(GET source PARENT_PATH folder)
        foreach(pair ${neighbours})
            string(REGEX MATCH "(.*)=(.*)" pair ${pair})
            string(REGEX REPLACE "(^|/)${CMAKE_MATCH_1}$" "\\1${CMAKE_MATCH_2}" folder "${folder}")
        endforeach()
        string(MAKE_C_IDENTIFIER "in_${folder}" folder)
        list(APPEND folders ${folder})
        list(APPEND files_of_${folder} ${source})
    endforeach()
    list(REMOVE_DUPLICATES folders)
    foreach(folder ${folders})
        list(LENGTH files_of_${folder} count)
        math(EXPR parts "(${count} + ${most_files} - 1) / ${most_files}")
        set(place 0)
        foreach(source ${files_of_${folder}})
            math(EXPR part "${place} * ${parts} / ${count}")
            math(EXPR place "${place} + 1")
            set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${part})
        endforeach()
    endforeach()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    # A class with a member of a local type is no danger where its file is compiled only once.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()
