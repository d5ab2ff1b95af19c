// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cerrno>

#include "render_system/importer/importer.h"

namespace importer {

void write_out(const void* data, size_t size) {
    const char* at = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = write(STDOUT_FILENO, at, size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) throw ImportError{"is larger than what is left of memory"};
        at += written;
        size -= static_cast<size_t>(written);
    }
}

}  // namespace importer
