// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "application/core_session.h"
#include "application/options.h"

namespace application {

/// Everything that decides the bits of a sample: what parts of one picture must have in common. Each entry has a name
/// that a user knows and a value as text.
struct RunIdentity {
    std::vector<std::pair<std::string, std::string>> entries;

    /// As JSON text, and back; a text that is none gives no entries.
    std::string text() const;
    static RunIdentity read(const std::string& text);

    /// The value of that entry; empty where there is none.
    std::string value(const std::string& name) const;

    bool operator==(const RunIdentity&) const = default;
};

/// The entry of a picture that was filtered.
constexpr const char* kFilterEntry = "--filter";

/// The identity of what the session renders, once its core has started.
RunIdentity run_identity(const Options& options, CoreSession& session);

/// What differs first, as "--seed was 3 and is 4"; empty where nothing does. `then` and `now` are the two verbs, which
/// stand for the one and the other ("was" and "is").
std::string first_difference(const RunIdentity& a, const RunIdentity& b, const std::string& then,
                             const std::string& now);

}  // namespace application
