# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
# Writes the parts of the report's page as C++: cmake -DOUTPUT=FILE -DPAGE=FILE -DSTYLE=FILE -DSCRIPTS=FILE|FILE -P this
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

file(READ "${PAGE}" page)
file(READ "${STYLE}" style)
set(script "")
foreach(file IN LISTS SCRIPTS)
    file(READ "${file}" text)
    string(APPEND script "${text}\n")
endforeach()
as_literals("${page}" page)
as_literals("${style}" style)
as_literals("${script}" script)
file(WRITE "${OUTPUT}" "// Made by cmake/embed_page.cmake.
#include \"porttool/report/portability_page.h\"

namespace porttool {

PageParts page_parts() {
    return {${page},${style},${script}};
}

}  // namespace porttool
")
