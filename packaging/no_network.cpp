// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Stands in the static porttool for the half of libgit2 that talks to networks, which porttool never calls.
//
// libgit2.a refers to it from its start-up code all the same, and with it to OpenSSL, libssh2, mbedTLS and Kerberos, of
// which the last has no static archive. Where the linker finds these few functions here, it takes none of the archive's
// members that hold them: the program then has no networking at all, and a call of it fails as an unknown protocol
// does. The names are libgit2 1.5's own; where another version has others, the program does not link.
#include <git2.h>
#include <pwd.h>

#include <cerrno>

extern "C" {

/// How a remote is reached: not at all.
int git_transport_new(git_transport** out, git_remote*, const char*) {
    *out = nullptr;
    git_error_set_str(GIT_ERROR_NET, "this porttool was built without networking");
    return GIT_ERROR;
}

/// An option of git_libgit2_opts, without anything that it would change.
bool git_http__expect_continue = false;

/// SSH and TLS have nothing to set up, and no certificates to look for.
int git_transport_ssh_global_init() { return 0; }
int git_mbedtls_stream_global_init() { return 0; }
int git_mbedtls__set_cert_location(const char*, const char*) { return GIT_ERROR; }

/// The home folder of a user, which libgit2 asks for where the real and the effective user differ. glibc's own function
/// would load NSS libraries of the system, which fit the glibc that they came with and no other.
int getpwuid_r(uid_t, passwd*, char*, size_t, passwd** result) {
    *result = nullptr;
    return ENOENT;
}

}  // extern "C"
