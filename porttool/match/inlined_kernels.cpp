// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/inlined_kernels.h"

#include <algorithm>
#include <iterator>
#include <unordered_map>

#include "porttool/match/resemblance.h"

namespace porttool {
namespace {

using UnitList = std::vector<uint32_t>;
using UnitsByName = std::unordered_map<uint32_t, UnitList>;  ///< by UnitFeatures::called_as

class InlinedFinder {
public:
    InlinedFinder(const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target,
                  const std::vector<uint32_t>& ports, const std::vector<uint32_t>& owners)
        : source_(source), target_(target), ports_(ports), owners_(owners) {}

    std::vector<InlinedKernel> run() {
        const UnitList kernels = open_kernels();
        if (kernels.empty()) return {};
        read_callers(kernels);
        read_target();
        std::vector<InlinedKernel> out;
        for (const uint32_t kernel : kernels) {
            const InlinedKernel found = place_of(kernel);
            if (found.target != kNoUnit) out.push_back(found);
        }
        return out;
    }

private:
    static constexpr size_t kMostLaunchers = 4;  ///< a name that more launch is no kernel's alone
    static constexpr size_t kMostCallers = 16;   ///< what more call is a helper
    static constexpr size_t kMostPlaces = 64;

    UnitList open_kernels() const {
        UnitList out;
        for (uint32_t s = 0; s < source_.size(); ++s)
            if (source_[s].kernel && ports_[s] == kNoUnit) out.push_back(s);
        return out;
    }

    void read_target() {
        for (uint32_t t = 0; t < target_.size(); ++t) {
            if (target_[t].group != Group::Code) continue;
            named_there_[target_[t].called_as].push_back(t);
            for (const uint32_t name : target_[t].callees) callers_there_[name].push_back(t);
            units_there_.resize(std::max<size_t>(units_there_.size(), target_[t].file + 1));
            units_there_[target_[t].file].push_back(t);
        }
    }

    /// Who calls or launches the kernels, and who calls those of them that have no port.
    void read_callers(const UnitList& kernels) {
        for (const uint32_t kernel : kernels) callers_[source_[kernel].called_as];
        add_callers();
        UnitList without_port;
        for (const auto& [name, callers] : callers_)
            for (const uint32_t caller : callers)
                if (ports_[caller] == kNoUnit && !source_[caller].kernel) without_port.push_back(caller);
        const UnitsByName first = callers_;
        for (const uint32_t caller : without_port) callers_.try_emplace(source_[caller].called_as);
        if (callers_.size() == first.size()) return;
        for (const auto& [name, callers] : first) callers_[name].clear();
        add_callers();
    }

    void add_callers() {
        for (uint32_t s = 0; s < source_.size(); ++s)
            for (const uint32_t name : source_[s].callees)
                if (const auto found = callers_.find(name); found != callers_.end()) found->second.push_back(s);
    }

    InlinedKernel place_of(uint32_t kernel) const {
        constexpr float kLeast = 0.25f, kLeastBeside = 0.3f, kBase = 0.42f, kPerShare = 0.5f;
        InlinedKernel best{kernel, kNoUnit, 0};
        float most = kLeast;
        const auto look = [&](const UnitList& places) {
            for (const uint32_t t : places) {
                const float contained = contained_in(source_[kernel], target_[t]);
                if (contained <= most) continue;
                most = contained;
                best = {kernel, t, kBase + kPerShare * contained};
            }
        };
        for (const uint32_t port : ports_of_launchers(kernel)) look(places_in(port));
        most = std::max(most, kLeastBeside);
        for (const uint32_t launcher : launchers_there(kernel)) look(places_beside(launcher));
        return best;
    }

    /// Functions of the other side that launch a kernel of this one, as where the kernels alone are the source: what is
    /// called or created by that name is not theirs.
    UnitList launchers_there(uint32_t kernel) const {
        const uint32_t name = source_[kernel].called_as;
        const auto found = callers_there_.find(name);
        const bool own = found == callers_there_.end() || named_there_.contains(name);
        UnitList out;
        if (own) return out;
        std::copy_if(found->second.begin(), found->second.end(), std::back_inserter(out),
                     [&](uint32_t t) { return target_[t].launches; });
        return out.size() <= kMostLaunchers ? out : UnitList();
    }

    /// What does the work where a launcher does not: who calls it and works as well, and the entry point of its file.
    UnitList places_beside(uint32_t launcher) const {
        UnitList out;
        const auto add = [&](uint32_t t) {
            if (target_[t].launches || target_[t].kernel || !target_[t].works) return;
            const UnitList places = places_in(t);
            out.insert(out.end(), places.begin(), places.end());
        };
        UnitList callees{launcher};
        constexpr int kLevels = 2;
        for (int level = 0; level < kLevels; ++level) {
            UnitList callers;
            for (const uint32_t callee : callees) {
                const uint32_t name = target_[callee].called_as;
                const auto found = callers_there_.find(name);
                const bool known = found != callers_there_.end() && named_there_.at(name).size() == 1;
                if (known && found->second.size() <= kMostLaunchers)
                    callers.insert(callers.end(), found->second.begin(), found->second.end());
            }
            std::for_each(callers.begin(), callers.end(), add);
            callees = std::move(callers);
        }
        for (const uint32_t t : units_there_[target_[launcher].file])
            if (target_[t].entry) add(t);
        return out;
    }

    /// Who calls a unit; of several that call one of its name those of its own file.
    UnitList callers_of(uint32_t unit) const {
        UnitList all = callers_.at(source_[unit].called_as), own;
        std::erase(all, unit);
        std::copy_if(all.begin(), all.end(), std::back_inserter(own),
                     [&](uint32_t caller) { return source_[caller].file == source_[unit].file; });
        if (own.empty()) own = std::move(all);
        return own.size() <= kMostCallers ? own : UnitList();
    }

    /// The ports of what launches a kernel, where they launch nothing and do not call it, either.
    UnitList ports_of_launchers(uint32_t kernel) const {
        UnitList out;
        const uint32_t name = source_[kernel].called_as;
        const auto add = [&](uint32_t host) {
            if (host == kernel || ports_[host] == kNoUnit) return false;
            const UnitFeatures& port = target_[ports_[host]];
            if (!port.launcher && !std::binary_search(port.callees.begin(), port.callees.end(), name))
                out.push_back(ports_[host]);
            return true;
        };
        for (const uint32_t launcher : callers_of(kernel)) {
            if (add(launcher) || !callers_.contains(source_[launcher].called_as)) continue;
            for (const uint32_t caller : callers_of(launcher)) add(caller);
        }
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
        return out;
    }

    /// A port, and what it calls of its own file that nobody else has.
    UnitList places_in(uint32_t port) const {
        UnitList out;
        if (target_[port].computes) out.push_back(port);
        for (const uint32_t name : target_[port].callees) {
            const auto found = named_there_.find(name);
            if (found == named_there_.end()) continue;
            for (const uint32_t t : found->second) {
                const UnitFeatures& unit = target_[t];
                const bool own = unit.file == target_[port].file || found->second.size() == 1;
                if (out.size() < kMostPlaces && own && owners_[t] == kNoUnit && unit.works && !unit.launches &&
                    !unit.kernel)
                    out.push_back(t);
            }
        }
        return out;
    }

    const std::vector<UnitFeatures>& source_;
    const std::vector<UnitFeatures>& target_;
    const std::vector<uint32_t>&ports_, &owners_;
    UnitsByName callers_;                ///< source units by the name that they call
    UnitsByName named_there_;            ///< target units by their own name
    UnitsByName callers_there_;          ///< target units by the names that they call
    std::vector<UnitList> units_there_;  ///< target units by file
};

}  // namespace

std::vector<InlinedKernel> find_inlined_kernels(const std::vector<UnitFeatures>& source,
                                                const std::vector<UnitFeatures>& target,
                                                const std::vector<uint32_t>& ports,
                                                const std::vector<uint32_t>& owners) {
    return InlinedFinder(source, target, ports, owners).run();
}

}  // namespace porttool
