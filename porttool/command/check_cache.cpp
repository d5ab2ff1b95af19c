// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/check_cache.h"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <sstream>

#include "porttool/read/clock.h"
#include "porttool/read/traced_disk.h"
#include "porttool/read/user_cache.h"
#include "porttool/text/fingerprint.h"

namespace porttool {
namespace {

constexpr uint64_t kMostCacheBytes = 64ull << 20;
/// Trees below this are judged in less time than an answer takes to be kept. PORTTOOL_CACHE_FROM names another size.
constexpr uint64_t kLeastBytesRead = 4ull << 20;
constexpr std::string_view kFirstLine = "porttool check 1\n";

uint64_t least_bytes_read() {
    const char* named = std::getenv("PORTTOOL_CACHE_FROM");
    return named == nullptr ? kLeastBytesRead : std::strtoull(named, nullptr, 10);
}

std::string sized(const std::string& text) { return fmt::format("{}\n", text.size()) + text; }

/// The text behind its size, taken off the front; none where there is not that much.
std::optional<std::string> take_sized(std::string_view& bytes) {
    const size_t end = bytes.find('\n');
    if (end == std::string_view::npos || end == 0 || end > 12) return std::nullopt;
    const uint64_t size = std::strtoull(std::string(bytes.substr(0, end)).c_str(), nullptr, 10);
    bytes.remove_prefix(end + 1);
    if (size > bytes.size()) return std::nullopt;
    std::string text(bytes.substr(0, size));
    bytes.remove_prefix(size);
    return text;
}

/// An answer that was kept.
struct Kept {
    std::string request, text, said, exit_code;
    DiskTrace trace;
};

/// None where the bytes are not what was written.
std::optional<Kept> read_kept(std::string_view bytes) {
    constexpr size_t kSumDigits = 16;
    if (!bytes.starts_with(kFirstLine) || bytes.size() < kFirstLine.size() + kSumDigits) return std::nullopt;
    const std::string_view sum = bytes.substr(bytes.size() - kSumDigits);
    bytes.remove_suffix(kSumDigits);
    if (fmt::format("{:016x}", hash_text(bytes)) != sum) return std::nullopt;
    bytes.remove_prefix(kFirstLine.size());
    Kept kept;
    for (std::string* text : {&kept.request, &kept.text, &kept.said, &kept.exit_code}) {
        auto taken = take_sized(bytes);
        if (!taken) return std::nullopt;
        *text = std::move(*taken);
    }
    auto trace = DiskTrace::read(bytes);
    if (!trace || (kept.exit_code != "0" && kept.exit_code != "1")) return std::nullopt;
    kept.trace = std::move(*trace);
    return kept;
}

std::string written(const Kept& kept) {
    std::string bytes(kFirstLine);
    for (const std::string* text : {&kept.request, &kept.text, &kept.said, &kept.exit_code}) bytes += sized(*text);
    bytes += kept.trace.bytes();
    return bytes + fmt::format("{:016x}", hash_text(bytes));
}

}  // namespace

std::string outermost_repository(const Disk& disk, const std::string& directory) {
    std::filesystem::path at = absolute_path(directory), outermost = at;
    for (; at != at.parent_path(); at = at.parent_path())
        for (const char* mark : {".git", "portmap.toml"})
            if (disk.exists(join_path(at.string(), mark))) outermost = at;
    return outermost.string();
}

std::string check_request(const Options& options, bool color) {
    const bool more_than_disk = options.no_cache || !options.base.empty() || options.staged || options.spirv ||
                                !options.run_evidence.empty() || options.trusted_map;
    const bool known_format = options.format == "text" || options.format == "json" || options.format == "junit" ||
                              options.format == "markdown";
    const std::string program = this_program();
    if (more_than_disk || !known_format || program.empty()) return {};
    std::string request = program + "\n" + today() + "\n" + options.format + (color ? " color\n" : "\n");
    for (const std::string& text : {absolute_path(options.directory), options.directory, options.config})
        request += sized(text);
    for (const auto* globs : {&options.source, &options.target}) {
        request += fmt::format("{} globs\n", globs->size());
        for (const std::string& glob : *globs) request += sized(glob);
    }
    return request + (options.strict ? "strict" : "");
}

std::unique_ptr<FactsStore> kept_facts(const Options& options, const std::string& repository) {
    const std::string program = this_program();
    if (options.no_cache || !options.run_evidence.empty() || program.empty()) return nullptr;
    return std::make_unique<FactsStore>(program + "\n" + repository, repository, least_bytes_read());
}

Outcome through_cache(const std::string& request, const std::string& repository, Workplace& place,
                      const std::function<Outcome(Workplace&)>& work) {
    const UserCache cache("check", repository);
    const std::string file = fmt::format("{:016x}", hash_text(request));
    if (const auto bytes = cache.read(file, kMostCacheBytes)) {
        const auto kept = read_kept(*bytes);
        if (kept && kept->request == request && kept->trace.holds(place.disk)) {
            place.err << kept->said;
            return {kept->text, kept->exit_code == "1" ? 1 : 0};
        }
    }
    TracedDisk disk(place.disk, least_bytes_read());
    std::ostringstream said;
    Workplace traced{disk, said};
    Outcome outcome;
    try {
        outcome = work(traced);
    } catch (...) {
        place.err << said.str();
        throw;
    }
    place.err << said.str();
    if (const DiskTrace* trace = disk.trace()) {
        const std::string kept =
            written({request, outcome.text, said.str(), std::to_string(outcome.exit_code), *trace});
        cache.write(file, {kept}, kMostCacheBytes);
    }
    return outcome;
}

}  // namespace porttool
