# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
# Writes OUTPUT, a C++ file with the text of every file in TEXTS (names from the folder DIRECTORY, comma-separated).
string(REPLACE "," ";" TEXTS "${TEXTS}")
set(text "// Made by embed_kernel_texts.cmake; do not edit.\n#include \"target_core/device/kernel_texts.h\"\n\n")
string(APPEND text "namespace target_core {\n\nstd::vector<render_system::KernelText> kernel_texts() {\n    return {\n")
foreach(file IN LISTS TEXTS)
    file(READ "${DIRECTORY}/${file}" body)
    string(APPEND text "    {\"target_core/${file}\", R\"TEXT(${body})TEXT\"},\n")
endforeach()
string(APPEND text "    };\n}\n\n}  // namespace target_core\n")
file(WRITE "${OUTPUT}" "${text}")
