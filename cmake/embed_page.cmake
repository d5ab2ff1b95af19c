# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
# Writes the files of porttool/report/page as C++: cmake -DOUTPUT=FILE -DPAGES=FILE|FILE -DSCRIPTS=FILE|FILE -P this
string(REPLACE "|" ";" PAGES "${PAGES}")
string(REPLACE "|" ";" SCRIPTS "${SCRIPTS}")

# A compiler may limit a string literal to 64 KiB: long texts become several that stand side by side.
function(as_literals text out)
    set(literals "")
    string(LENGTH "${text}" length)
    set(at 0)
    while(at LESS length)
        string(SUBSTRING "${text}" ${at} 8000 piece)
        string(APPEND literals "\n    R\"page(${piece})page\"")
        math(EXPR at "${at} + 8000")
    endwhile()
    set(${out} "${literals}" PARENT_SCOPE)
endfunction()

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
