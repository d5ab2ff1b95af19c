// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <utility>

#include "porttool/normal/normal_text.h"

namespace porttool {

/// Gives the normal texts of a file's units once they are asked for. Any thread may ask.
class TextSource {
public:
    virtual ~TextSource() = default;
    /// The text lives as long as its source.
    virtual const NormalText& text(uint32_t unit) const = 0;
    /// Calls visit(name) for each name and keyword of that text, once or more often.
    virtual void each_name(uint32_t unit, const std::function<void(std::string_view)>& visit) const = 0;
};

/// The normal text of a unit: at hand, or, where all that is known of it is what a check mostly needs, still with its
/// source. Reads as the text itself.
class UnitText {
public:
    UnitText() = default;
    UnitText(NormalText text) : own_(std::move(text)) {}
    /// A text of `words` words.
    UnitText(std::shared_ptr<const TextSource> source, uint32_t unit, uint32_t words)
        : source_(std::move(source)), unit_(unit), words_(words) {}

    /// Hands the text over; nothing is left of it here.
    NormalText take() { return source_ == nullptr ? std::move(own_) : source_->text(unit_); }
    const NormalText& get() const { return source_ == nullptr ? own_ : source_->text(unit_); }
    operator const NormalText&() const { return get(); }

    size_t size() const { return source_ == nullptr ? own_.size() : words_; }
    bool empty() const { return size() == 0; }
    std::string_view operator[](size_t i) const { return get()[i]; }
    Words words() const { return get().words(); }
    std::string recorded() const { return get().recorded(); }

    /// Calls visit(name) for each name and keyword of the text, once or more often, in any order, without asking its
    /// source for it.
    template <class Visit>
    void each_name(const Visit& visit) const {
        if (source_ != nullptr) return source_->each_name(unit_, visit);
        for (size_t i = 0; i < own_.size(); ++i)
            if (const std::string_view word = own_[i]; is_word_token(word)) visit(word);
    }

    bool operator==(const UnitText& other) const { return get() == other.get(); }

private:
    NormalText own_;
    std::shared_ptr<const TextSource> source_;
    uint32_t unit_ = 0, words_ = 0;
};

}  // namespace porttool
