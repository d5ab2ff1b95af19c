// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/scan/head.h"

#include <algorithm>
#include <array>

namespace porttool {
namespace {

template <size_t N>
bool is_one_of(const std::array<std::string_view, N>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

constexpr std::array<std::string_view, 27> kAttributeWords = {"alignas",
                                                              "__attribute__",
                                                              "__attribute",
                                                              "__declspec",
                                                              "__launch_bounds__",
                                                              "__align__",
                                                              "layout",
                                                              "decltype",
                                                              "noexcept",
                                                              "throw",
                                                              "requires",
                                                              "explicit",
                                                              "asm",
                                                              "__asm__",
                                                              "typeof",
                                                              "__typeof__",
                                                              "sizeof",
                                                              "packoffset",
                                                              "register",
                                                              "alignof",
                                                              "__pragma",
                                                              "_Pragma",
                                                              "_Alignas",
                                                              "__cluster_dims__",
                                                              "local_size",
                                                              "__maxnreg__",
                                                              "reqd_work_group_size"};

// Words that can stand before a parenthesis without naming a function.
constexpr std::array<std::string_view, 45> kNotNames = {
    "if",    "for",    "while",    "switch",        "catch",          "return",         "else",
    "do",    "case",   "default",  "goto",          "static_assert",  "defined",        "typeid",
    "new",   "delete", "auto",     "const",         "constexpr",      "volatile",       "void",
    "int",   "float",  "double",   "char",          "bool",           "unsigned",       "signed",
    "long",  "short",  "foreach",  "foreach_tiled", "foreach_unique", "foreach_active", "cif",
    "cfor",  "cwhile", "using",    "typedef",       "template",       "struct",         "class",
    "union", "enum",   "namespace"};

constexpr std::array<std::string_view, 15> kTrailers = {"const",    "volatile", "override", "final",    "try",
                                                        "mutable",  "&",        "&&",       "abstract", "restrict",
                                                        "unmasked", "pure",     "sealed",   "CONST",    "noexcept"};

constexpr std::array<std::string_view, 16> kBlockStorage = {"uniform",
                                                            "buffer",
                                                            "in",
                                                            "out",
                                                            "inout",
                                                            "shared",
                                                            "attribute",
                                                            "varying",
                                                            "rayPayloadEXT",
                                                            "rayPayloadInEXT",
                                                            "hitAttributeEXT",
                                                            "callableDataEXT",
                                                            "callableDataInEXT",
                                                            "taskPayloadSharedEXT",
                                                            "perprimitiveEXT",
                                                            "cbuffer"};

constexpr std::array<std::string_view, 19> kKernelWords = {
    "__global__", "__kernel", "RT_PROGRAM",     "__raygen__", "GLOBAL_FUNC",          "__GLOBAL__",
    "KERNEL",     "kernel",   "vertex",         "fragment",   "numthreads",           "shader",
    "task",       "export",   "ccl_gpu_kernel", "__kernel__", "reqd_work_group_size", "mesh",
    "compute"};

bool is_shader(Language language) { return language == Language::Glsl; }

bool is_macro_like(std::string_view word) {
    bool letter = false;
    for (const char c : word) {
        if (c >= 'a' && c <= 'z') return false;
        letter = letter || (c >= 'A' && c <= 'Z');
    }
    return letter && word.size() > 1;
}

bool is_word_character(char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// A token of the head, or a whole bracketed group.
struct Item {
    uint32_t at;     ///< position in Structure::tokens; of a group, its opening bracket
    uint32_t close;  ///< position of the closing bracket, kNoMatch for a plain token
    bool group() const { return close != kNoMatch; }
};

class HeadReader {
public:
    HeadReader(const HeadContext& context, uint32_t first, uint32_t end)
        : context_(context), first_(first), end_(end) {}

    Head read() {
        head_.first = first_;
        collect();
        if (items_.empty()) return head_;
        if (!read_scope() && !read_type() && !read_block()) read_function();
        if (head_.kind == HeadKind::Function) head_.kernel = is_kernel();
        return head_;
    }

private:
    std::string_view word(uint32_t at) const { return context_.lexed.view(context_.structure.tokens[at]); }
    const Token& token(uint32_t at) const { return context_.lexed.tokens[context_.structure.tokens[at]]; }
    bool is_name(uint32_t at) const { return token(at).kind == TokenKind::Identifier; }
    std::string_view word_of(size_t item) const { return item < items_.size() ? word(items_[item].at) : ""; }
    bool is_paren(size_t item) const { return items_[item].group() && word(items_[item].at) == "("; }

    /// Fills items_ without template prefixes and attributes in brackets.
    void collect() {
        for (uint32_t at = first_; at < end_;) {
            const std::string_view text = word(at);
            const uint32_t close = context_.structure.match[at];
            const bool after_operator = !items_.empty() && word(items_.back().at) == "operator";
            if ((text == "template" || text == "__generic") && at + 1 < end_ && word(at + 1) == "<") {
                const uint32_t behind = skip_angles(context_, at + 1, end_);
                at = behind == kNoMatch ? at + 1 : behind;
                continue;
            }
            if (text == "[" && close != kNoMatch && close < end_) {
                for (uint32_t k = at; k < close; ++k) note_attribute(word(k));
                if (after_operator || (items_.size() >= 2 && word(items_[items_.size() - 2].at) == "operator"))
                    items_.push_back({at, close});
                at = close + 1;
                continue;
            }
            if (text == "(" && close != kNoMatch && close < end_) {
                items_.push_back({at, close});
                at = close + 1;
                continue;
            }
            items_.push_back({at, kNoMatch});
            ++at;
        }
    }

    void note_attribute(std::string_view text) {
        if (text == "numthreads" || text == "shader" || text == "kernel") attribute_kernel_ = true;
    }

    bool read_scope() {
        for (size_t i = 0; i < items_.size() && i < 8; ++i) {
            if (word_of(i) != "namespace" || items_[i].group()) continue;
            head_.kind = HeadKind::Namespace;
            for (size_t k = i + 1; k < items_.size(); ++k) {
                if (items_[k].group() || !is_name(items_[k].at)) continue;
                if (word_of(k) == "inline") continue;
                // a macro before the name, as in `namespace EXPORT detail`
                if (!head_.name.empty() && word_of(k - 1) != "::") head_.name.clear();
                head_.name += (head_.name.empty() ? "" : "::") + std::string(word_of(k));
            }
            return true;
        }
        const size_t last = items_.size() - 1;
        if (last >= 1 && token(items_[last].at).kind == TokenKind::String && word_of(last - 1) == "extern") {
            head_.kind = HeadKind::Linkage;
            return true;
        }
        return false;
    }

    static bool is_type_key(std::string_view text) {
        return text == "struct" || text == "class" || text == "union" || text == "enum" || text == "interface" ||
               text == "cbuffer" || text == "tbuffer" || text == "__interface" || text == "extension";
    }

    bool read_type() {
        size_t key = 0;
        while (key < items_.size() && (items_[key].group() || !is_type_key(word_of(key)))) {
            if (word_of(key) == "<") {  // a type key within template arguments announces nothing
                const uint32_t behind = skip_angles(context_, items_[key].at, end_);
                if (behind != kNoMatch) {
                    while (key < items_.size() && items_[key].at < behind) ++key;
                    continue;
                }
            }
            ++key;
        }
        if (key >= items_.size()) return false;
        size_t tail_end = key + 1;
        while (tail_end < items_.size() && word_of(tail_end) != ":") ++tail_end;
        if (returns_type(key, tail_end)) return false;
        head_.kind = word_of(key) == "enum" ? HeadKind::Enum : HeadKind::Struct;
        for (size_t i = 0; i < key; ++i) head_.is_typedef = head_.is_typedef || word_of(i) == "typedef";
        read_type_name(key + 1, tail_end);
        trim_lead(key);
        return true;
    }

    /// `struct Foo f(int x) {` is a function: its parameter list is the last thing before the body.
    bool returns_type(size_t key, size_t tail_end) const {
        for (size_t i = key + 1; i < tail_end; ++i) {
            if (!is_paren(i) || i == key + 1) continue;
            const std::string_view before = word_of(i - 1);
            if (takes_attribute_arguments(before)) continue;
            bool ends = true;
            for (size_t k = i + 1; k < tail_end && ends; ++k)
                ends = is_one_of(kTrailers, word_of(k)) && word_of(k) != "final";
            if (ends || word_of(i + 1) == "->") return true;
        }
        return false;
    }

    void read_type_name(size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) {
            if (items_[i].group()) continue;
            const std::string_view text = word_of(i);
            if (text == "<") {  // arguments of a specialisation
                const uint32_t behind = skip_angles(context_, items_[i].at, end_);
                while (behind != kNoMatch && i + 1 < end && items_[i + 1].at < behind) ++i;
                continue;
            }
            if (!is_name(items_[i].at) || takes_attribute_arguments(text)) continue;
            if (text == "final" || text == "sealed" || text == "class" || text == "struct") continue;
            if (i + 1 < end && is_paren(i + 1)) continue;  // ALIGN(16)
            const bool qualified = i > first && word_of(i - 1) == "::" && !head_.name.empty();
            head_.name = qualified ? head_.name + "::" + std::string(text) : std::string(text);
            head_.name_at = items_[i].at;
        }
    }

    /// GLSL and HLSL interface blocks: `layout(set = 0) buffer Rays {`, `uniform Camera {`.
    bool read_block() {
        const Language language = context_.language;
        if (language != Language::Glsl && language != Language::Slang && language != Language::Cpp &&
            language != Language::Unknown)
            return false;
        bool storage = false, layout = false;
        for (size_t i = 0; i < items_.size(); ++i) {
            if (is_paren(i) && i > 0 && word_of(i - 1) == "layout")
                layout = true;
            else if (is_paren(i))
                return false;
            else if (!items_[i].group() && is_one_of(kBlockStorage, word_of(i)))
                storage = true;
        }
        const Item& last = items_.back();
        if (!storage || last.group() || !is_name(last.at) || is_one_of(kBlockStorage, word(last.at))) return false;
        if (language != Language::Glsl && !layout) return false;
        head_.kind = HeadKind::Block;
        head_.name = std::string(word(last.at));
        head_.name_at = last.at;
        trim_lead(items_.size() - 1);
        return true;
    }

    // -- functions --

    struct Candidate {
        size_t group;  ///< item of the parameter list
        size_t name;   ///< item where the name starts
    };

    void read_function() {
        std::vector<Candidate> candidates;
        bool assigned = false;
        for (size_t i = 0; i < items_.size(); ++i) {
            if (!items_[i].group() && word_of(i) == "operator") {
                if (const auto operator_candidate = read_operator(i)) candidates.push_back(*operator_candidate);
                break;
            }
            assigned = assigned || word_of(i) == "=";
            if (is_paren(i))
                if (const auto name = candidate_name(i)) candidates.push_back({i, *name});
        }
        if (assigned && candidates.empty()) return;
        const auto chosen = choose(candidates);
        if (!chosen) {
            read_nested_declarator();
            return;
        }
        accept(*chosen);
    }

    std::optional<Candidate> read_operator(size_t keyword) const {
        size_t group = keyword + 1;
        if (group < items_.size() && is_paren(group) && items_[group].close == items_[group].at + 1) ++group;
        while (group < items_.size() && !is_paren(group)) ++group;
        if (group >= items_.size()) return std::nullopt;
        return Candidate{group, name_start(keyword)};
    }

    /// The item where the name before the parenthesis `group` starts, if it can be a function's name.
    std::optional<size_t> candidate_name(size_t group) const {
        if (group == 0) return std::nullopt;
        size_t last = group - 1;
        if (is_paren(last)) {  // NAME(foo)(int a)
            if (last == 0 || items_[last - 1].group() || !is_name(items_[last - 1].at)) return std::nullopt;
            if (is_one_of(kNotNames, word_of(last - 1)) || takes_attribute_arguments(word_of(last - 1)))
                return std::nullopt;
            return last - 1;
        }
        if (word_of(last) == ">") {  // f<int>(int a)
            const size_t open = open_angle(last);
            if (open == 0 || open == items_.size()) return std::nullopt;
            last = open - 1;
        }
        if (items_[last].group() || !is_name(items_[last].at)) return std::nullopt;
        const std::string_view text = word_of(last);
        if (is_one_of(kNotNames, text) || takes_attribute_arguments(text)) return std::nullopt;
        return name_start(last);
    }

    size_t open_angle(size_t close) const {
        int depth = 0;
        for (size_t i = close + 1; i-- > 0;) {
            if (items_[i].group()) continue;
            if (word_of(i) == ">") ++depth;
            if (word_of(i) == "<" && --depth == 0) return i;
        }
        return items_.size();
    }

    /// Walks back over `~` and `A<T>::B::`.
    size_t name_start(size_t last) const {
        size_t at = last;
        if (at > 0 && word_of(at - 1) == "~") --at;
        while (at >= 2 && word_of(at - 1) == "::") {
            size_t before = at - 2;
            if (word_of(before) == ">") {
                const size_t open = open_angle(before);
                if (open == 0 || open == items_.size()) break;
                before = open - 1;
            }
            if (items_[before].group() || !is_name(items_[before].at)) break;
            at = before;
        }
        return at;
    }

    std::optional<Candidate> choose(const std::vector<Candidate>& candidates) const {
        if (candidates.empty()) return std::nullopt;
        const Candidate* first_fit = nullptr;
        for (const Candidate& candidate : candidates) {
            if (!ends_head(candidate.group + 1)) continue;
            // MACRO(256) f(int a): what starts the head without a type is a macro if another list follows
            const bool bare = candidate.name == 0 && is_macro_like(word_of(0)) && is_followed_by_name(candidate.group);
            if (first_fit == nullptr || !bare) first_fit = &candidate;
            if (!bare) break;
        }
        return first_fit != nullptr ? *first_fit : candidates.back();
    }

    bool is_followed_by_name(size_t item) const {
        return item + 1 < items_.size() && !items_[item + 1].group() && is_name(items_[item + 1].at);
    }

    /// True if only what may follow a parameter list stands from `item` to the body.
    bool ends_head(size_t item) const {
        for (size_t i = item; i < items_.size(); ++i) {
            const std::string_view text = word_of(i);
            if (text == "->" || text == ":" || text == "requires") return true;
            if (is_paren(i)) {
                const std::string_view before = word_of(i - 1);
                if (i == item || !(takes_attribute_arguments(before) || is_macro_like(before))) return false;
                continue;
            }
            if (!is_one_of(kTrailers, text) && !takes_attribute_arguments(text) && !is_macro_like(text)) return false;
        }
        return true;
    }

    void accept(const Candidate& chosen) {
        head_.kind = HeadKind::Function;
        head_.parameters = items_[chosen.group].at;
        head_.name_at = items_[chosen.name].at;
        if (word_of(chosen.group - 1) == ")" || is_paren(chosen.group - 1)) {
            if (word_of(chosen.name) == "operator" || joined_operator(chosen))
                head_.name = plain_name(chosen);
            else
                head_.name = macro_name(word_of(chosen.name), items_[chosen.group - 1], false);
        } else if (chosen.name == 0 && chosen.group == 1 && !context_.in_class && is_macro_call(chosen)) {
            head_.name = macro_name(word_of(0), items_[1], true);
            if (builds_type(word_of(0))) head_.kind = HeadKind::Struct;
        } else {
            head_.name = plain_name(chosen);
        }
        trim_lead(chosen.name);
    }

    bool joined_operator(const Candidate& chosen) const {
        for (size_t i = chosen.name; i < chosen.group; ++i)
            if (word_of(i) == "operator") return true;
        return false;
    }

    bool is_macro_call(const Candidate& chosen) const {
        const std::string_view text = word_of(chosen.name);
        return context_.macros.contains(text) || is_macro_like(text);
    }

    /// `#define STRUCT(NAME) struct NAME`
    bool builds_type(std::string_view macro) const {
        const auto known = context_.macros.find(macro);
        if (known == context_.macros.end()) return false;
        const auto& words = known->second.replacement;
        return !words.empty() && is_type_key(words.front()) &&
               std::find(words.begin(), words.end(), "(") == words.end();
    }

    /// The items of the name, without template arguments; words are kept apart by a blank.
    std::string plain_name(const Candidate& chosen) const {
        std::string name;
        bool in_operator = false;
        for (size_t i = chosen.name; i < chosen.group; ++i) {
            const std::string_view text = word_of(i);
            if (!in_operator && text == "<") {
                const uint32_t behind = skip_angles(context_, items_[i].at, end_);
                while (behind != kNoMatch && i + 1 < chosen.group && items_[i + 1].at < behind) ++i;
                continue;
            }
            const bool blank = !name.empty() && is_name(items_[i].at) &&
                               ((name.back() >= 'a' && name.back() <= 'z') || name.back() == '_');
            if (blank) name += ' ';
            name += text;
            if (items_[i].group()) name += text == "(" ? ")" : "]";
            in_operator = in_operator || text == "operator";
        }
        return name;
    }

    /// The name that `MACRO(arguments)` builds: by the macro's definition if the file has it, else the arguments.
    std::string macro_name(std::string_view macro, const Item& arguments, bool whole_head) {
        std::vector<std::string> words(1);
        for (uint32_t at = arguments.at + 1; at < arguments.close; ++at) {
            if (word(at) == ",")
                words.emplace_back();
            else
                words.back() += word(at);
        }
        const auto known = context_.macros.find(macro);
        if (known != context_.macros.end()) {
            const std::string name = name_in(expand(known->second, words), whole_head);
            if (!name.empty()) return name;
        }
        std::string name;
        for (std::string text : words) {
            std::erase_if(text, [](char c) { return !is_word_character(c); });
            if (!text.empty()) name += (name.empty() ? "" : "_") + text;
        }
        return name.empty() ? std::string(macro) : name;
    }

    /// The function's name in an expanded macro: the word before the first parenthesis, or the only word.
    std::string name_in(const std::vector<std::string>& words, bool whole_head) {
        for (size_t i = 0; i < words.size(); ++i) {
            if (is_one_of(kKernelWords, words[i]) && words[i].starts_with("__")) attribute_kernel_ = true;
            if (i > 0 && words[i] == "(" && !takes_attribute_arguments(words[i - 1])) return words[i - 1];
        }
        if (!whole_head && words.size() == 1) return words[0];
        if (whole_head && words.size() == 2 && is_type_key(words[0])) return words[1];
        return {};
    }

    /// `int (*f(int a))(float) {`: the name is inside the first parenthesis.
    void read_nested_declarator() {
        for (size_t i = 1; i < items_.size(); ++i) {
            if (!is_paren(i) || (word(items_[i].at + 1) != "*" && word(items_[i].at + 1) != "&")) continue;
            for (uint32_t at = items_[i].at + 2; at + 1 < items_[i].close; ++at) {
                if (!is_name(at) || word(at + 1) != "(") continue;
                head_.kind = HeadKind::Function;
                head_.name = std::string(word(at));
                head_.name_at = at;
                head_.parameters = at + 1;
                trim_lead(i);
                return;
            }
        }
    }

    /// Leaves macro lines out that have nothing to do with the signature: a blank line or a comment stands between, or
    /// the macro is known to define something of its own.
    void trim_lead(size_t name_item) {
        size_t i = 0;
        while (i < name_item) {
            const bool has_arguments = i + 1 < name_item && is_paren(i + 1);
            const size_t next = i + (has_arguments ? 2 : 1);
            if (items_[i].group() || !is_name(items_[i].at) || next > name_item) break;
            if (!has_arguments && !is_macro_like(word_of(i))) break;
            if (has_arguments && takes_attribute_arguments(word_of(i))) break;
            const uint32_t behind = (has_arguments ? items_[i + 1].close : items_[i].at) + 1;
            if (token(behind).line > token(behind - 1).line + 1 || defines_something(word_of(i))) head_.first = behind;
            i = next;
        }
    }

    bool defines_something(std::string_view macro) const {
        const auto known = context_.macros.find(macro);
        if (known == context_.macros.end()) return false;
        const auto& words = known->second.replacement;
        return std::find(words.begin(), words.end(), "{") != words.end() || (!words.empty() && words.back() == ";");
    }

    bool is_kernel() const {
        if (attribute_kernel_) return true;
        const Language language = context_.language;
        if (is_shader(language)) return head_.name == "main";
        for (const Item& item : items_) {
            if (item.at >= head_.name_at) break;
            const std::string_view text = word(item.at);
            if (text == "__global__" || text == "__kernel" || text == "RT_PROGRAM") return true;
            if (text == "kernel" && (language == Language::OpenCl || language == Language::Metal)) return true;
            if ((text == "vertex" || text == "fragment") && language == Language::Metal) return true;
            if ((text == "task" || text == "export") && language == Language::Ispc) return true;
        }
        constexpr std::array<std::string_view, 6> kOptix = {"__raygen__", "__closesthit__",   "__anyhit__",
                                                            "__miss__",   "__intersection__", "__direct_callable__"};
        return std::any_of(kOptix.begin(), kOptix.end(), [&](auto prefix) { return head_.name.starts_with(prefix); });
    }

    const HeadContext& context_;
    uint32_t first_;
    uint32_t end_;
    std::vector<Item> items_;
    Head head_;
    bool attribute_kernel_ = false;
};

}  // namespace

Head read_head(const HeadContext& context, uint32_t first, uint32_t end) {
    // No head that a person wrote is longer; the limit keeps the searches within one linear over the file.
    constexpr uint32_t kLongestHead = 1024;
    if (end - first > kLongestHead) first = end - kLongestHead;
    return HeadReader(context, first, end).read();
}

uint32_t skip_angles(const HeadContext& context, uint32_t open, uint32_t end) {
    constexpr uint32_t kNear = 256;
    int depth = 0;
    for (uint32_t at = open; at < end; ++at) {
        if (at - open > kNear) {
            const uint32_t close = context.angles.close(context.lexed, context.structure, open);
            return close < end ? close + 1 : kNoMatch;
        }
        const std::string_view text = context.lexed.view(context.structure.tokens[at]);
        const uint32_t close = context.structure.match[at];
        if ((text == "(" || text == "[" || text == "{") && close != kNoMatch && close < end)
            at = close;
        else if (text == "<")
            ++depth;
        else if (text == ">" && --depth == 0)
            return at + 1;
        else if (text == ";")
            return kNoMatch;
    }
    return kNoMatch;
}

uint32_t AngleTable::close(const LexedText& lexed, const Structure& structure, uint32_t open) {
    if (close_.empty()) fill(lexed, structure);
    return close_[open];
}

void AngleTable::fill(const LexedText& lexed, const Structure& structure) {
    const auto count = static_cast<uint32_t>(structure.tokens.size());
    close_.assign(count, kNoMatch);
    std::vector<uint32_t> open;  // angle brackets, those of outer groups below those of inner ones
    std::vector<size_t> outer;   // how many belong to the groups around
    for (uint32_t at = 0; at < count; ++at) {
        const std::string_view text = lexed.view(structure.tokens[at]);
        const uint32_t match = structure.match[at];
        const size_t floor = outer.empty() ? 0 : outer.back();
        if (match != kNoMatch && match > at) {
            outer.push_back(open.size());
        } else if (match != kNoMatch) {
            open.resize(floor);
            if (!outer.empty()) outer.pop_back();
        } else if (text == "<") {
            open.push_back(at);
        } else if (text == ">" && open.size() > floor) {
            close_[open.back()] = at;
            open.pop_back();
        } else if (text == ";") {
            open.resize(floor);
        }
    }
}

bool takes_attribute_arguments(std::string_view word) { return is_one_of(kAttributeWords, word); }

}  // namespace porttool
