// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <utility>

#include "porttool/sync/drafts.h"
#include "porttool/sync/earlier_files.h"
#include "porttool/sync/includes.h"
#include "porttool/sync/knowledge.h"

namespace porttool {

/// Brings to the files of ports the includes that came to the files of their pairs.
class IncludeCarrier {
public:
    /// All must outlive it.
    IncludeCarrier(const CheckedProject& checked, EarlierTexts& earlier, Knowledge& knowledge, Drafts& drafts)
        : checked_(checked), earlier_(earlier), knowledge_(knowledge), drafts_(drafts) {}

    /// Once for each two files of pairs: the includes that came to the side `from`.
    void carry(const JudgedPair& pair, Side from);

private:
    std::string said_there(const std::string& what, const ScannedFile& file, const ScannedFile& port, Side from) const;
    std::string own_there(const std::string& name, const ScannedFile& port, Side from) const;

    const CheckedProject& checked_;
    EarlierTexts& earlier_;
    Knowledge& knowledge_;
    Drafts& drafts_;
    std::set<std::pair<std::string, std::string>> done_;
};

}  // namespace porttool
