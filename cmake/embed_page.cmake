# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
# Writes the files of porttool/report/page as C++: cmake -DOUTPUT=FILE -DPAGES=FILE|FILE -DSCRIPTS=FILE|FILE -P this
string(REPLACE "|" ";" PAGES "${PAGES}")
string(REPLACE "|" ";" SCRIPTS "${SCRIPTS}")

include(${CMAKE_CURRENT_LIST_DIR}/as_literals.cmake)

set(entries "")
foreach(file IN LISTS PAGES)
    file(READ "${file}" text)
    as_literals("${text}" text)
    get_filename_component(name "${file}" NAME)
    string(APPEND entries "    if (name == \"${name}\") return ${text};\n")
endforeach()
set(script "")
foreach(file IN LISTS SCRIPTS)
    file(READ "${file}" text)
    string(APPEND script "${text}\n")
endforeach()
as_literals("${script}" script)
file(WRITE "${OUTPUT}" "// Made by cmake/embed_page.cmake.
#include \"porttool/report/page.h\"

namespace porttool {

std::string_view page_file(std::string_view name) {
${entries}    return name == \"script.js\" ? std::string_view(${script}) : std::string_view();
}

}  // namespace porttool
")
