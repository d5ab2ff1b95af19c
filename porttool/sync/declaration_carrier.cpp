// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/declaration_carrier.h"

#include <algorithm>
#include <optional>

#include "porttool/language/words.h"
#include "porttool/scan/scan.h"
#include "porttool/sync/file_text.h"

namespace porttool {
namespace {

constexpr size_t kNoPlace = static_cast<size_t>(-1);
constexpr size_t kMostArrivals = 64, kMostNeighbours = 64;  ///< that are looked at

std::string text_of(const ScannedFile& file, const FileStatement& statement) {
    const LexedText& lexed = file.lexed;
    const size_t first = lexed.tokens[statement.tokens.first].offset;
    const Token& last = lexed.tokens[statement.tokens.end - 1];
    return lexed.text.substr(first, last.offset + last.length - first);
}

std::map<std::string, const FileStatement*> by_name(const std::vector<FileStatement>& statements) {
    std::map<std::string, const FileStatement*> out;
    std::set<std::string> twice;
    for (const FileStatement& one : statements)
        if (!one.name.empty() && !out.emplace(one.name, &one).second) twice.insert(one.name);
    for (const std::string& name : twice) out.erase(name);  // overloads: which is which, nothing tells
    return out;
}

struct ChangedHead {
    const ScannedFile& file;  ///< of the source, now
    const FileStatement &was, &is;
};

/// A head that the port has in the source's old words becomes the new one; of one that it writes otherwise behind the
/// name, what stands before that may.
void change_head(const ChangedHead& change, const ScannedFile& port, const FileStatement& there,
                 std::vector<TextEdit>& edits) {
    const auto offset = [](const ScannedFile& file, uint32_t token) { return file.lexed.tokens[token].offset; };
    const auto head = [](const FileStatement& one) { return std::string_view(one.words).substr(0, one.head_length); };
    const auto rest = [](const FileStatement& one) { return std::string_view(one.words).substr(one.head_length); };
    const size_t first = offset(port, there.tokens.first);
    if (there.words == change.was.words) {
        const Token& last = port.lexed.tokens[there.tokens.end - 1];
        edits.push_back({first, last.offset + last.length, text_of(change.file, change.is)});
    } else if (there.name == change.was.name && head(there) == head(change.was) &&
               rest(change.was) == rest(change.is)) {
        const size_t from = offset(change.file, change.is.tokens.first);
        edits.push_back({first, offset(port, there.name_token),
                         change.file.lexed.text.substr(from, offset(change.file, change.is.name_token) - from)});
    }
}

bool declares(const ScannedFile& file, std::string_view name) {
    return std::any_of(file.variables.begin(), file.variables.end(),
                       [&](const FileVariable& variable) { return file.lexed.view(variable.name_token) == name; });
}

}  // namespace

const DeclarationCarrier::Changes& DeclarationCarrier::changes(const std::string& path, Side from) {
    const auto [found, is_new] = changes_.try_emplace({from, path});
    Changes& out = found->second;
    const ScannedFile* file = knowledge_.file_of(from, path);
    const std::string* text = is_new && file != nullptr ? earlier_.of(from, path) : nullptr;
    if (text == nullptr) return out;
    const ScannedFile earlier = scan_text(path, *text);
    const std::vector<FileStatement> old = file_statements(earlier), now = file_statements(*file);
    const std::map<std::string, const FileStatement*> before = by_name(old), after = by_name(now);
    for (size_t i = 0; i < now.size(); ++i) {
        const auto own = after.find(now[i].name), was = before.find(now[i].name);
        if (own == after.end() || own->second != &now[i]) continue;
        if (now[i].is_function && was != before.end() && was->second->is_function && was->second->words != now[i].words)
            out.changed.emplace_back(*was->second, now[i]);
        const bool came = !now[i].is_function && was == before.end() && declares(*file, now[i].name) &&
                          !declares(earlier, now[i].name);
        if (!came) continue;
        if (out.came.size() == kMostArrivals) continue;
        Arrival arrival{now[i], {}};
        for (size_t k = i; k-- > 0 && arrival.before.size() < kMostNeighbours;) arrival.before.push_back(now[k].words);
        out.came.push_back(std::move(arrival));
    }
    return out;
}

/// The offset behind which a declaration goes: behind what it stands behind in the source, else behind the includes.
size_t DeclarationCarrier::place_of(const Arrival& arrival, const ScannedFile& port) {
    const std::vector<FileStatement> statements = file_statements(port);
    for (const std::string& words : arrival.before)
        for (const FileStatement& there : statements)
            if (there.words == words) {
                const Token& last = port.lexed.tokens[there.tokens.end - 1];
                return last.offset + last.length;
            }
    const std::vector<IncludeLine> lines = include_lines(port);
    return lines.empty() || lines.back().in_branch ? kNoPlace : lines.back().next - 1;
}

/// True for words that mean the same there: types and numbers, and what the port's file has under that name.
bool DeclarationCarrier::can_stand_in(const Arrival& arrival, const ScannedFile& file, const ScannedFile& port,
                                      Side from) {
    const KnownWords& known = knowledge_.known_words(from, file, port);
    for (uint32_t i = arrival.statement.tokens.first; i < arrival.statement.tokens.end; ++i) {
        const std::string_view word = file.lexed.view(i);
        if (file.lexed.tokens[i].kind != TokenKind::Identifier || word == arrival.statement.name) continue;
        if (!is_type_word(word) && !known.in_file(word)) return false;
    }
    return !known.in_file(arrival.statement.name) && place_of(arrival, port) != kNoPlace;
}

const std::set<std::string, std::less<>>& DeclarationCarrier::brings(const JudgedPair& pair, Side from) {
    const Side to = other_side(from);
    const auto [found, is_new] = brings_.try_emplace({from, {pair.unit[from]->file, pair.unit[to]->file}});
    std::set<std::string, std::less<>>& out = found->second;
    if (!is_new) return out;
    const ScannedFile *file = knowledge_.file_of(from, pair.unit[from]->file),
                      *port = knowledge_.file_of(to, pair.unit[to]->file);
    if (file == nullptr || port == nullptr) return out;
    const bool alike = file->language == port->language || knowledge_.known_words(from, *file, *port).are_both_cpp();
    if (!alike) return out;
    for (const Arrival& arrival : changes(file->path, from).came)
        if (can_stand_in(arrival, *file, *port, from)) out.insert(arrival.statement.name);
    return out;
}

void DeclarationCarrier::carry(const JudgedPair& pair, Side from, const std::vector<std::string>& words) {
    const Side to = other_side(from);
    const ScannedFile *file = knowledge_.file_of(from, pair.unit[from]->file),
                      *other = knowledge_.file_of(to, pair.unit[to]->file);
    if (file == nullptr || other == nullptr) return;
    const std::set<std::string> used(words.begin(), words.end());
    const std::set<std::string, std::less<>>& brought = brings(pair, from);
    const Changes& made = changes(file->path, from);
    Draft& draft = drafts_.of(to, *other);
    std::vector<TextEdit> edits;
    for (const Arrival& arrival : made.came) {
        const std::string& name = arrival.statement.name;
        const size_t place = place_of(arrival, draft.scanned);
        if (place != kNoPlace && brought.contains(name) && used.contains(name) && !declares(draft.scanned, name))
            edits.push_back({place, place, "\n" + text_of(*file, arrival.statement)});
    }
    std::map<std::string_view, const std::pair<FileStatement, FileStatement>*> changed;
    for (const auto& change : made.changed)
        if (used.contains(change.first.name)) changed.emplace(change.first.name, &change);
    if (!changed.empty())
        for (const FileStatement& there : file_statements(draft.scanned))
            if (const auto found = changed.find(there.name); found != changed.end())
                change_head({*file, found->second->first, found->second->second}, draft.scanned, there, edits);
    if (edits.empty()) return;
    std::stable_sort(edits.begin(), edits.end(),
                     [](const TextEdit& a, const TextEdit& b) { return a.first < b.first; });
    const std::optional<std::string> now = edit_file(draft.bytes, draft.scanned.lexed.text, edits);
    if (now) drafts_.write(draft, *now, scan_text(other->path, *now));
}

}  // namespace porttool
