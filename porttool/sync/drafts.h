// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>

#include "porttool/judge/check_project.h"
#include "porttool/sync/indent_steps.h"
#include "porttool/sync/pair_record.h"
#include "porttool/sync/rescan.h"

namespace porttool {

/// A file of a project whose target may lie in another checkout, where a path alone does not name one.
struct ProposedPlace {
    std::string path;           ///< relative to the root of its side
    bool is_elsewhere = false;  ///< beneath `target_root`; else beneath the project's root, whichever side it is of
    auto operator<=>(const ProposedPlace&) const = default;
};

/// A file that proposals write, as it is and as it becomes.
struct ProposedFile {
    std::string before, now;
};

using ProposedFiles = std::map<ProposedPlace, ProposedFile>;

const Unit* unit_named(const ScannedFile& file, const std::string& id);

/// Which unit of a file has an id: for one that is asked for unit by unit.
class UnitPlaces {
public:
    explicit UnitPlaces(const ScannedFile& file);
    /// In that file, or one that has the same units in the same order; nullptr for none.
    const Unit* find(const ScannedFile& file, const std::string& id) const;

private:
    std::unordered_map<std::string, size_t> places_;  ///< by name
};

/// A file of the side that is written, as the patches before have left it.
struct Draft {
    std::string bytes, original;
    ScannedFile scanned;
    ProposedPlace place;
    bool is_linked = false;  ///< a link, or behind one: read like any other file, and never written
    // What is found out when it is asked for, and kept while units change one by one: files are long and edits short.
    std::optional<UnitPlaces> units;
    std::optional<IndentSteps> indents;
    std::optional<bool> is_as_scanned;

    /// nullptr for none.
    const Unit* unit(const std::string& id);
    std::string indent();
    /// True if the bytes are the scanned text, without line ends or spliced lines of their own.
    bool has_scanned_text();
};

/// What to say of such a file.
inline constexpr const char* kIsLinked = "is a link, or lies behind one";

/// True for a file that a link leads to: what git, and a trial in another work tree, know of it is the link.
bool lies_behind_link(const TreePath& place, const Disk& disk);

/// The files that the proposals of one run write, one proposal on top of the other.
class Drafts {
public:
    /// Both must outlive it.
    Drafts(const CheckedProject& checked, const Disk& disk) : checked_(checked), disk_(disk) {}

    /// The file as the patches so far have left it. Throws CannotDo if it cannot be read.
    Draft& of(Side side, const ScannedFile& file);
    /// The same of a file that some patch, or a question, has touched; else nullptr.
    const Draft* find(Side side, const std::string& path) const;
    void write(Draft& draft, std::string bytes, ScannedFile scanned);
    /// Of a draft that has the scanned text, where that became another one already: by rescan_unit().
    void write_rescanned(Draft& draft, const RescannedLines& lines);
    /// What the project's own files become; in place of what was said of them before.
    void write_record(std::map<std::string, RecordFile> files) { records_ = std::move(files); }

    /// From here on a proposal is made.
    void begin();
    /// All is as it was there.
    void take_back();
    /// What came since then, as one patch: of the side's files, and of the project's own.
    std::string patch() const;
    std::string record_patch() const;

    /// All files that are other ones now.
    ProposedFiles files() const;

private:
    /// What a draft was: whole, or but for the bytes that took the place of others.
    struct Before {
        std::string bytes;
        std::optional<RescannedLines> lines;
    };
    static std::string whole(const Before& before, const std::string& now);
    static std::string patch_of_lines(const Before& before, const Draft& draft);
    ProposedPlace place_of(Side side, const std::string& path) const;

    const CheckedProject& checked_;
    const Disk& disk_;
    std::map<ProposedPlace, Draft> drafts_;
    std::map<std::string, RecordFile> records_, records_before_;
    std::map<ProposedPlace, Before> before_;  ///< of drafts that were written since begin()
};

}  // namespace porttool
