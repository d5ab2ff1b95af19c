// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/traced_disk.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <random>
#include <utility>

#include "porttool/read/git_repository.h"
#include "porttool/read/glob.h"
#include "porttool/text/fingerprint.h"
#include "porttool/text/packed_bytes.h"
#include "porttool/text/parallel.h"

namespace porttool {
namespace {

using Kind = DiskQuestion::Kind;

// Answers as texts, which are hashed.

std::string text_of(FileText file) {
    file.bytes.push_back('\0');
    file.bytes.push_back(file.by_link ? '\1' : '\2');
    return std::move(file.bytes) + file.error;
}

std::string text_of(const FolderList& list) {
    std::string text = list.error + (list.refused ? "\1" : "\2");
    for (const DirectoryEntry& entry : list.entries) {
        text.push_back('\0');
        text += entry.name;
        text.push_back(entry.is_directory ? '/' : ' ');
    }
    return text;
}

std::string text_of(FileKind kind) { return std::to_string(static_cast<int>(kind)); }

std::string text_of(bool answer) { return answer ? "yes" : "no"; }

std::string tracked_text(const std::string& root, const std::vector<std::string>& globs) {
    const std::vector<Glob> compiled(globs.begin(), globs.end());
    const auto wants = [&](const std::string& path) {
        return std::any_of(compiled.begin(), compiled.end(), [&](const Glob& glob) { return glob.matches(path); });
    };
    const TrackedFiles tracked = GitRepository(root).tracked_files(wants);
    std::string text = tracked.error;
    for (const std::string& path : tracked.files) {
        text.push_back('\0');
        text += path;
    }
    return text;
}

/// Asks a disk, or git, once.
std::string ask(const Disk& disk, const DiskQuestion& question) {
    const TreePath& place = question.place;
    switch (question.kind) {
        case Kind::ReadPath:
            return text_of(disk.read(place.path, question.limit));
        case Kind::Read:
            return text_of(disk.read(place, question.limit));
        case Kind::List:
            return text_of(disk.list(place));
        case Kind::FileKind:
            return text_of(disk.kind(place));
        case Kind::IsDirectory:
            return text_of(disk.is_directory(place.path));
        case Kind::Exists:
            return text_of(disk.exists(place.path));
        case Kind::IsReadOnly:
            return text_of(disk.is_read_only(place));
        case Kind::Tracked:
            return tracked_text(place.root, question.globs);
    }
    return {};
}

}  // namespace

TraceKey random_trace_key() {
    std::random_device device;
    const auto word = [&] { return uint64_t{device()} << 32 | device(); };
    return {word(), word()};
}

uint64_t keyed_hash(const TraceKey& key, std::string_view bytes) {
    SipHash hash(key);
    size_t at = 0;
    for (; at + sizeof(uint64_t) <= bytes.size(); at += sizeof(uint64_t)) {
        uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, sizeof(word));
        hash.word(word);
    }
    uint64_t last = 0;
    std::memcpy(&last, bytes.data() + at, bytes.size() - at);
    constexpr int kHighestByte = 56;
    return hash.finish(last | static_cast<uint64_t>(bytes.size()) << kHighestByte);
}

std::string DiskTrace::bytes() const {
    std::string out;
    ByteWriter writer(out);
    for (const uint64_t half : key) writer.number(half);
    for (const DiskQuestion& question : questions) {
        writer.number(static_cast<uint64_t>(question.kind));
        writer.text(question.place.root);
        writer.text(question.place.path);
        writer.number(static_cast<uint64_t>(question.place.links));
        writer.number(question.limit);
        writer.number<uint64_t>(question.globs.size());
        for (const std::string& glob : question.globs) writer.text(glob);
        writer.number(question.answer);
    }
    return out;
}

std::optional<DiskTrace> DiskTrace::read(std::string_view bytes) {
    ByteReader reader(bytes);
    DiskTrace trace;
    for (uint64_t& half : trace.key) half = reader.number<uint64_t>();
    while (reader.sound() && !reader.at_end()) {
        DiskQuestion question;
        const auto kind = reader.number<uint64_t>();
        if (kind > static_cast<uint64_t>(Kind::Tracked)) return std::nullopt;
        question.kind = static_cast<Kind>(kind);
        question.place.root = reader.text();
        question.place.path = reader.text();
        question.place.links = static_cast<Links>(reader.number<uint64_t>());
        question.limit = reader.number<uint64_t>();
        for (auto globs = reader.number<uint64_t>(); globs > 0 && reader.sound(); --globs)
            question.globs.emplace_back(reader.text());
        question.answer = reader.number<uint64_t>();
        trace.questions.push_back(std::move(question));
    }
    return reader.sound() ? std::optional(std::move(trace)) : std::nullopt;
}

bool DiskTrace::holds(const Disk& disk) const {
    std::atomic<bool> same{true};
    constexpr size_t kWorthThreads = 200;
    in_parallel(questions.size(), questions.size() > kWorthThreads, [&](size_t i) {
        if (same && keyed_hash(key, ask(disk, questions[i])) != questions[i].answer) same = false;
    });
    return same;
}

void TracedDisk::note(DiskQuestion question, std::string answer) const {
    if (too_many_) return;
    if (trace_.questions.size() == kMostQuestions) {
        too_many_ = true;
        trace_.questions = {};
        waiting_ = {};
        return;
    }
    bytes_answered_ += answer.size();
    if (bytes_answered_ < least_bytes_) {
        waiting_.push_back(std::move(answer));
    } else {
        for (size_t i = 0; i < waiting_.size(); ++i) trace_.questions[i].answer = keyed_hash(trace_.key, waiting_[i]);
        waiting_.clear();
        question.answer = keyed_hash(trace_.key, answer);
    }
    trace_.questions.push_back(std::move(question));
}

void TracedDisk::asked_git(const std::string& root, const std::vector<std::string>& globs) const {
    note({Kind::Tracked, {root, ""}, 0, globs}, tracked_text(root, globs));
}

FileText TracedDisk::read(const std::string& path, uint64_t limit) const {
    FileText file = disk_.read(path, limit);
    note({Kind::ReadPath, {"", path}, limit, {}}, text_of(file));
    return file;
}

FileText TracedDisk::read(const TreePath& path, uint64_t limit) const {
    FileText file = disk_.read(path, limit);
    note({Kind::Read, path, limit, {}}, text_of(file));
    return file;
}

FolderList TracedDisk::list(const TreePath& path) const {
    FolderList list = disk_.list(path);
    note({Kind::List, path, 0, {}}, text_of(list));
    return list;
}

FileKind TracedDisk::kind(const TreePath& path) const {
    const FileKind kind = disk_.kind(path);
    note({Kind::FileKind, path, 0, {}}, text_of(kind));
    return kind;
}

bool TracedDisk::is_directory(const std::string& path) const {
    const bool is = disk_.is_directory(path);
    note({Kind::IsDirectory, {"", path}, 0, {}}, text_of(is));
    return is;
}

bool TracedDisk::exists(const std::string& path) const {
    const bool exists = disk_.exists(path);
    note({Kind::Exists, {"", path}, 0, {}}, text_of(exists));
    return exists;
}

bool TracedDisk::is_read_only(const TreePath& path) const {
    const bool is = disk_.is_read_only(path);
    note({Kind::IsReadOnly, path, 0, {}}, text_of(is));
    return is;
}

std::string TracedDisk::write(const std::string& path, const std::string& bytes) {
    only_read_ = false;
    return disk_.write(path, bytes);
}

std::string TracedDisk::write(const TreePath& path, const std::string& bytes) {
    only_read_ = false;
    return disk_.write(path, bytes);
}

std::string TracedDisk::write_all(const std::vector<FileToWrite>& files) {
    only_read_ = false;
    return disk_.write_all(files);
}

std::string TracedDisk::remove(const TreePath& path) {
    only_read_ = false;
    return disk_.remove(path);
}

TakenGuard TracedDisk::guard(const TreePath& path) {
    only_read_ = false;
    return disk_.guard(path);
}

}  // namespace porttool
