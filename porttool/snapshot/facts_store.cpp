// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/facts_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <utility>

#include "porttool/scan/scan.h"
#include "porttool/text/fingerprint.h"
#include "porttool/text/packed_bytes.h"
#include "porttool/text/parallel.h"

namespace porttool {
namespace {

constexpr uint64_t kMostBytes = 512ull << 20;
constexpr uint64_t kMostScannedBytes = 128ull << 20;  // that new files take which stay scanned
constexpr std::string_view kFirstLine = "porttool files 2\n";

/// What a scanned file with the texts of its units takes, about.
uint64_t bytes_of(const ScannedFile& file, const std::vector<UnitState>& states) {
    constexpr uint64_t kOfUnit = sizeof(Unit) + 160, kOfWord = 12;
    uint64_t words = 0;
    for (const UnitState& state : states) words += state.text.size();
    return file.lexed.text.size() + file.lexed.tokens.size() * sizeof(Token) + file.units.size() * kOfUnit +
           words * kOfWord;
}

/// Of pieces that are one text, without a copy of them in one.
uint64_t hash_of_pieces(const TraceKey& key, const std::vector<std::string_view>& pieces) {
    std::string hashes;
    ByteWriter out(hashes);
    for (const std::string_view piece : pieces) out.number(keyed_hash(key, piece));
    return keyed_hash(key, hashes);
}

}  // namespace

FactsStore::FactsStore(std::string request, const std::string& repository, uint64_t least_bytes)
    : request_(std::move(request)),
      file_(fmt::format("{:016x}", hash_text(request_))),
      cache_("files", repository),
      least_bytes_(least_bytes) {}

void FactsStore::open() {
    if (std::exchange(is_open_, true)) return;
    if (auto bytes = cache_.read(file_, kMostBytes); bytes && read(std::move(*bytes))) return;
    kept_ = nullptr;
    found_.clear();
    key_ = random_trace_key();
}

/// A head (a first line, the key, the request, a table of hashes and sizes), the facts one after the other, and a hash
/// of the hashes of head and facts.
bool FactsStore::read(std::string bytes) {
    if (!bytes.starts_with(kFirstLine) || bytes.size() < kFirstLine.size() + sizeof(uint64_t)) return false;
    kept_ = std::make_shared<const std::string>(std::move(bytes));
    const std::string_view all = *kept_, body = all.substr(0, all.size() - sizeof(uint64_t));
    ByteReader in(body.substr(kFirstLine.size()));
    for (uint64_t& half : key_) half = in.number<uint64_t>();
    if (in.text() != request_) return false;
    const auto count = in.number<uint64_t>();
    if (count > in.left() / (2 * sizeof(uint64_t))) return false;
    ByteReader facts = in;
    facts.take(count * 2 * sizeof(uint64_t));
    std::vector<std::string_view> pieces{body.substr(0, body.size() - facts.left())};
    pieces.reserve(count + 1);
    found_.reserve(count);
    for (uint64_t i = 0; i < count; ++i) {
        const auto hash = in.number<uint64_t>();
        pieces.push_back(facts.take(in.number<uint64_t>()));
        found_.emplace(hash, pieces.back());
    }
    if (!facts.sound() || !facts.at_end()) return false;
    return ByteReader(all.substr(body.size())).number<uint64_t>() == hash_of_pieces(key_, pieces);
}

uint64_t FactsStore::hash_of(const SourceText& file, bool is_whole) const {
    std::string key;
    ByteWriter out(key);
    out.text(file.path);
    out.number<uint8_t>(is_whole);
    out.number<uint64_t>(file.text.size());
    out.number(keyed_hash(key_, file.text));
    return keyed_hash(key_, key);
}

KnownSide FactsStore::know(std::vector<SourceText> files, const std::set<std::string>& named) {
    open();
    KnownSide side(files.size());
    std::vector<Entry> entries(files.size());
    std::vector<std::shared_ptr<const std::string>> owners(files.size());  // of what is not in kept_
    const auto is_whole = [&](const SourceText& source) { return named.contains(source.path + ":@file"); };
    in_parallel(files.size(), files.size() >= kFilesWorthThreads, [&](size_t i) {
        SourceText& source = files[i];
        entries[i].hash = hash_of(source, is_whole(source));
        const auto found = found_.find(entries[i].hash);
        if (found == found_.end()) return;
        if (std::optional<FileFacts> facts = FileFacts::read(kept_, found->second)) {
            entries[i].bytes = facts->bytes();
            side[i] =
                std::make_shared<const KnownFile>(std::move(source.path), std::move(source.text), std::move(*facts));
        }
    });
    std::vector<size_t> fresh;
    for (size_t i = 0; i < files.size(); ++i)
        if (side[i] == nullptr) fresh.push_back(i);
    std::atomic<uint64_t> scanned_bytes = 0;
    in_parallel(fresh.size(), fresh.size() >= kFilesWorthThreads, [&](size_t at) {
        SourceText& source = files[fresh[at]];
        ScannedFile scanned = scan_text(source.path, source.text);
        std::vector<UnitState> states = states_of(scanned, is_whole(source));
        const auto bytes = std::make_shared<const std::string>(FileFacts::pack(scanned, states));
        std::optional<FileFacts> facts = FileFacts::read(bytes, *bytes);
        entries[fresh[at]].bytes = facts->bytes();
        owners[fresh[at]] = bytes;
        entries[fresh[at]].is_new = true;
        const uint64_t takes = bytes_of(scanned, states);
        const bool stay_scanned = scanned_bytes.fetch_add(takes) + takes <= kMostScannedBytes;
        side[fresh[at]] =
            stay_scanned
                ? std::make_shared<const KnownFile>(std::move(source.path), std::move(source.text), std::move(*facts),
                                                    std::move(scanned), std::move(states))
                : std::make_shared<const KnownFile>(std::move(source.path), std::move(source.text), std::move(*facts));
    });
    known_.insert(known_.end(), entries.begin(), entries.end());
    owners_.insert(owners_.end(), owners.begin(), owners.end());
    return side;
}

void FactsStore::save() {
    constexpr size_t kWorthIt = 64;  // a part of so many files is scanned again in less time than all are written
    const auto fresh = static_cast<size_t>(
        std::count_if(known_.begin(), known_.end(), [](const Entry& entry) { return entry.is_new; }));
    if (fresh == 0 || (kept_ != nullptr && fresh < known_.size() / kWorthIt)) return;
    std::vector<Entry> entries = known_;
    std::unordered_map<uint64_t, std::string_view> others = found_;  // as of another branch
    uint64_t bytes = 0, other_bytes = 0;
    for (const Entry& entry : known_) {
        others.erase(entry.hash);
        bytes += entry.bytes.size();
    }
    for (const auto& [hash, facts] : others) other_bytes += facts.size();
    if (other_bytes <= bytes)
        for (const auto& [hash, facts] : others) entries.push_back({hash, facts, false});
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.hash < b.hash; });
    entries.erase(
        std::unique(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.hash == b.hash; }),
        entries.end());
    std::string head(kFirstLine);
    ByteWriter writer(head);
    for (const uint64_t half : key_) writer.number(half);
    writer.text(request_);
    writer.number<uint64_t>(entries.size());
    for (const Entry& entry : entries) {
        writer.number(entry.hash);
        writer.number<uint64_t>(entry.bytes.size());
    }
    std::vector<std::string_view> pieces{head};
    for (const Entry& entry : entries) pieces.push_back(entry.bytes);
    std::string tail;
    ByteWriter(tail).number(hash_of_pieces(key_, pieces));
    pieces.push_back(tail);
    cache_.write(file_, pieces, kMostBytes);
}

}  // namespace porttool
