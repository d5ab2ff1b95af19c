// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "render_system/importer/importer.h"
#include "render_system/loader/load_error.h"

namespace {

void limit(decltype(RLIMIT_AS) what, uint64_t most) {
    const rlimit value{most, most};
    setrlimit(what, &value);
}

// Before anything of the file is read. A parent that is gone takes this one with it.
void limit_all(uint64_t bytes, uint64_t seconds) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#if !defined(__SANITIZE_ADDRESS__)  // which reserves terabytes
    limit(RLIMIT_AS, bytes);
#endif
    limit(RLIMIT_FSIZE, bytes);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, seconds);
    alarm(static_cast<unsigned>(3 * seconds));
}

int run(std::string_view format, const char* path, bool anywhere) {
    try {
        if (format == "obj")
            importer::import_obj(path, anywhere);
        else if (format == "fbx")
            importer::import_fbx(path);
        else
            importer::decode_draco_streams();
        return 0;
    } catch (const importer::ImportError& error) {
        std::fprintf(stderr, "%s\n", error.message.c_str());
    } catch (const render_system::LoadError& error) {
        std::fprintf(stderr, "%s\n", error.message.c_str());
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "takes more memory than a file of its size should; convert it to glTF\n");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "cannot be read (%s)\n", error.what());
    }
    return 2;
}

}  // namespace

// pathtracer-import obj|fbx|draco BYTES SECONDS [FILE [anywhere]]
int main(int count, char** arguments) {
    if (count < 4) {
        std::fprintf(stderr, "this is a part of pathtracer, which starts it where a scene needs it\n");
        return 2;
    }
    limit_all(std::strtoull(arguments[2], nullptr, 10), std::strtoull(arguments[3], nullptr, 10));
    // Its own work is done when this returns; what libraries would tidy up goes with the process.
    _exit(run(arguments[1], count > 4 ? arguments[4] : "", count > 5));
}
