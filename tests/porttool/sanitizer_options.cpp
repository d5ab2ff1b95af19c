// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0

// Read by LeakSanitizer where it is in use. In libgit2 1.5 git_merge_base loses up to 80 bytes where a parent is not
// there, as in a shallow clone. The library has no frame pointers, so its functions cannot be named here.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libgit2\n"; }
