// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/earlier_files.h"

#include "porttool/read/git_repository.h"

namespace porttool {

std::map<std::string, std::string> EarlierFiles::read(Side side, const std::set<std::string>& paths) const {
    if (paths.empty()) return {};
    const GitRepository repository(side == Side::Target ? target_root(checked_.project) : checked_.project.root);
    if (!repository.error().empty()) return {};
    GitFiles files = repository.files_at_base(revision_, [&](const std::string& path) { return paths.contains(path); });
    return files.error.empty() ? std::move(files.files) : std::map<std::string, std::string>();
}

const std::string* EarlierTexts::of(Side side, const std::string& path) {
    if (!texts_[side]) texts_[side] = files_.read(side, expected_[side]);
    const auto found = texts_[side]->find(path);
    return found == texts_[side]->end() ? nullptr : &found->second;
}

}  // namespace porttool
