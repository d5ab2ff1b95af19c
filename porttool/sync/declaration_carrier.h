// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "porttool/sync/drafts.h"
#include "porttool/sync/earlier_files.h"
#include "porttool/sync/file_statements.h"
#include "porttool/sync/includes.h"
#include "porttool/sync/knowledge.h"

namespace porttool {

/// Brings to the file of a port what the source's file declares otherwise than before, outside of units: a variable
/// that came, and the head of a function that is defined elsewhere.
///
///     source    uint repeat = 100 ;      new            the port's file, after the same neighbour:  uint repeat = 100
///     ;
///               bool check ( Keys ) ;    was void       void check ( Keys ) ;                      becomes bool
class DeclarationCarrier {
public:
    /// All must outlive it.
    DeclarationCarrier(EarlierTexts& earlier, Knowledge& knowledge, Drafts& drafts)
        : earlier_(earlier), knowledge_(knowledge), drafts_(drafts) {}

    /// The variables that came to the file of the pair's unit of the side `from`, and that can come to the port's file.
    const std::set<std::string, std::less<>>& brings(const JudgedPair& pair, Side from);
    /// Those of them that `words`, the port's new ones, use; and the heads that changed.
    void carry(const JudgedPair& pair, Side from, const std::vector<std::string>& words);

private:
    /// What came, and what it stands behind in the source's file.
    struct Arrival {
        FileStatement statement;
        std::vector<std::string> before;  ///< what stands there before it, the nearest first
    };
    struct Changes {
        std::vector<Arrival> came;
        std::vector<std::pair<FileStatement, FileStatement>> changed;  ///< heads of functions: before, now
    };
    const Changes& changes(const std::string& path, Side from);
    static size_t place_of(const Arrival& arrival, const ScannedFile& port);
    bool can_stand_in(const Arrival& arrival, const ScannedFile& file, const ScannedFile& port, Side from);

    EarlierTexts& earlier_;
    Knowledge& knowledge_;
    Drafts& drafts_;
    std::map<std::pair<Side, std::string>, Changes> changes_;
    std::map<std::pair<Side, std::pair<std::string, std::string>>, std::set<std::string, std::less<>>> brings_;
};

}  // namespace porttool
