// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The module pathtracer-images.so: the only place, but for tests, that knows OpenImageIO.
#include <OpenImageIO/imageio.h>

#include "render_system/images/image_decoder.h"
#include "render_system/images/image_library.h"

namespace render_system {

namespace {

OIIO::TypeDesc::BASETYPE type_of(SampleType type) {
    constexpr OIIO::TypeDesc::BASETYPE kTypes[] = {OIIO::TypeDesc::UINT8, OIIO::TypeDesc::UINT32,
                                                   OIIO::TypeDesc::FLOAT};
    return kTypes[static_cast<size_t>(type)];
}

class OpenFile final : public ImageFile {
public:
    explicit OpenFile(std::unique_ptr<OIIO::ImageInput> input) : input_(std::move(input)) {
        const OIIO::ImageSpec& spec = input_->spec();
        format = input_->format_name();
        width = spec.width;
        height = spec.height;
        is_flat = spec.depth == 1 && !spec.deep;
        channels = spec.channelnames;
    }

    std::string text(const std::string& name) const override {
        return std::string(input_->spec().get_string_attribute(name));
    }
    int number(const std::string& name) const override { return input_->spec().get_int_attribute(name, 0); }

    std::string read(int first, int end, SampleType type, void* values) override {
        if (input_->read_image(0, 0, first, end, type_of(type), values)) return {};
        const std::string error = input_->geterror();
        return error.empty() ? "it cannot be read" : error;
    }

private:
    std::unique_ptr<OIIO::ImageInput> input_;
};

class OpenImageIoLibrary final : public ImageLibrary {
public:
    Image decode(std::span<const std::byte> bytes, const std::string& name) override {
        return decode_image(bytes, name);
    }

    Result<std::unique_ptr<ImageFile>> open(const std::string& file) override {
        auto input = OIIO::ImageInput::open(file);
        // Asked for, or else it is kept, and told at the end of the program.
        if (!input) return Status::error(StatusCode::unreadable, OIIO::geterror());
        return std::unique_ptr<ImageFile>(std::make_unique<OpenFile>(std::move(input)));
    }
};

}  // namespace

}  // namespace render_system

render_system::ImageLibrary* pathtracer_image_library(int version) {
    static render_system::OpenImageIoLibrary library;
    return version == render_system::kImageLibraryVersion ? &library : nullptr;
}
