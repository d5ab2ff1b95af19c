// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "porttool/normal/unit_state.h"

namespace porttool {

/// The units of a side in the order of their ids. Reads as a map from ids to states, and a state stays where it is as
/// in one; the id stands in the state alone, as a file can have half a million units.
class UnitsById {
    struct Before {
        using is_transparent = void;
        bool operator()(const UnitState& a, const UnitState& b) const { return a.id < b.id; }
        bool operator()(const UnitState& a, std::string_view id) const { return a.id < id; }
        bool operator()(std::string_view id, const UnitState& b) const { return id < b.id; }
    };
    using Units = std::set<UnitState, Before>;

public:
    struct Entry {
        const std::string& first;  ///< the id
        const UnitState& second;
    };

    class const_iterator {
    public:
        using iterator_category = std::input_iterator_tag;
        using value_type = Entry;
        using difference_type = std::ptrdiff_t;
        using reference = Entry;
        struct pointer {
            Entry entry;
            const Entry* operator->() const { return &entry; }
        };

        const_iterator() = default;
        explicit const_iterator(Units::const_iterator at) : at_(at) {}
        reference operator*() const { return {at_->id, *at_}; }
        pointer operator->() const { return {**this}; }
        const_iterator& operator++() {
            ++at_;
            return *this;
        }
        const_iterator operator++(int) { return const_iterator(at_++); }
        bool operator==(const const_iterator&) const = default;

    private:
        Units::const_iterator at_;
    };

    const_iterator begin() const { return const_iterator(units_.begin()); }
    const_iterator end() const { return const_iterator(units_.end()); }
    size_t size() const { return units_.size(); }
    bool empty() const { return units_.empty(); }
    const_iterator find(std::string_view id) const { return const_iterator(units_.find(id)); }
    const_iterator lower_bound(std::string_view id) const { return const_iterator(units_.lower_bound(id)); }
    bool contains(std::string_view id) const { return units_.contains(id); }
    const UnitState& at(std::string_view id) const {
        const auto found = units_.find(id);
        if (found == units_.end()) throw std::out_of_range("no unit " + std::string(id));
        return *found;
    }

    /// Adds a unit. Of several of one id the first stays.
    void add(UnitState unit) { units_.insert(units_.end(), std::move(unit)); }

    template <class Is>
    void erase_if(const Is& is) {
        std::erase_if(units_, is);
    }

private:
    Units units_;
};

}  // namespace porttool
