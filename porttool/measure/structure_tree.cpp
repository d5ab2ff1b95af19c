// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/structure_tree.h"

#include "porttool/normal/normal_form.h"
#include "porttool/normal/statements.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

class TreeBuilder {
public:
    explicit TreeBuilder(const Dialect& dialect) : dialect_(dialect) {}

    void add(const ScannedFile& file, const Unit& unit) {
        const NormalText text = normal_form(file, unit);
        for (const std::string_view word : text.words()) add(word);
        while (!open_.empty()) close();
        leaf();
    }

    metrics::Tree finish() {
        tree_.close(0, 0);
        return std::move(tree_);
    }

private:
    struct Block {
        uint32_t first;
        uint64_t label;
    };

    void add(std::string_view token) {
        if (token == "(") ++parens_;
        if (token == ")" && parens_ > 0) --parens_;
        if (parens_ > 0 || (token != "{" && token != "}" && token != ";")) {
            words_.push_back(token);
            return;
        }
        if (token == "{")
            open();
        else if (token == "}")
            close();
        else
            leaf();
    }

    void open() {
        open_.push_back({static_cast<uint32_t>(tree_.size()), label()});
        words_.clear();
    }

    void close() {
        leaf();
        if (open_.empty()) return;
        tree_.close(open_.back().first, open_.back().label);
        open_.pop_back();
    }

    void leaf() {
        parens_ = 0;
        if (words_.empty()) return;
        tree_.close(static_cast<uint32_t>(tree_.size()), label());
        words_.clear();
    }

    uint64_t label() const {
        uint64_t hash = 1;
        for (const Statement& statement : split_statements(words_, dialect_)) hash = hash_text(statement.key, hash);
        return hash;
    }

    const Dialect& dialect_;
    metrics::Tree tree_;
    std::vector<Block> open_;
    Words words_;
    int parens_ = 0;
};

}  // namespace

metrics::Tree structure_tree(const Passage& passage, const Dialect& dialect) {
    TreeBuilder builder(dialect);
    for (const Excerpt& excerpt : passage) {
        if (excerpt.unit != nullptr) {
            builder.add(*excerpt.file, *excerpt.unit);
            continue;
        }
        for (const Unit& unit : excerpt.file->units) builder.add(*excerpt.file, unit);
        if (excerpt.file->units.empty()) builder.add(*excerpt.file, whole_file_unit(*excerpt.file));
    }
    return builder.finish();
}

}  // namespace porttool
