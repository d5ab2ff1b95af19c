// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/prelude.h"

#include "porttool/language/words.h"
#include "porttool/scan/scan.h"

namespace porttool {

const std::set<std::string, std::less<>>& prelude_names() {
    static const std::set<std::string, std::less<>> kNames = [] {
        std::set<std::string, std::less<>> out;
        const ScannedFile file = scan_text("vectors.h", prelude_file("vectors.h"));
        for (const Unit& unit : file.units) {
            const std::string leaf(leaf_of(unit.name));
            if (unit.kind == UnitKind::Function && !leaf.starts_with("operator") &&
                leaf.find('#') == std::string::npos && unit.name.find("vec::") == std::string::npos &&
                unit.name.find("mat::") == std::string::npos && unit.name.find("Parts::") == std::string::npos &&
                unit.name.find("ext::") == std::string::npos)
                out.insert(leaf);
        }
        // PORTTOOL_OWN(fract, ...) defines fract; PORTTOOL_VECTORS(unsigned int, uint) make_uint2, make_uint3, ...
        const LexedText& lexed = file.lexed;
        for (uint32_t i = 0; i + 2 < lexed.tokens.size(); ++i) {
            const std::string_view macro = lexed.view(i);
            if ((lexed.tokens[i].flags & kInDirective) != 0 || !macro.starts_with("PORTTOOL_") ||
                lexed.view(i + 1) != "(")
                continue;
            if (!macro.ends_with("VECTORS")) {
                out.insert(std::string(lexed.view(i + 2)));
                continue;
            }
            uint32_t close = i;
            while (lexed.view(close) != ")") ++close;
            const std::string prefix = macro == "PORTTOOL_VECTORS" ? "make_" : "convert_";
            for (const char* size : {"2", "3", "4"}) out.insert(prefix + std::string(lexed.view(close - 1)) + size);
        }
        return out;
    }();
    return kNames;
}

bool is_vector_type(std::string_view word) {
    return !word.empty() && word.back() >= '2' && word.back() <= '4' && is_type_word(word);
}

bool has_vector_types(Language language) {
    return traits_of(language).literals == Literals::Shading || language == Language::OpenCl ||
           language == Language::Metal;
}

bool is_prelude_word(std::string_view word) { return prelude_names().contains(word) || is_vector_type(word); }

}  // namespace porttool
