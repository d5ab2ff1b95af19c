// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0

// Read by LeakSanitizer where it is in use. OpenImageIO 2.4 jumps (longjmp) out of libpng's error handler past a string
// of its own: a few bytes for each broken PNG.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:ImageInput::geterror\n"; }
