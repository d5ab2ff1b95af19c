// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0

// Read by LeakSanitizer where it is in use. In libgit2 1.5 git_merge_base loses up to 80 bytes where a parent is not
// there, as in a shallow clone, and each key of a configuration that is not about an extension loses what libpcre2
// matched it with, where a repository has extensions. These libraries have no frame pointers, so functions cannot be
// named here; libpcre2 is called by libgit2 alone.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libgit2\nleak:libpcre2\n"; }

// Read by AddressSanitizer where it is in use: of the 30 calls that it notes for each allocation the innermost ones
// tell where it was made, and noting them all takes a tenth of the time. Undefined behaviour ends in SIGILL here.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "malloc_context_size=8:handle_sigill=1"; }
