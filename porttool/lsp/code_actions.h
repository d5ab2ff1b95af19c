// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "porttool/lsp/diagnostics.h"
#include "porttool/lsp/documents.h"
#include "porttool/lsp/project_places.h"
#include "porttool/sync/propose.h"

namespace porttool::lsp {

/// The command that a client asks for to accept a finding; its argument is the fingerprint.
inline constexpr const char* kAcceptCommand = "porttool.accept";

/// What a client can do with actions.
struct ActionSupport {
    bool disabled = false;          ///< shows actions that cannot be taken, with the reason
    bool document_changes = false;  ///< edits with versions
    bool creates_files = false;
};

/// What `sync` proposes for pairs of one judgement, by their places there; made once for each.
class Proposals {
public:
    /// Both must outlive it.
    Proposals(const CheckedProject& project, const Disk& disk) : project_(project), disk_(disk) {}
    const SyncResult& of(size_t pair);

private:
    const CheckedProject& project_;
    const Disk& disk_;
    std::map<size_t, SyncResult> known_;
};

/// The edits that turn one text into another, as the protocol has them: whole lines.
Json text_edits(const std::string& before, const std::string& now);

/// The code actions for the diagnostics of a file that touch a range: port this edit, and accept.
Json code_actions(const CheckedProject& project, const ProjectPlaces& places, Proposals& proposals,
                  const std::string& path, const Range& range, const Documents& documents, const UriOf& uri_of,
                  const ActionSupport& support);

}  // namespace porttool::lsp
