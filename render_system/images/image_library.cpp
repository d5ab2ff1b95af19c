// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/images/image_library.h"

#include "render_system/images/exr_writer.h"
#include "render_system/images/png_codec.h"
#include "render_system/loader/image_reader.h"
#include "render_system/loader/load_error.h"
#include "render_system/modules.h"

// A test that is to see into the library has its objects itself.
#pragma weak pathtracer_image_library

namespace render_system {

namespace {

constexpr const char* kModule = "pathtracer-images.so";

Result<ImageLibrary*> load_library() {
    auto* entry = &pathtracer_image_library;
    std::string from = "this program";
    if (entry == nullptr) {
        const auto file = find_module(kModule);
        if (!file.ok()) return file.status;
        const auto address = load_module(*file, "pathtracer_image_library");
        if (!address.ok()) return address.status;
        entry = reinterpret_cast<decltype(entry)>(*address);
        from = file->string();
    }
    ImageLibrary* library = entry(kImageLibraryVersion);
    if (library == nullptr)
        return Status::error(StatusCode::not_found, from + " is of another version; install the program anew");
    return library;
}

}  // namespace

Result<ImageLibrary*> image_library() {
    static const Result<ImageLibrary*> library = load_library();
    return library;
}

Image read_image(std::span<const std::byte> bytes, const std::string& name) {
    if (is_png(bytes)) return decode_png(bytes);
    const auto library = image_library();
    // A program that is not whole draws no pictures with placeholders.
    if (!library.ok()) throw LoadError{StatusCode::unreadable, "cannot be read: " + library.status.message, true};
    return (*library)->decode(bytes, name);
}

Result<std::string> encode_image(const ImageToWrite& image) {
    return image.format == "png" ? encode_png(image) : encode_exr(image);
}

}  // namespace render_system
