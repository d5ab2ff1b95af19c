// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/source_glob.h"

#include <algorithm>

#include "porttool/language/language.h"
#include "porttool/read/disk.h"

namespace porttool {

SourceGlob::SourceGlob(const std::string& text, const std::string& root, bool sources_only)
    : glob_(path_below(root, text.empty() ? "." : text) + (text.ends_with('/') ? "/" : "")),
      own_path_(glob_.literal() ? clean_path(glob_.text()) : ""),
      names_suffix_(text.find('.', text.find_last_of('/') + 1) != std::string::npos),
      sources_only_(sources_only) {}

bool SourceGlob::takes(const std::string& path) const {
    const bool is_asked_for = !sources_only_ && (names_suffix_ || path == own_path_);
    return (is_asked_for || language_of_path(path) != Language::Unknown) && glob_.matches(path);
}

void SideGlobs::add(const std::vector<std::string>& globs) {
    for (const std::string& text : globs) globs_.emplace_back(text);
}

bool SideGlobs::takes(const std::string& path) const {
    return std::any_of(globs_.begin(), globs_.end(), [&](const SourceGlob& one) { return one.takes(path); });
}

std::vector<std::string> SideGlobs::folders() const {
    std::vector<std::string> out;
    for (const SourceGlob& one : globs_)
        for (const std::string& folder : one.glob().roots()) out.push_back(clean_path(folder));
    return out;
}

}  // namespace porttool
