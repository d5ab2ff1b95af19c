// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/scan/side.h"
#include "porttool/text/enum_names.h"
#include "porttool/text/fingerprint.h"

namespace porttool {

/// The normal form of texts, and the numbering of locals in it, that prints are of. Another number for another form: a
/// lock of an older one is read anew from portmap.base/, one of a newer one is refused.
inline constexpr int kNormalForm = 4;

/// What later versions of porttool keep beside a line's own fields: `name=value`, carried along unread. A map of which
/// an empty one is small, as nearly all are.
class MoreFields {
    using Fields = std::map<std::string, std::string>;

public:
    MoreFields() = default;
    MoreFields(const MoreFields& other) : fields_(other.empty() ? nullptr : std::make_unique<Fields>(*other.fields_)) {}
    MoreFields(MoreFields&&) noexcept = default;
    MoreFields& operator=(const MoreFields& other) { return *this = MoreFields(other); }
    MoreFields& operator=(MoreFields&&) noexcept = default;
    ~MoreFields() = default;

    bool empty() const { return fields_ == nullptr || fields_->empty(); }
    Fields::const_iterator begin() const { return get().begin(); }
    Fields::const_iterator end() const { return get().end(); }
    Fields::const_iterator find(const std::string& name) const { return get().find(name); }
    std::string& operator[](const std::string& name) {
        if (fields_ == nullptr) fields_ = std::make_unique<Fields>();
        return (*fields_)[name];
    }
    void erase(const std::string& name) { take(name); }
    /// Takes a field out; "" if there is none.
    std::string take(const std::string& name) {
        if (fields_ == nullptr) return {};
        auto node = fields_->extract(name);
        if (fields_->empty()) fields_ = nullptr;
        return node.empty() ? std::string() : std::move(node.mapped());
    }
    bool operator==(const MoreFields& other) const { return get() == other.get(); }

private:
    const Fields& get() const {
        static const Fields none;
        return fields_ == nullptr ? none : *fields_;
    }

    std::unique_ptr<Fields> fields_;
};

/// The state of a pair whose texts somebody, or something, has compared.
inline constexpr const char* kVerified = "verified";
/// How LockedPair::by begins where a person did; the day follows.
inline constexpr const char* kAcceptedBy = "accept ";

/// A pair as it was when its sides were last in step.
struct LockedPair {
    std::string source, target;
    Fingerprints source_prints, target_prints;
    std::string state = "recorded";  ///< or kVerified
    std::string by = {};             ///< what verified it, and when
    MoreFields more = {};
    int line = 0;                     ///< in the file that it was read from
    BySide<std::string> macros = {};  ///< what WordMacros::of() gave then; "" where that is not known
};

/// A text that mostly is one of a few, which take no memory of their own: a lock can have half a million lines.
class CommonText {
public:
    CommonText(std::string text = {}) : text_(common(text)) {
        if (text_ == nullptr) text_ = new std::string(std::move(text));
    }
    CommonText(const char* text) : CommonText(std::string(text)) {}
    CommonText(const CommonText& other) : text_(other.is_own() ? new std::string(*other.text_) : other.text_) {}
    CommonText(CommonText&& other) noexcept : text_(std::exchange(other.text_, &kCommon.front())) {}
    CommonText& operator=(CommonText other) noexcept {
        std::swap(text_, other.text_);
        return *this;
    }
    ~CommonText() {
        if (is_own()) delete text_;
    }

    const std::string& text() const { return *text_; }
    operator const std::string&() const { return *text_; }
    bool empty() const { return text_->empty(); }
    bool operator==(const CommonText& other) const { return *text_ == *other.text_; }
    bool operator==(std::string_view other) const { return *text_ == other; }
    bool operator==(const char* other) const { return *text_ == other; }
    auto operator<=>(const CommonText& other) const { return *text_ <=> *other.text_; }

private:
    static const std::array<std::string, 3> kCommon;  ///< "" first

    static const std::string* common(const std::string& text) {
        for (const std::string& one : kCommon)
            if (one == text) return &one;
        return nullptr;
    }
    bool is_own() const {
        return std::none_of(kCommon.begin(), kCommon.end(), [&](const std::string& one) { return &one == text_; });
    }

    const std::string* text_;
};

/// A unit that no pair watches, as it was when it was last looked at: a source unit without a counterpart is in the
/// baseline.
struct LockedUnit {
    std::string id;
    Fingerprints prints;
    CommonText reason = {};  ///< why it needs none, if somebody said so
    CommonText side = "source";
    MoreFields more = {};
    int line = 0;  ///< in the file that it was read from
};

/// How `LockedUnit::side` has a side.
constexpr const char* side_word(Side side) { return side == Side::Source ? "source" : "target"; }

/// What a person says of a finding: the pair is in step, is left as it is until a day, is left for good.
enum class Verdict : uint8_t { Accept, Defer, Ignore };
inline constexpr std::array<std::string_view, 3> kVerdictNames = {"accept", "defer", "ignore"};

constexpr std::string_view verdict_name(Verdict verdict) { return kVerdictNames.at(static_cast<size_t>(verdict)); }
constexpr std::optional<Verdict> verdict_named(std::string_view text) {
    return value_named<Verdict>(kVerdictNames, text);
}

/// A verdict that a person gave on a pair, for the texts that it had then.
struct LedgerEntry {
    Verdict verdict = Verdict::Accept;
    std::string source, target;
    Print source_print, target_print;  ///< none for a side that was not there, or whose text is not known any more
    std::string owner;
    std::string until;  ///< YYYY-MM-DD: the last day of a deferral; the day of an acceptance
    std::string reason;
    MoreFields more = {};
    int line = 0;  ///< in the file that it was read from

    /// A verdict holds for the texts that it was given for; a side that is gone (nullptr) says nothing.
    bool is_of(const Fingerprints* source_now, const Fingerprints* target_now) const {
        return (source_now == nullptr || source_print == source_now->written) &&
               (target_now == nullptr || target_print == target_now->written);
    }
};

struct LockFile {
    std::vector<LockedPair> pairs;
    std::vector<LockedUnit> baseline;
    std::vector<LedgerEntry> ledger;
    int version = 2;                ///< of the layout that was read
    int normal_form = kNormalForm;  ///< that its prints are of
};

/// A lock, or why it cannot be used and what to do.
struct ReadLock {
    LockFile lock;
    std::string error;
};

/// Reads a lock of version 1 or 2. Every print is checked to be one: they become the names of files.
ReadLock read_lock(const std::string& text);

/// The text of a lock, version 2. A fact is one line, fields apart by tabs, under a key that its ids give; lines are
/// sorted. Between any two facts of different ids stand lines that no change touches, the keys and 4,096 marks, so that
/// git merges changes of different pairs by itself: it takes changes with an unchanged line between them as apart.
std::string lock_text(const LockFile& lock);

}  // namespace porttool
