# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
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
