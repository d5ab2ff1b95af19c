// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "porttool/judge/assess.h"
#include "porttool/language/words.h"
#include "porttool/normal/statements.h"
#include "porttool/normal/unit_state.h"
#include "porttool/scan/scan.h"
#include "porttool/sync/file_text.h"
#include "porttool/sync/name_manner.h"
#include "porttool/sync/new_unit.h"
#include "porttool/sync/new_units.h"
#include "porttool/sync/unit_extent.h"
#include "porttool/sync/unit_place.h"

namespace porttool {
namespace {

constexpr size_t kMostNewUnits = 64;    ///< that one run ports
constexpr size_t kDeepest = 8;          ///< new units that use one another
constexpr size_t kMostNewWords = 2000;  ///< of one

std::string plain_name(std::string_view name) { return std::string(bare_leaf_of(name)); }

std::string_view text_of(const ScannedFile& file, const Unit& unit) {
    const Token &first = file.lexed.tokens[unit.tokens.first], &last = file.lexed.tokens[unit.tokens.end - 1];
    return std::string_view(file.lexed.text).substr(first.offset, last.offset + last.length - first.offset);
}

std::set<std::string> words_within(const ScannedFile& file, TokenRange range) {
    std::set<std::string> out;
    for (uint32_t i = range.first; i < range.end; ++i)
        if (file.lexed.tokens[i].kind == TokenKind::Identifier) out.emplace(file.lexed.view(i));
    return out;
}

/// The one unit that a text has more than before, if all others are as they were; else nullptr.
const Unit* only_new_unit(const ScannedFile& before, const ScannedFile& now) {
    if (now.units.size() != before.units.size() + 1 || now.balanced != before.balanced ||
        now.variables.size() != before.variables.size() + (now.variables.size() > before.variables.size() ? 1 : 0))
        return nullptr;
    const Unit* out = nullptr;
    for (size_t i = 0, k = 0; k < now.units.size(); ++k) {
        const bool same = i < before.units.size() && before.units[i].name == now.units[k].name &&
                          before.units[i].kind == now.units[k].kind &&
                          text_of(before, before.units[i]) == text_of(now, now.units[k]);
        if (same) {
            ++i;
        } else if (out == nullptr) {
            out = &now.units[k];
        } else {
            return nullptr;
        }
    }
    return out;
}

/// The words of a new unit that nobody there would know; none if all is well.
std::set<std::string> strange_words(const ScannedFile& file, const Unit& unit, const KnownWords& known,
                                    const UnitNames& names, const std::set<std::string, std::less<>>& brought) {
    const LexedText& lexed = file.lexed;
    const std::set<std::string, std::less<>> own = names_within(file, unit);
    std::set<std::string_view> units;
    for (const auto& [source, targets] : names.names)
        for (const std::string& target : targets) units.insert(target);
    std::set<std::string> out;
    for (uint32_t i = unit.tokens.first; i < unit.tokens.end; ++i) {
        if (lexed.tokens[i].kind != TokenKind::Identifier || i == unit.name_token) continue;
        const std::string_view word = lexed.view(i);
        const bool member = i > 0 && (lexed.view(i - 1) == "." || lexed.view(i - 1) == "->");
        if (own.contains(word) || units.contains(word) || brought.contains(word) || roles_of(word) != 0 ||
            is_type_word(word) || known.in_file(word) || (member && !known.is_of_source(word)) || known.anywhere(word))
            continue;
        out.emplace(word);
    }
    return out;
}

std::string indented_lines(const std::string& text, const std::string& indent) {
    if (indent.empty()) return text;
    std::string out;
    for (size_t at = 0; at < text.size();) {
        const size_t end = std::min(text.find('\n', at), text.size());
        if (end > at && text[at] != '#') out += indent;
        out += text.substr(at, end - at) + (end < text.size() ? "\n" : "");
        at = end + 1;
    }
    return out;
}

/// A function's state with a head that says nothing: how heads are written there, pairs have told.
UnitState without_head(UnitState state) {
    if (state.kind != UnitKind::Function) return state;
    const Words words = state.text.words();
    size_t i = 0;
    while (i < words.size() && words[i] != "@") ++i;
    while (i < words.size() && words[i] != "{") ++i;
    NormalText text;
    for (const std::string_view word : {"void", "@", "(", ")"}) text.add(word);
    for (; i < words.size(); ++i) text.add(words[i]);
    state.text = std::move(text);
    return state;
}

/// True for a unit whose port a device runs, so that what it calls is marked.
bool is_on_device(const ScannedFile* file, const UnitState& port) {
    if (file == nullptr || (file->language != Language::Cuda && file->language != Language::Hip)) return false;
    const Unit* unit = unit_named(*file, port.id);
    return unit != nullptr && runs_on_device(*file, *unit);
}

}  // namespace

/// A new unit, and the file that its port is to go to.
struct NewUnits::Wanted {
    const UnitState& state;
    const std::string& name;
    const ScannedFile& file;
    const Unit& unit;
    const ScannedFile& other;
    const JudgedPair& user;
    Side from;
    std::set<std::string> fresh_uses;
};

/// Ports a unit, and before it those that it uses. Returns why that could not be, or "".
std::string NewUnits::port_one(const std::string& name, const JudgedPair& user, Side from,
                               std::set<std::string>& open) {
    const Side to = other_side(from);
    const std::string& set = from == Side::Source ? sets_.of_id(user.id.target) : std::string();
    for (const Made& made : made_)
        if (made.from == from && made.name == name && made.target_set == set) {
            if (!can_be_used(made, user)) return "its port stands where this one cannot use it";
            usable_.insert(name);
            return {};
        }
    if (excluded_.contains(name)) return "nothing that is certain uses it";
    if (const UnitState* twin = twin_of(name, user, from)) return take_twin(name, *twin, from);
    const auto& units = fresh_units(from).at(name);
    if (units.size() > 1) return "there are several of that name";
    const UnitState& state = *units.front();
    if (made_.size() >= kMostNewUnits || open.size() >= kDeepest || state.text.size() > kMostNewWords)
        return "too much came with it";
    if (!open.insert(name).second) return "it and another new one use each other";
    const ScannedFile* file = knowledge_.file_of(from, state.file);
    const Unit* unit = file == nullptr ? nullptr : unit_named(*file, state.id);
    if (unit == nullptr || user.unit[to] == nullptr) return "it could not be read";
    std::set<std::string> uses;
    std::string why;
    const std::set<std::string, std::less<>> own = names_within(*file, *unit);
    for (const std::string& word : words_within(*file, unit->tokens)) {
        if (word == name || !fresh_units(from).contains(word) || own.contains(word)) continue;
        why = port_one(word, user, from, open);
        if (!why.empty()) why = "it uses `" + word + "`, which came without a port as well: " + why;
        if (!why.empty()) break;
        uses.insert(word);
    }
    open.erase(name);
    if (!why.empty()) return why;
    why = "nothing of its file has a port there that its user could see";
    for (const ScannedFile* other : places(state, user, from)) {
        why = write({state, name, *file, *unit, *other, user, from, uses});
        if (why.empty()) break;
    }
    if (why.empty()) usable_.insert(name);
    return why;
}

/// What the port has under the same name and alike, in its user's file or one that this includes, though no pair of the
/// map says so; nullptr for none.
const UnitState* NewUnits::twin_of(const std::string& name, const JudgedPair& user, Side from) {
    const Side to = other_side(from);
    const auto& units = fresh_units(from).at(name);
    const ScannedFile* file = user.unit[to] == nullptr ? nullptr : knowledge_.file_of(to, user.unit[to]->file);
    if (units.size() != 1 || file == nullptr) return nullptr;
    read_names(to);
    const auto found = by_name_[to].find(name);
    if (found == by_name_[to].end()) return nullptr;
    const auto twin = std::find_if(found->second.begin(), found->second.end(), [&](const UnitState* there) {
        const ScannedFile* other = knowledge_.file_of(to, there->file);
        if (other == nullptr || (other != file && !includes(knowledge_.files(to), *file, *other))) return false;
        const BySide<const UnitState*> pair{from == Side::Source ? units.front() : there,
                                            from == Side::Source ? there : units.front()};
        CompareBudget budget;
        return says_the_same(assess(*pair.source, *pair.target, knowledge_.dialect(), budget));
    });
    return twin == found->second.end() ? nullptr : *twin;
}

/// Pairs a new unit with its twin, but for one that is another's port: nothing is to be written.
std::string NewUnits::take_twin(const std::string& name, const UnitState& twin, Side from) {
    const Side to = other_side(from);
    const UnitState& unit = *fresh_units(from).at(name).front();
    const bool forward = from == Side::Source;
    const bool is_taken = std::any_of(checked_.judgement.pairs.begin(), checked_.judgement.pairs.end(),
                                      [&](const JudgedPair& pair) { return pair.id[to] == twin.id; });
    if (!is_taken) {
        Made made{from,
                  {forward ? unit : twin, forward ? twin : unit},
                  name,
                  plain_name(twin.name),
                  forward ? sets_.of_path(twin.file) : std::string(),
                  {}};
        made.is_twin = true;
        made_.push_back(std::move(made));
        tell_knowledge();
        if (std::string why = record_made(); !why.empty()) return why;
    }
    usable_.insert(name);
    return {};
}

/// Records all pairs so far; the last is forgotten where that cannot be. Why not, or "".
std::string NewUnits::record_made() {
    std::vector<FreshPair> all;
    for (const Made& one : made_) all.push_back(one.pair);
    try {
        record_.set_made(std::move(all));
    } catch (const CannotDo& error) {
        take_back(made_.size() - 1);
        return error.what();
    }
    return {};
}

/// The files that the port may go to: where the ports of its neighbours are, that of its user first.
std::vector<const ScannedFile*> NewUnits::places(const UnitState& unit, const JudgedPair& user, Side from) const {
    const Side to = other_side(from);
    std::map<std::string, size_t> ports;
    const std::string& set = sets_.of_id(user.id.target);
    for (const JudgedPair& pair : checked_.judgement.pairs)
        if (pair.unit[from] != nullptr && pair.unit[to] != nullptr && pair.unit[from]->file == unit.file &&
            (from == Side::Target || sets_.of_id(pair.id.target) == set))
            ++ports[pair.unit[to]->file];
    std::vector<std::pair<size_t, std::string>> order;
    const std::string& own = user.unit[to]->file;
    for (const auto& [path, count] : ports)
        if (path != own) order.emplace_back(count, path);
    std::sort(order.rbegin(), order.rend());
    std::vector<const ScannedFile*> out;
    const ScannedFile* file = knowledge_.file_of(to, own);
    if (file != nullptr && ports.contains(own)) out.push_back(file);
    for (const auto& [count, path] : order)
        if (const ScannedFile* other = knowledge_.file_of(to, path);
            other != nullptr && file != nullptr && includes(knowledge_.files(to), *file, *other))
            out.push_back(other);
    return out;
}

void NewUnits::read_names(Side side) {
    if (!by_name_[side].empty()) return;
    for (const auto& [id, state] : checked_.states[side]) {
        by_name_[side][plain_name(state.name)].push_back(&state);
        by_file_[side][state.file].push_back(&state);
    }
}

/// The id of a unit that has the name already, or in its file the same in another manner; "" if none has.
std::string NewUnits::possible_counterpart(const Wanted& wanted, const std::string& port_name) {
    const Side to = other_side(wanted.from);
    read_names(to);
    if (const auto found = by_name_[to].find(port_name); found != by_name_[to].end()) return found->second.front()->id;
    for (const UnitState* state : by_file_[to][wanted.other.path])
        if (folded(plain_name(state->name)) == folded(wanted.name)) return state->id;
    return {};
}

std::string NewUnits::write(const Wanted& wanted) {
    const Side from = wanted.from, to = other_side(from);
    Draft& draft = drafts_.of(to, wanted.other);
    if (draft.is_linked) return "the file that its port would go to " + std::string(kIsLinked);
    std::vector<StandsFor> pairs;
    std::vector<std::pair<std::string, std::string>> alike;  // names
    const auto add = [&](const std::string& here, const std::string& there) {
        const StandsFor one{unit_named(wanted.file, here), unit_named(draft.scanned, there)};
        if (one.source == nullptr || one.port == nullptr) return;
        pairs.push_back(one);
        if (one.source->kind == wanted.unit.kind && one.port->kind == wanted.unit.kind)
            alike.emplace_back(plain_name(one.source->name), plain_name(one.port->name));
    };
    for (const JudgedPair& pair : checked_.judgement.pairs)
        if (pair.unit[from] != nullptr && pair.unit[to] != nullptr && pair.unit[from]->file == wanted.file.path &&
            pair.unit[to]->file == wanted.other.path)
            add(pair.unit[from]->id, pair.unit[to]->id);
    for (const Made& made : made_)
        if (made.from == from && made.unit().file == wanted.file.path && made.port().file == wanted.other.path)
            add(made.unit().id, made.port().id);

    const std::string port_name = name_in_manner(wanted.name, alike);
    const KnownWords& known = knowledge_.known_words(from, wanted.file, wanted.other);
    if (const std::string id = possible_counterpart(wanted, port_name); !id.empty())
        return "the port has `" + id + "`, which may be its counterpart";
    if (known.in_file(port_name) || roles_of(port_name) != 0)
        return "`" + port_name + "` means something else in the port";

    UnitNames names = knowledge_.unit_names(from);
    names.names[wanted.name] = {port_name};
    std::set<std::string, std::less<>> lone, brought = this->brought();
    for (const auto& [name, why] : unported(from))
        if (name != wanted.name) lone.insert(name);
    brought.merge(names_within(wanted.file, wanted.unit));
    const Examples none;
    const LearnedBeside beside = knowledge_.learned_beside(from, wanted.file.path, wanted.other.path);
    const UnitSurroundings around{!runs_on_device(wanted.file, wanted.unit)};
    const EditTranslator translator(none, beside, names, lone, known, brought, around);
    const bool on_device = wanted.unit.kind == UnitKind::Function &&
                           is_on_device(knowledge_.file_of(to, wanted.user.unit[to]->file), *wanted.user.unit[to]);
    const NewUnit made = port_new_unit(
        {wanted.file, wanted.unit, port_name, on_device},
        {knowledge_.heads_beside(from, wanted.file, wanted.other), knowledge_.heads(from), translator, draft.scanned});
    if (!made.failure.empty()) return made.failure;

    const ScannedFile alone = scan_text(wanted.other.path, made.text);
    const std::set<std::string> uses = words_within(alone, {0, static_cast<uint32_t>(alone.lexed.tokens.size())});
    const Unit* user = unit_named(draft.scanned, wanted.user.unit[to]->id);
    const UnitPlace place = place_of_new_unit({wanted.file, wanted.unit, draft.scanned, pairs, user, uses});
    if (!place.found) return place.failure;
    const std::string blank(place.blank_lines, '\n'), text = indented_lines(made.text, place.indent);
    const TextEdit edit{place.offset, place.offset, place.below ? "\n" + blank + text : text + "\n" + blank};
    const std::optional<std::string> now = edit_file(draft.bytes, draft.scanned.lexed.text, {edit});
    return now ? settle(wanted, draft, *now, port_name, wanted.fresh_uses)
               : std::string("the port's line goes on behind a backslash there");
}

/// Holds the new text to the gate, and takes it with the record of its pair.
std::string NewUnits::settle(const Wanted& wanted, Draft& draft, const std::string& now, const std::string& port_name,
                             const std::set<std::string>& uses) {
    ScannedFile scanned = scan_text(draft.scanned.path, now);
    const Unit* unit = only_new_unit(draft.scanned, scanned);
    if (unit == nullptr || plain_name(unit->name) != port_name || unit->kind != wanted.unit.kind)
        return "what was made of it could not be read back";
    const Side from = wanted.from;
    UnitNames names = knowledge_.unit_names(from);
    names.names[wanted.name] = {port_name};
    const std::set<std::string> strange =
        strange_words(scanned, *unit, knowledge_.known_words(from, wanted.file, wanted.other), names, brought());
    if (!strange.empty()) return "nothing tells what `" + *strange.begin() + "` is in the port";
    const UnitState port = unit_state(scanned, *unit);
    const bool forward = from == Side::Source;
    Made made{from,      {forward ? wanted.state : port, forward ? port : wanted.state}, wanted.name,
              port_name, forward ? sets_.of_path(draft.scanned.path) : std::string(),    uses};
    if (wanted.unit.kind != UnitKind::Function) made.fields = names_within(wanted.file, wanted.unit);
    made_.push_back(std::move(made));
    tell_knowledge();
    CompareBudget budget;
    const FreshPair& pair = made_.back().pair;
    if (!says_the_same(assess(without_head(pair.source), without_head(pair.target), knowledge_.dialect(), budget))) {
        take_back(made_.size() - 1);
        return "check would not take what was made of it for the same";
    }
    if (std::string why = record_made(); !why.empty()) return why;
    drafts_.write(draft, now, std::move(scanned));
    return {};
}

}  // namespace porttool
