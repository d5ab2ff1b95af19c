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
/// source. Reads as the text itself. Kept small, as a file can have half a million units; copies share the text.
class UnitText {
public:
    UnitText() = default;
    UnitText(NormalText text) : words_(static_cast<uint32_t>(text.size())) {
        if (words_ != 0) source_ = std::make_shared<const OwnText>(std::move(text));
    }
    /// A text of `words` words.
    UnitText(std::shared_ptr<const TextSource> source, uint32_t unit, uint32_t words)
        : source_(std::move(source)), unit_(unit), words_(words) {}

    const NormalText& get() const {
        static const NormalText none;
        if (source_ == nullptr) return none;
        return is_own() ? own() : source_->text(unit_);
    }
    operator const NormalText&() const { return get(); }

    size_t size() const { return words_; }
    bool empty() const { return size() == 0; }
    std::string_view operator[](size_t i) const { return get()[i]; }
    Words words() const { return get().words(); }
    std::string recorded() const { return get().recorded(); }

    /// Calls visit(name) for each name and keyword of the text, once or more often, in any order, without asking its
    /// source for it.
    template <class Visit>
    void each_name(const Visit& visit) const {
        if (source_ == nullptr) return;
        if (!is_own()) return source_->each_name(unit_, visit);
        each_name_of(own(), visit);
    }

    bool operator==(const UnitText& other) const { return get() == other.get(); }

private:
    static constexpr uint32_t kOwn = UINT32_MAX;

    template <class Visit>
    static void each_name_of(const NormalText& text, const Visit& visit) {
        for (size_t i = 0; i < text.size(); ++i)
            if (const std::string_view word = text[i]; is_word_token(word)) visit(word);
    }

    /// A text at hand.
    struct OwnText final : TextSource {
        explicit OwnText(NormalText text) : at_hand(std::move(text)) {}
        const NormalText& text(uint32_t /*unit*/) const override { return at_hand; }
        void each_name(uint32_t /*unit*/, const std::function<void(std::string_view)>& visit) const override {
            each_name_of(at_hand, visit);
        }
        NormalText at_hand;
    };

    bool is_own() const { return unit_ == kOwn; }
    const NormalText& own() const { return static_cast<const OwnText&>(*source_).at_hand; }

    std::shared_ptr<const TextSource> source_;
    uint32_t unit_ = kOwn, words_ = 0;
};

}  // namespace porttool
