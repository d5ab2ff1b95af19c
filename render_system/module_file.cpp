// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/module_file.h"

#include <elf.h>
#include <link.h>

#include <cstring>
#include <fstream>
#include <vector>

namespace render_system {

namespace {

#if defined(__x86_64__)
constexpr auto kMachine = EM_X86_64;
#elif defined(__aarch64__)
constexpr auto kMachine = EM_AARCH64;
#else
constexpr auto kMachine = EM_NONE;  // not looked at
#endif

constexpr auto kClass = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;

bool is_for_this_machine(const ElfW(Ehdr) & head) {
    return head.e_ident[EI_CLASS] == kClass && (kMachine == EM_NONE || head.e_machine == kMachine);
}

/// Up to which byte the loader reads, by the segments that the file says it has; 0 where it cannot say.
uint64_t end_of_segments(std::ifstream& stream, const ElfW(Ehdr) & head) {
    if (head.e_phentsize != sizeof(ElfW(Phdr)) || head.e_phnum == 0) return 0;
    std::vector<ElfW(Phdr)> segments(head.e_phnum);
    const auto bytes = static_cast<std::streamsize>(segments.size() * sizeof(segments[0]));
    stream.seekg(static_cast<std::streamoff>(head.e_phoff));
    if (!stream.read(reinterpret_cast<char*>(segments.data()), bytes)) return UINT64_MAX;
    uint64_t end = 0;
    for (const auto& segment : segments)
        if (segment.p_offset + segment.p_filesz > end) end = segment.p_offset + segment.p_filesz;
    return end;
}

std::string what_is_wrong(const std::filesystem::path& file) {
    std::error_code error;
    const auto kind = std::filesystem::status(file, error).type();
    if (kind == std::filesystem::file_type::not_found)
        return std::filesystem::is_symlink(file, error) ? "is a link that leads nowhere" : "is not there";
    if (kind == std::filesystem::file_type::directory) return "is a folder";
    if (kind != std::filesystem::file_type::regular) return "is no plain file";
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return "cannot be read";
    const uint64_t size = std::filesystem::file_size(file, error);
    if (size == 0) return "is empty";
    ElfW(Ehdr) head{};
    stream.read(reinterpret_cast<char*>(&head), sizeof(head));
    const std::streamsize got = stream.gcount();
    if (got < SELFMAG || std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0) return "is no shared object";
    if (got < static_cast<std::streamsize>(sizeof(head))) return "is cut short";
    if (!is_for_this_machine(head)) return "is for another kind of machine";
    if (head.e_type != ET_DYN) return "is no shared object";
    const uint64_t end = end_of_segments(stream, head);
    if (end == 0) return "is no shared object";
    return end > size ? "is cut short" : "";
}

}  // namespace

Status check_module_file(const std::filesystem::path& file) {
    const std::string wrong = what_is_wrong(file);
    return wrong.empty() ? Status::success() : Status::error(StatusCode::unreadable, file.string() + " " + wrong);
}

}  // namespace render_system
