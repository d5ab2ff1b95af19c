# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
# Writes OUTPUT, a C++ file with the text of every kernel in KERNELS (names in the folder DIRECTORY, comma-separated), and of
# ARITHMETIC, a file.
# Called by the build, again whenever a kernel changes.
string(REPLACE "," ";" KERNELS "${KERNELS}")
set(text "// Made by embed_kernels.cmake; do not edit.\n#include \"source_core/device/exact_arithmetic.h\"\n#include \"source_core/device/kernel_files.h\"\n\n")
string(APPEND text "namespace source_core {\n\nconst EmbeddedKernel EMBEDDED_KERNELS[] = {\n")
list(LENGTH KERNELS count)
foreach(kernel IN LISTS KERNELS)
    file(READ "${DIRECTORY}/${kernel}" body)
    string(APPEND text "    {\"${kernel}\", R\"KERNEL(${body})KERNEL\"},\n")
endforeach()
string(APPEND text "};\nconst unsigned EMBEDDED_KERNEL_COUNT = ${count};\n")
file(READ "${ARITHMETIC}" body)
string(APPEND text "const char* const EXACT_ARITHMETIC_TEXT = R\"KERNEL(${body})KERNEL\";\n\n}  // namespace source_core\n")
file(WRITE "${OUTPUT}" "${text}")
