// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/history/blob_facts_source.h"

#include <algorithm>

#include "porttool/read/source_files.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

ByValue by_value(const UnitFacts& source, const UnitFacts& target) {
    if (source.kind == UnitKind::Constant && target.kind == UnitKind::Constant) return ByValue::Constant;
    return source.kind == UnitKind::Struct && target.kind == UnitKind::Struct ? ByValue::Struct : ByValue::No;
}

}  // namespace

std::string version_key(const FileVersion& file) {
    const size_t name = file.path.find_last_of('/') + 1;
    const size_t dot = file.path.find('.', name);
    return file.blob + (dot == std::string::npos ? std::string() : file.path.substr(dot));
}

void BlobFactsSource::use_dialect(const std::vector<std::pair<std::string, std::string>>& rows) {
    dialect_ = Dialect(rows);
    std::string text;
    for (const auto& [left, right] : rows) text += left + "=" + right + "\n";
    dialect_key_ = BlobCache::key({text});
}

ScannedFile BlobFactsSource::scan(const FileVersion& file) const {
    const std::string text = read_blob(past_, file.path, file.blob);
    return scan_text(file.path, unreadable_reason(text).empty() ? text : std::string());
}

const ScannedFile& BlobFactsSource::scanned(const FileVersion& file) {
    auto& kept = scanned_[file.path];
    if (kept.first != file.blob) kept = {file.blob, scan(file)};
    return kept.second;
}

const BlobFacts& BlobFactsSource::facts(const FileVersion& file) {
    const std::string version = version_key(file);
    if (const auto known = facts_.find(version); known != facts_.end()) return known->second;
    const std::string key = BlobCache::key({"facts", version});
    std::optional<BlobFacts> facts;
    if (const std::string* line = cache_.find(key)) facts = read_blob_facts(*line);
    if (!facts) {
        facts = blob_facts(scanned(file));
        cache_.put(key, facts_line(*facts));
    }
    for (const UnitFacts& unit : facts->units) places_.emplace(unit.prints.written, UnitPlace{file, unit.name});
    return facts_.emplace(version, std::move(*facts)).first->second;
}

std::string BlobFactsSource::text_at(const UnitPlace& place) const {
    const auto kept = scanned_.find(place.file.path);
    const bool is_kept = kept != scanned_.end() && kept->second.first == place.file.blob;
    const ScannedFile file = is_kept ? ScannedFile() : scan(place.file);
    const ScannedFile& there = is_kept ? kept->second.second : file;
    const auto unit =
        std::find_if(there.units.begin(), there.units.end(), [&](const Unit& one) { return one.name == place.unit; });
    return unit_state(there, unit == there.units.end() ? whole_file_unit(there) : *unit).text;
}

const std::string& BlobFactsSource::text_of(const std::string& print, const BaseBlob& base_blob) {
    if (const auto known = texts_.find(print); known != texts_.end()) return known->second;
    const auto place = places_.find(print);
    if (place != places_.end()) return texts_.emplace(print, text_at(place->second)).first->second;
    const std::string blob = base_blob(print);
    return texts_.emplace(print, blob.empty() ? std::string() : read_blob(past_, "portmap.base/" + print, blob))
        .first->second;
}

EditFacts BlobFactsSource::edits(const Fingerprints& source_before, const UnitFacts& source_now,
                                 const Fingerprints& target_before, const UnitFacts& target_now,
                                 const BaseBlob& base_blob) {
    const ByValue value = by_value(source_now, target_now);
    const std::string key =
        BlobCache::key({"changed tokens", source_before.written, source_now.prints.written, target_before.written,
                        target_now.prints.written, std::to_string(static_cast<int>(value)), dialect_key_});
    if (const std::string* line = cache_.find(key))
        if (const auto facts = read_edit_facts(*line)) return *facts;
    const EditTexts texts{text_of(source_before.written, base_blob), text_of(source_now.prints.written, base_blob),
                          text_of(target_before.written, base_blob), text_of(target_now.prints.written, base_blob)};
    const EditFacts facts = edit_facts(texts, value, dialect_);
    cache_.put(key, facts_line(facts));
    return facts;
}

}  // namespace porttool
