# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
# Writes the files of porttool/difftest/prelude as C++: cmake -DOUTPUT=FILE -DFILES=FILE|FILE -P this
include(${CMAKE_CURRENT_LIST_DIR}/as_literals.cmake)
string(REPLACE "|" ";" FILES "${FILES}")

set(entries "")
foreach(file IN LISTS FILES)
    file(READ "${file}" text)
    as_literals("${text}" text)
    get_filename_component(name "${file}" NAME)
    string(APPEND entries "    if (name == \"${name}\") return ${text};\n")
endforeach()
file(WRITE "${OUTPUT}" "// Made by cmake/embed_prelude.cmake.
#include \"porttool/difftest/prelude.h\"

namespace porttool {

std::string_view prelude_file(std::string_view name) {
${entries}    return {};
}

}  // namespace porttool
")
