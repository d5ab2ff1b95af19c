// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/pair_record.h"

#include <algorithm>

#include "porttool/judge/settle.h"
#include "porttool/snapshot/lock_store.h"
#include "porttool/snapshot/map_edit.h"
#include "porttool/snapshot/snapshot.h"

namespace porttool {
namespace {

/// A disk that reads as another does, and keeps what is written to itself.
class KeptWrites final : public Disk {
public:
    explicit KeptWrites(const Disk& disk) : disk_(disk) {}
    std::vector<FileToWrite> written;

    FileText read(const std::string& path, uint64_t limit) const override { return disk_.read(path, limit); }
    FileText read(const TreePath& path, uint64_t limit) const override { return disk_.read(path, limit); }
    FolderList list(const TreePath& path) const override { return disk_.list(path); }
    FileKind kind(const TreePath& path) const override { return disk_.kind(path); }
    bool is_directory(const std::string& path) const override { return disk_.is_directory(path); }
    bool exists(const std::string& path) const override { return disk_.exists(path); }
    bool is_read_only(const TreePath& path) const override { return disk_.is_read_only(path); }
    std::string write(const std::string&, const std::string&) override { return "this disk is for reading"; }
    std::string write(const TreePath& path, const std::string& bytes) override { return write_all({{path, bytes}}); }
    std::string write_all(const std::vector<FileToWrite>& files) override {
        written.insert(written.end(), files.begin(), files.end());
        return {};
    }
    std::string remove(const TreePath&) override { return {}; }
    TakenGuard guard(const TreePath&) override { return {nullptr, "this disk is for reading"}; }

private:
    const Disk& disk_;
};

/// Without what was said of pairs that are gone, and without the deferrals of those that are in step.
void take_out(LockFile& lock, const RecordEdits& edits) {
    const auto is_among = [](const std::vector<BySide<std::string>>& pairs, const auto& line) {
        return std::any_of(pairs.begin(), pairs.end(), [&](const BySide<std::string>& pair) {
            return line.source == pair.source && line.target == pair.target;
        });
    };
    std::erase_if(lock.pairs, [&](const LockedPair& line) { return is_among(edits.removed, line); });
    std::erase_if(lock.ledger, [&](const LedgerEntry& line) {
        return is_among(edits.removed, line) || (line.verdict == Verdict::Defer && is_among(edits.in_step, line));
    });
}

}  // namespace

std::vector<FileToWrite> PairRecord::new_texts(const RecordEdits& edits) {
    Project project = without_files(checked_.project);
    std::vector<NewPair> named;
    std::vector<JudgedPair> judged;
    States states;
    for (const FreshPair& pair : edits.made) {
        named.push_back({pair.source.id, pair.target.id});
        JudgedPair one{{pair.source.id, pair.target.id}, {&pair.source, &pair.target}};
        one.changed = true;
        judged.push_back(one);
        states.source.add(pair.source);
        states.target.add(pair.target);
    }
    std::string map_text = named.empty() ? project.map_text : add_pairs(project, named);
    for (const BySide<std::string>& pair : edits.removed) map_text = remove_pair(project, {pair.source, pair.target});
    const LockFile* stands =
        checked_.against_base ? (checked_.in_project ? &*checked_.in_project : nullptr) : &checked_.lock;
    KeptWrites kept(disk_);
    if (stands == nullptr) {
        const std::string name = project.map_path.substr(project.map_path.find_last_of('/') + 1);
        return {{beside_map(project, name), map_text}};
    }
    LockFile lock = *stands;
    take_out(lock, edits);
    std::vector<const JudgedPair*> accepted;
    for (const JudgedPair& one : judged) accepted.push_back(&one);
    accept_pairs(lock, accepted, TargetSets(project.map), Looked::AtNone, "", "");
    store_lock(project, {lock, states, checked_.texts, &map_text}, kept);
    return std::move(kept.written);
}

std::map<std::string, RecordFile> PairRecord::with(const RecordEdits& edits) {
    if (!checked_.project.has_map) throw CannotDo("there is no portmap.toml to name its pair in");
    std::map<std::string, RecordFile> out;
    for (FileToWrite& file : new_texts(edits)) {
        if (file.place.root != checked_.project.root) throw CannotDo("portmap.toml lies outside of the project");
        RecordFile one{"", std::move(file.bytes), disk_.kind(file.place) == FileKind::None};
        if (!one.is_new) {
            FileText there = disk_.read(file.place, kLargestFile);
            if (!there.error.empty()) throw CannotDo(file.place.path + " " + there.error);
            one.before = std::move(there.bytes);
        }
        const bool is_map = file.place.path.ends_with(".toml");
        if (is_map && one.before != checked_.project.map_text)
            throw CannotDo("portmap.toml is not as it was judged: the index and the work tree differ");
        if (one.before != one.now) out[file.place.path] = std::move(one);
    }
    return out;
}

}  // namespace porttool
