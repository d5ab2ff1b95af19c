// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/new_users.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <unordered_map>

#include "porttool/match/body_traits.h"
#include "porttool/scan/macros.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

/// How a user stands, the one that says most first.
enum class UserKind : uint8_t { Watched, Unwatched, New, Unported };

class UserSearch {
public:
    explicit UserSearch(const SideUnits& units) : units_(units) {}

    std::map<const UnitState*, std::string> run() {
        find_launchers();
        find_names();
        for (const auto& [id, unit] : units_.all)
            if (unit.kind != UnitKind::File) read_uses(unit);
        for (auto& [unit, users] : users_) tell(unit, users);
        find_relatives();
        find_rows();
        find_barren_places();
        find_answered_kernels();
        find_kernels_of_one_launcher();
        climb();
        follow();
        find_new_files();
        std::erase_if(
            told_, [&](const auto& one) { return redefines_word(leaf(*one.first)) || shadows_.contains(one.first); });
        return std::move(told_);
    }

private:
    using Names = std::unordered_multimap<std::string_view, const UnitState*>;
    using Users = std::array<std::vector<const UnitState*>, 4>;  ///< by UserKind, some of each

    void find_launchers() {
        if (units_.files == nullptr) return;
        std::map<std::string, const UnitState*> functions;
        for (const UnitState* unit : units_.unported)
            if (unit->kind == UnitKind::Function) functions.emplace(unit->id, unit);
        std::set<std::string> paths;
        for (const auto& [id, unit] : functions) paths.insert(unit->file);
        for (size_t i = 0; i < units_.files->size(); ++i) {
            if (!paths.contains(units_.files->path(i))) continue;
            const ScannedFile& file = units_.files->scanned(i);
            for (const Unit& unit : file.units) {
                const auto found = functions.find(unit_id(file, unit));
                if (found == functions.end()) continue;
                const BodyTraits traits = read_body_traits(file, unit);
                if (!traits.launches || traits.stores) continue;
                launchers_.insert(found->second);
                told_.emplace(found->second, "it launches kernels");
            }
        }
    }

    /// The names by which the units are used. One that several units bear tells nothing.
    void find_names() {
        std::unordered_map<std::string_view, size_t> bearers;
        for (const auto& [id, unit] : units_.all)
            if (unit.kind != UnitKind::File) ++bearers[leaf(unit)];
        for (const auto& [id, unit] : units_.all)
            if (is_code(unit) && bearers[leaf(unit)] == 1) functions_.emplace(leaf(unit), &unit);
        std::unordered_map<std::string_view, size_t> new_bearers;
        for (const UnitState* unit : units_.unported) ++new_bearers[leaf(*unit)];
        for (const UnitState* unit : units_.unported) {
            const std::string_view name = leaf(*unit);
            constexpr size_t kMost = 8;  // branches that define one constant, or overloads
            if (bearers[name] == new_bearers[name] && bearers[name] <= kMost)
                names_.emplace(name, unit);
            else
                names_in_files_[unit->file].emplace(name, unit);
        }
        // Other files have the name, too: what uses it in this one means this one's.
        for (const auto& [id, unit] : units_.all)
            if (const auto found = names_in_files_.find(unit.file);
                found != names_in_files_.end() && !units_.fresh.contains(&unit))
                found->second.erase(leaf(unit));
        for (const auto& [name, unit] : names_) lengths_[std::min(name.size(), lengths_.size() - 1)] = true;
        for (const auto& [file, names] : names_in_files_)
            for (const auto& [name, unit] : names) lengths_[std::min(name.size(), lengths_.size() - 1)] = true;
    }

    static bool is_code(const UnitState& unit) {
        return unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel;
    }

    static std::string_view leaf(const UnitState& unit) {
        const std::string_view name = leaf_of(unit.name);
        return name.substr(0, name.find('#'));
    }

    void read_uses(const UnitState& user) {
        const UserKind kind = kind_of(user);
        const auto in_file = names_in_files_.find(user.file);
        const auto add = [&](const Names& names, size_t i) {
            const auto [first, last] = names.equal_range(user.text[i]);
            for (auto used = first; used != last; ++used)
                if (used->second != &user && is_use(*used->second, user, i)) add_use(*used->second, user, kind, i);
        };
        for (size_t i = 0; i < user.text.size(); ++i) {
            const std::string_view word = user.text[i];
            if (!lengths_[std::min(word.size(), lengths_.size() - 1)] || !is_word_token(word)) continue;
            add(names_, i);
            if (in_file != names_in_files_.end()) add(in_file->second, i);
        }
    }

    void add_use(const UnitState& used, const UnitState& user, UserKind kind, size_t i) {
        constexpr size_t kMost = 8;
        if (kind == UserKind::Watched && !tells_of(user, leaf(used))) {
            const std::string_view before = i > 0 ? user.text[i - 1] : std::string_view();
            if (before != "." && before != "->") shadows_.insert(&used);
            return;
        }
        if (kind == UserKind::Unported) uses_[&user].insert(&used);
        leads_.emplace(&used, std::pair(&user, kind));
        if (used.kind == UnitKind::Kernel) return;  // told with others by find_answered_kernels() alone
        auto& users = users_[&used][static_cast<size_t>(kind)];
        if (users.size() < kMost && (users.empty() || users.back() != &user)) users.push_back(&user);
    }

    bool tells_of(const UnitState& user, std::string_view word) {
        const auto [known, is_new] = tells_.try_emplace({&user, word});
        if (is_new) known->second = units_.tells_of(user, word);
        return known->second;
    }

    UserKind kind_of(const UnitState& user) {
        if (!units_.lone.contains(&user)) return UserKind::Watched;
        if (!units_.fresh.contains(&user)) return UserKind::Unwatched;
        if (open_.empty()) open_.insert(units_.unported.begin(), units_.unported.end());
        return open_.contains(&user) ? UserKind::Unported : UserKind::New;
    }

    /// A function is used where it is called or handed to a template, not where a class declares it; any mention of a
    /// constant or a type is a use.
    static bool is_use(const UnitState& used, const UnitState& user, size_t i) {
        if (!is_code(used)) return true;
        const NormalText& text = user.text;
        const std::string_view before = i > 0 ? text[i - 1] : std::string_view();
        const std::string_view after = i + 1 < text.size() ? text[i + 1] : std::string_view();
        if (user.kind == UnitKind::Struct && after == "(" && is_word_token(before) && before != "return") return false;
        const bool template_argument = (before == "<" || before == ",") && (after == ">" || after == ",");
        return after == "(" || after == "<" || before == "&" || (template_argument && (before == "<" || after == ">"));
    }

    /// What has no port itself, but only joins what has ports, as a dispatcher does, says nothing of a new unit.
    bool joins_ports(const UnitState& user) const {
        std::set<const UnitState*> watched, others;
        for (size_t i = 0; i < user.text.size(); ++i) {
            const auto found = functions_.find(user.text[i]);
            if (found == functions_.end() || found->second == &user || units_.fresh.contains(found->second)) continue;
            (units_.lone.contains(found->second) ? others : watched).insert(found->second);
        }
        return !watched.empty() && watched.size() >= others.size();
    }

    void tell(const UnitState* unit, Users& users) {
        constexpr std::array<const char*, 3> kSays = {" uses it, which is watched", " uses it, which has no port",
                                                      " uses it, which is new as well"};
        auto& unwatched = users[static_cast<size_t>(UserKind::Unwatched)];
        if (std::any_of(unwatched.begin(), unwatched.end(), [&](const UnitState* user) { return joins_ports(*user); }))
            unwatched.clear();
        for (size_t kind = 0; kind < kSays.size(); ++kind)
            if (!users[kind].empty() && told_.emplace(unit, users[kind][0]->id + kSays[kind]).second) return;
    }

    /// What belongs to a class of which nothing has a port, and one more variant of what has none.
    void find_relatives() {
        std::unordered_map<std::string_view, Family> classes, variants;
        for (const auto& [id, unit] : units_.all) {
            if (unit.kind == UnitKind::File) continue;
            const std::string_view plain = plain_name(unit);
            variants[plain].add(units_, unit);
            if (unit.kind == UnitKind::Struct) classes[plain].add(units_, unit);
        }
        for (const auto& [id, unit] : units_.all)
            if (const auto found = classes.find(class_of(unit));
                found != classes.end() && found->second.files == unit.file)
                found->second.add(units_, unit);
        for (const UnitState* unit : units_.unported) {
            if (unit->kind == UnitKind::Kernel) continue;
            const auto around = classes.find(class_of(*unit));
            if (around != classes.end() && !around->second.is_watched && around->second.files == unit->file)
                told_.emplace(unit, "it belongs to " + std::string(around->first) + ", which has no port");
            const Family& same = variants[plain_name(*unit)];
            // One more overload of a function is another function.
            if (!is_code(*unit) && !same.is_watched && same.is_known && same.files == unit->file)
                told_.emplace(unit, "other variants of it have no port");
        }
    }

    /// `op` of `op_scale` and of `opScale`.
    static std::string_view first_word(std::string_view name) {
        size_t end = 1;
        while (end < name.size() && name[end] != '_' &&
               !(std::isupper(static_cast<unsigned char>(name[end])) != 0 &&
                 std::islower(static_cast<unsigned char>(name[end - 1])) != 0))
            ++end;
        return name.substr(0, end);
    }

    /// Where most of what stood beside it has no port, one more without is no news: in its file, or for what came with
    /// a file of its own, in the folder. A kernel is held against kernels alone: of the four and more that its file
    /// has, or of the many of its folder, fewer than a quarter may have one, and of those of its file, and of those of
    /// its first word there (`op_...`), fewer than half.
    void find_barren_places() {
        struct Place {
            size_t watched = 0, known = 0;
        };
        std::map<std::string_view, Place> files, folders, kernels, kernels_in_files;
        std::map<std::pair<std::string_view, std::string_view>, Place> families;
        const auto folder = [](const UnitState& unit) {
            const size_t end = unit.file.rfind('/');
            return end == std::string::npos ? std::string_view() : std::string_view(unit.file).substr(0, end);
        };
        const auto count = [&](Place& place, const UnitState& unit) {
            ++place.known;
            place.watched += units_.lone.contains(&unit) ? 0 : 1;
        };
        for (const auto& [id, unit] : units_.all) {
            if (unit.kind == UnitKind::File || units_.fresh.contains(&unit)) continue;
            count(files[unit.file], unit);
            count(folders[folder(unit)], unit);
            if (unit.kind != UnitKind::Kernel) continue;
            count(kernels[folder(unit)], unit);
            count(kernels_in_files[unit.file], unit);
            count(families[{folder(unit), first_word(leaf(unit))}], unit);
        }
        constexpr size_t kLeast = 4;  // units that tell a manner
        constexpr size_t kManyKernels = 32;
        for (const UnitState* unit : units_.unported) {
            if (unit->kind == UnitKind::Kernel) {
                const Place &place = kernels[folder(*unit)], &in_file = kernels_in_files[unit->file];
                const auto has_ports = [](const Place& one) { return one.watched > 0 && 2 * one.watched >= one.known; };
                const bool has_company =
                    has_ports(in_file) || has_ports(families[{folder(*unit), first_word(leaf(*unit))}]);
                const auto is_barren = [](const Place& one, size_t least) {
                    return one.known >= least && 4 * one.watched < one.known;
                };
                const bool of_file = is_barren(in_file, kLeast);
                const Place& of = of_file ? in_file : place;
                if ((of_file || is_barren(place, kManyKernels)) && !has_company)
                    told_.emplace(unit, fmt::format("{} of the {} kernels that its {} had before have none either",
                                                    of.known - of.watched, of.known, of_file ? "file" : "folder"));
                continue;
            }
            const Place& in_file = files[unit->file];
            const Place& place = in_file.known > 0 ? in_file : folders[folder(*unit)];
            if (place.known >= kLeast && 2 * place.watched < place.known)
                told_.emplace(
                    unit, fmt::format("{} of the {} units that its {} had before have none either",
                                      place.known - place.watched, place.known, in_file.known > 0 ? "file" : "folder"));
        }
    }

    /// A new constant in a row of constants: where those beside it have no port, it is one more of them.
    void find_rows() {
        std::map<std::string_view, std::vector<const UnitState*>> rows;
        for (const UnitState* unit : units_.unported)
            if (unit->kind == UnitKind::Constant) rows[unit->file];
        if (rows.empty()) return;
        for (const auto& [id, unit] : units_.all)
            if (const auto row = rows.find(unit.file); row != rows.end() && unit.kind != UnitKind::File)
                row->second.push_back(&unit);
        for (auto& [file, row] : rows) {
            std::sort(row.begin(), row.end(),
                      [](const UnitState* a, const UnitState* b) { return a->start_line < b->start_line; });
            tell_row(row);
        }
    }

    void tell_row(const std::vector<const UnitState*>& row) {
        const std::set<const UnitState*> open(units_.unported.begin(), units_.unported.end());
        constexpr uint32_t kNear = 8;  // lines
        for (size_t i = 0; i < row.size(); ++i) {
            if (row[i]->kind != UnitKind::Constant || !open.contains(row[i])) continue;
            size_t above = i, below = i;
            while (above > 0 && open.contains(row[above])) --above;
            while (below + 1 < row.size() && open.contains(row[below])) ++below;
            const auto lacks_port = [&](const UnitState& unit) {
                const bool near =
                    unit.start_line < row[i]->start_line + kNear && row[i]->start_line < unit.start_line + kNear;
                return near && unit.kind == UnitKind::Constant && units_.lone.contains(&unit) &&
                       !units_.fresh.contains(&unit);
            };
            if (lacks_port(*row[above]) && lacks_port(*row[below]))
                told_.emplace(row[i], "those beside it have no port either");
        }
    }

    /// Units of one name, or of one class.
    struct Family {
        bool is_watched = false, is_known = false;  ///< some of it has a port; some was there before
        std::string_view files;                     ///< the file that holds it; "" once it is in several

        void add(const SideUnits& units, const UnitState& unit) {
            if (!is_any) files = unit.file;
            if (files != unit.file) files = {};
            is_any = true;
            is_watched = is_watched || !units.lone.contains(&unit);
            is_known = is_known || !units.fresh.contains(&unit);
        }
        bool is_any = false;
    };

    static std::string_view plain_name(const UnitState& unit) {
        return std::string_view(unit.name).substr(0, unit.name.find('#'));
    }

    static std::string_view class_of(const UnitState& unit) {
        const size_t colons = unit.name.rfind("::");
        return colons == std::string::npos ? std::string_view() : std::string_view(unit.name).substr(0, colons);
    }

    /// A port in another language of kernels has a kernel's work in what is the port of its launcher, often: a new
    /// kernel is told with the units that launch it, directly or through new functions, if all of them answer for it.
    void find_answered_kernels() {
        for (const UnitState* kernel : units_.unported) {
            if (kernel->kind != UnitKind::Kernel) continue;
            std::set<const UnitState*> seen = {kernel};
            std::vector<const UnitState*> open = {kernel};
            std::string says;
            bool all_answer = true;
            while (!open.empty() && all_answer) {
                const auto [first, last] = leads_.equal_range(open.back());
                open.pop_back();
                for (auto use = first; use != last; ++use) {
                    const auto& [user, kind] = use->second;
                    if (!seen.insert(user).second || kind == UserKind::Unwatched) continue;
                    if (kind == UserKind::Unported) {
                        open.push_back(user);
                        continue;
                    }
                    const std::string answer = units_.answers_for_kernels(*user);
                    all_answer = all_answer && !answer.empty();
                    if (says.empty() && !answer.empty()) says = user->id + " launches it, " + answer;
                }
            }
            if (all_answer && !says.empty()) told_.emplace(kernel, says);
        }
    }

    /// The function that alone leads to a unit, itself or through new functions without a counterpart: the farthest.
    const UnitState* sole_user(const UnitState* unit) const {
        const UnitState* out = nullptr;
        std::set<const UnitState*> seen;
        while (seen.insert(unit).second) {
            const auto [first, end] = leads_.equal_range(unit);
            const bool is_one = first != end && std::all_of(first, end, [&, &use = first->second](const auto& each) {
                                    return each.second == use;
                                });
            if (!is_one) break;
            const auto [user, kind] = first->second;
            if (kind != UserKind::Watched && kind != UserKind::Unported) break;
            out = unit = user;
        }
        return out;
    }

    /// Kernels that one function came to launch, and nothing else does, are one new way of doing what it does: the
    /// first is told.
    void find_kernels_of_one_launcher() {
        std::map<const UnitState*, const UnitState*> first;  // of each launcher
        for (const UnitState* kernel : units_.unported) {
            if (kernel->kind != UnitKind::Kernel || told_.contains(kernel)) continue;
            const UnitState* launcher = sole_user(kernel);
            if (launcher == nullptr) continue;
            const auto [known, is_first] = first.emplace(launcher, kernel);
            if (!is_first) told_.emplace(kernel, launcher->id + " leads to it, as to " + known->second->id);
        }
    }

    /// What calls a new launcher, or names a new kernel, is on the way to the kernel, which is told.
    void climb() {
        std::map<const UnitState*, std::vector<const UnitState*>> users;
        std::vector<const UnitState*> open;
        for (const auto& [user, used] : uses_)
            for (const UnitState* each : used) users[each].push_back(user);
        for (const auto& [used, unused] : users)
            if (used->kind == UnitKind::Kernel || launchers_.contains(used)) open.push_back(used);
        while (!open.empty()) {
            const UnitState* used = open.back();
            open.pop_back();
            for (const UnitState* user : users[used])
                if (user->kind == UnitKind::Function && told_.emplace(user, "it leads to " + used->id).second)
                    open.push_back(user);
        }
    }

    /// What only new units without a counterpart use is told with these, down from those that nothing uses.
    void follow() {
        std::vector<const UnitState*> open;
        for (const UnitState* unit : units_.unported)
            if (!is_used_by_new(unit) || told_.contains(unit)) open.push_back(unit);
        while (!open.empty()) {
            const UnitState* user = open.back();
            open.pop_back();
            const auto uses = uses_.find(user);
            if (uses == uses_.end()) continue;
            for (const UnitState* used : uses->second)
                if (used->kind != UnitKind::Kernel &&
                    told_.emplace(used, user->id + " uses it, which has no port").second)
                    open.push_back(used);
        }
    }

    /// A new file of which nothing has a counterpart is one thing to decide on: its kernels are told, or else the first
    /// of its units that is.
    void find_new_files() {
        if (units_.unported.empty()) return;
        std::map<std::string_view, size_t> size;
        std::map<std::string_view, std::vector<const UnitState*>> unported;
        for (const auto& [id, unit] : units_.all) size[unit.file] += unit.kind != UnitKind::File ? 1 : 0;
        for (const UnitState* unit : units_.unported) unported[unit->file].push_back(unit);
        constexpr size_t kLeast = 4;  // units that are more than a reader takes in one by one
        for (auto& [file, units] : unported) {
            if (units.size() < kLeast || units.size() != size[file]) continue;
            const auto told_by = [&](const UnitState* unit) { return unit->kind == UnitKind::Kernel; };
            const auto kernel = std::find_if(units.begin(), units.end(), told_by);
            const UnitState* first = kernel != units.end() ? *kernel : nullptr;
            for (const UnitState* unit : units) {
                if (told_by(unit) || told_.contains(unit)) continue;
                if (first == nullptr)
                    first = unit;
                else
                    told_.emplace(unit, "nothing in its file has, see " + first->id);
            }
        }
    }

    bool is_used_by_new(const UnitState* unit) const {
        const auto users = users_.find(unit);
        return users != users_.end() && !users->second[static_cast<size_t>(UserKind::Unported)].empty();
    }

    const SideUnits& units_;
    std::set<const UnitState*> open_, launchers_;
    std::set<const UnitState*> shadows_;  ///< that give a name of a watched unit another meaning
    std::map<std::pair<const UnitState*, std::string_view>, bool> tells_;
    std::unordered_map<std::string_view, const UnitState*> functions_;  ///< all, where one alone bears the name
    Names names_;
    std::unordered_map<std::string_view, Names> names_in_files_;  ///< by file: what is new there and has namesakes
    std::array<bool, 65> lengths_ = {};                           ///< of the names, the last for all that are longer
    std::map<const UnitState*, Users> users_;
    std::map<const UnitState*, std::set<const UnitState*>> uses_;                   ///< of units without a counterpart
    std::multimap<const UnitState*, std::pair<const UnitState*, UserKind>> leads_;  ///< from what is used to its users
    std::map<const UnitState*, std::string> told_;
};

}  // namespace

std::map<const UnitState*, std::string> told_with_others(const SideUnits& units) {
    if (units.unported.empty()) return {};
    return UserSearch(units).run();
}

}  // namespace porttool
