// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0

// Read by LeakSanitizer where it is in use. OpenImageIO 2.4 jumps (longjmp) out of libpng's error handler past a string
// of its own: a few bytes for each broken PNG.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:ImageInput::geterror\n"; }

// Read by AddressSanitizer where it is in use: of the 30 calls that it notes for each allocation the innermost ones
// tell where it was made, and noting them all takes a tenth of the time. Undefined behaviour ends in SIGILL here.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "malloc_context_size=8:handle_sigill=1"; }
