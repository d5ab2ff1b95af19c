// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/difftest/build_defines.h"
#include "porttool/difftest/defined_pieces.h"
#include "porttool/read/disk.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// Where the parts of files between their includes come in what a compiler reads.
class ReadingOrder {
public:
    /// The part of a file from this byte on is read next.
    void add(const ScannedFile& file, size_t from) { parts_[&file].emplace_back(from, ++count_); }
    std::pair<size_t, size_t> place(const ScannedFile& file, size_t offset) const;

private:
    std::map<const ScannedFile*, std::vector<std::pair<size_t, size_t>>> parts_;
    size_t count_ = 0;
};

/// What one side of a project defines, and which of it a file means by a name.
class Definitions {
public:
    /// Headers that files of the side include and that no glob names are read from the disk, beneath `root`.
    /// `preamble`: what the host puts before a text, which every file sees. `build`: what a build defines. All must
    /// outlive it.
    Definitions(const std::vector<ScannedFile>& files, const std::string& root, const Disk& disk,
                const std::vector<std::string>& preamble, const BuildDefines& build);

    /// What `from` means by the name: definitions of its own file, else of the nearest that it includes, else of
    /// another file of the side; all overloads that stand in that file.
    const std::vector<const Definition*>& find(const ScannedFile& from, std::string_view name) const;

    /// The same of a macro that a condition asks for: in what the file includes alone.
    std::vector<const Definition*> find_macro(const ScannedFile& from, std::string_view name) const;

    /// Members of a class that are defined outside of it.
    std::vector<const Definition*> members(std::string_view owner) const;

    /// Operators that what `from` reaches defines for a type, outside of classes.
    std::vector<const Definition*> operators(const ScannedFile& from, std::string_view type) const;

    /// The definition of a unit of one of the side's files.
    const Definition* of_unit(const ScannedFile& file, const Unit& unit) const;

    /// Names of namespaces, which are left out where the pieces stand in one.
    const std::set<std::string, std::less<>>& namespaces() const { return namespaces_; }

    /// The order in which a compiler sees what stands in these files, where it reads them one after another.
    ReadingOrder reading_order(const std::vector<const ScannedFile*>& files) const;

    /// True where some file of the side defines the name.
    bool defines(std::string_view name) const { return everywhere_.contains(name); }
    /// Every definition of one kind.
    std::vector<const Definition*> all_of(Definition::Kind kind) const;

    /// Headers of the standard library that a file and those that it includes ask for.
    std::set<std::string> standard_headers(const ScannedFile& from) const;
    /// The same of all that a function is made with.
    template <class Pieces>
    std::set<std::string> standard_headers(const ScannedFile& from, const Pieces& pieces) const {
        std::set<std::string> out = standard_headers(from);
        std::set<const ScannedFile*> seen = {&from};
        for (const auto& piece : pieces)
            if (seen.insert(piece.definition->file).second) out.merge(standard_headers(*piece.definition->file));
        return out;
    }

private:
    using ByName = std::map<std::string, std::vector<const Definition*>, std::less<>>;
    void add_file(const ScannedFile& file);
    void add_namespaces(const Unit& unit);
    /// What a file includes, and behind which byte.
    using Includes = std::vector<std::pair<size_t, const ScannedFile*>>;
    const Includes& includes(const ScannedFile& file) const;
    /// The file and what it includes, the nearest first.
    const std::vector<const ScannedFile*>& reached(const ScannedFile& from) const;
    /// What the build defines for a file, as a text of its own, or nullptr.
    const ScannedFile* build_text(const ScannedFile& from) const;
    /// What the file sees of texts that no file includes, behind `order`.
    std::vector<const ScannedFile*> all_reached(const ScannedFile& from) const;
    /// True for `typedef struct ALIGNED {...} NAME;` asked for as ALIGNED where that is a macro.
    bool is_macro_as_tag(const Definition& one, std::string_view name) const;
    /// A macro in the place of a function of the library, `fileno(f)`, in a header that no file includes: it stands for
    /// another system.
    bool is_of_other_system(const Definition& one) const;
    const ScannedFile* included(const ScannedFile& from, std::string_view what) const;

    const std::string& root_;
    const Disk& disk_;
    std::deque<Definition> all_;
    std::map<const ScannedFile*, ByName> by_file_;
    std::map<std::string, const ScannedFile*> paths_;
    std::map<std::string, std::vector<const Definition*>, std::less<>> everywhere_;
    std::set<std::string, std::less<>> namespaces_;
    mutable std::deque<ScannedFile> read_;
    mutable std::map<std::string, const ScannedFile*> headers_;
    mutable std::map<const ScannedFile*, Includes> includes_;
    std::set<const ScannedFile*> included_;  ///< by one of the files that the globs name
    mutable std::map<const ScannedFile*, std::vector<const ScannedFile*>> reached_;
    mutable std::map<std::pair<const ScannedFile*, std::string>, std::vector<const Definition*>> found_;
    const ScannedFile* preamble_ = nullptr;
    const BuildDefines& build_;
    mutable std::map<std::string, const ScannedFile*> build_texts_;  ///< by what stands there
    mutable std::set<const ScannedFile*> of_build_;
};

}  // namespace porttool
