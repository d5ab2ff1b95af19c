// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/history/blob_facts_source.h"

#include <algorithm>

#include "porttool/compare/paired_names.h"
#include "porttool/language/language.h"
#include "porttool/read/lock_file.h"
#include "porttool/read/lock_upgrade.h"
#include "porttool/read/source_files.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

Language language_of_id(std::string_view id) { return language_of_path(split_id(std::string(id)).first); }

/// All that the judgement of one side rests on.
std::string key_of(const BlobFactsSource::UnitInTime& unit) {
    std::string key;
    for (const Fingerprints* prints : {&unit.before, &unit.now.prints})
        key += prints->written.text() + " " + prints->renamed.text() + " " + prints->blanked.text() + " ";
    return key + std::string(unit_kind_name(unit.now.kind)) + " " +
           std::string(traits_of(language_of_id(unit.id)).name);
}

}  // namespace

std::string version_key(const FileVersion& file) {
    const size_t name = file.path.find_last_of('/') + 1;
    const size_t dot = file.path.find('.', name);
    return file.blob + (dot == std::string::npos ? std::string() : file.path.substr(dot));
}

void BlobFactsSource::use_dialect(const MapFile& map) {
    dialect_ = dialect_of_edits(map);
    std::string text;
    for (const auto& [left, right] : map.dialect) text += left + "=" + right + "\n";
    for (const MapPair& pair : map.pairs)
        for (const std::string& target : pair.targets) text += pair.source + "=" + target + "\n";
    dialect_key_ = BlobCache::key({text});
}

std::string BlobFactsSource::text_of_blob(const std::string& path, const std::string& blob) const {
    const std::lock_guard lock(git_mutex_);
    return read_blob(past_, path, blob);
}

ScannedFile BlobFactsSource::scan(const FileVersion& file) const {
    const std::string text = text_of_blob(file.path, file.blob);
    return scan_text(file.path, unreadable_reason(text).empty() ? text : std::string());
}

std::shared_ptr<const ScannedFile> BlobFactsSource::kept(const FileVersion& file) const {
    const std::lock_guard lock(scanned_mutex_);
    const auto found = scanned_.find(file.path);
    return found != scanned_.end() && found->second.first == file.blob ? found->second.second : nullptr;
}

std::shared_ptr<const ScannedFile> BlobFactsSource::scanned(const FileVersion& file) {
    if (auto known = kept(file)) return known;
    auto fresh = std::make_shared<const ScannedFile>(scan(file));
    const std::lock_guard lock(scanned_mutex_);
    scanned_[file.path] = {file.blob, fresh};
    return fresh;
}

const BlobFacts& BlobFactsSource::facts(const FileVersion& file) {
    const std::string version = version_key(file);
    if (const auto known = facts_.find(version); known != facts_.end()) return known->second;
    const std::string key = BlobCache::key({"facts", version});
    std::optional<BlobFacts> facts;
    if (const std::string* line = cache_.find(key)) facts = read_blob_facts(*line);
    if (!facts) {
        facts = blob_facts(*scanned(file));
        cache_.put(key, facts_line(*facts));
    }
    for (const UnitFacts& unit : facts->units) places_.emplace(unit.prints.written, UnitPlace{file, unit.name});
    return facts_.emplace(version, std::move(*facts)).first->second;
}

/// The texts of all units that this version of a file is the first to have, so that each is scanned once: who asks for
/// one of them, by its print, will ask for others; but for the file as a whole.
void BlobFactsSource::read_texts(const FileVersion& version, Print wanted) {
    std::shared_ptr<const ScannedFile> file = kept(version);
    if (!file) file = std::make_shared<const ScannedFile>(scan(version));
    std::unordered_map<std::string_view, const Unit*> units;
    for (const Unit& unit : file->units) units.emplace(unit.name, &unit);
    const Unit whole = whole_file_unit(*file);
    for (const UnitFacts& one : facts(version).units) {
        const auto place = places_.find(one.prints.written);
        const bool here = place != places_.end() && place->second.file == version && place->second.unit == one.name;
        const bool useful = one.kind != UnitKind::File || one.prints.written == wanted;
        if (!here || !useful || texts_.contains(one.prints.written)) continue;
        const auto unit = units.find(one.name);
        texts_.emplace(one.prints.written, unit_state(*file, unit == units.end() ? whole : *unit->second).text);
    }
}

const NormalText& BlobFactsSource::text_of(Print print, const BaseBlob& base_blob) {
    if (const auto known = texts_.find(print); known != texts_.end()) return known->second;
    const auto place = places_.find(print);
    if (place != places_.end()) {
        read_texts(FileVersion(place->second.file), print);
        if (const auto known = texts_.find(print); known != texts_.end()) return known->second;
    }
    const std::string blob = base_blob(print);
    NormalText text;
    if (!blob.empty()) text = text_of_print(print, text_of_blob("portmap.base/" + print.text(), blob), kNormalForm);
    return texts_.emplace(print, std::move(text)).first->second;
}

EditFacts BlobFactsSource::edits(const BySide<UnitInTime>& pair, const BaseBlob& base_blob, CompareBudget& budget) {
    const std::string key = BlobCache::key({"pair", key_of(pair.source), key_of(pair.target), dialect_key_});
    if (const std::string* line = cache_.find(key))
        if (auto facts = read_edit_facts(*line)) {
            facts->refused = !budget.refusal({pair.source.id, pair.target.id}, facts->size).empty();
            return *facts;
        }
    const auto paired = [&](const UnitInTime& unit) {
        return PairedUnit{unit.id,
                          unit.now.kind,
                          language_of_id(unit.id),
                          unit.before,
                          unit.now.prints,
                          text_of(unit.before.written, base_blob),
                          text_of(unit.now.prints.written, base_blob)};
    };
    const EditFacts facts = edit_facts({paired(pair.source), paired(pair.target)}, dialect_, budget);
    if (!facts.refused) cache_.put(key, facts_line(facts));
    return facts;
}

}  // namespace porttool
