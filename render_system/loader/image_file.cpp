// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <new>
#include <string>

#include "render_system/loader/file_bytes.h"
#include "render_system/loader/image_reader.h"
#include "render_system/loader/load_error.h"
#include "render_system/scene_loader.h"

namespace render_system {

Result<Image> load_image(const std::filesystem::path& path) {
    try {
        const FileBytes file(path);
        return read_image(file.bytes(), path.string());
    } catch (const LoadError& error) {
        return Status::error(error.code, path.string() + ": " + error.message);
    } catch (const std::bad_alloc&) {
        return Status::error(StatusCode::unreadable,
                             path.string() + ": the picture does not fit this machine's memory");
    } catch (const std::exception& error) {
        return Status::error(StatusCode::unreadable, path.string() + ": cannot be read (" + error.what() + ")");
    }
}

}  // namespace render_system
