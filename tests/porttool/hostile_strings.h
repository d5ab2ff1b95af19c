// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/porttool/fixtures.h"

namespace porttool::testing {

/// Some of the texts where tests try less.
inline std::vector<std::string> lighter(const std::vector<std::string>& texts) {
    std::vector<std::string> out;
    for (size_t i = 0; i < texts.size(); i += static_cast<size_t>(kLighter)) out.push_back(texts[i]);
    return out;
}

/// Texts that act somewhere if they are printed as they are, and some that must pass unharmed. All are UTF-8; none
/// holds a slash at its ends.
inline const std::vector<std::string>& hostile_strings() {
    static const std::vector<std::string> strings = lighter(
        {// terminals
         "a\x1b[2Jb", "a\x1b[31mred", "\x1b]0;title\x07x", "\x1b]8;;http:evil\x1b\\link\x1b]8;;\x1b\\",
         "\x1b]52;c;ZXZpbA==\x07", "\x1b[?1049h", "bell\x07", "back\x08\x08space",
         "form\x0c"
         "feed",
         "v\x0btab", "shift\x0e\x0f", "del\x7f",
         "c1\xc2\x9b"
         "31m",
         "nel\xc2\x85x",
         "osc\xc2\x9d"
         "0;t\xc2\x9c",
         "unit\x1fsep",
         // directions, no width, separators
         "rlo\u202egpj.exe", "lri\u2066x\u2069", "lrm\u200e\u200f", "alm\u061c", "zero\u200bwidth", "joi\u200dner",
         "word\u2060joiner", "bom\ufeff", "soft\u00adhyphen", "line\u2028sep", "para\u2029sep",
         "tag\U000E0041\U000E007F", "hangul\u3164filler", "vs\ufe0fx",
         // lines
         "new\nline", "new\n::error::forged", "cr\r::error::forged", "tab\tx", "new\n##[error]forged", "\n\n# heading",
         "crlf\r\n| a | b |",
         // build logs
         "::error::x", " ::error file=a::x", "\u3000::warning::x", "::set-output name=a::b", "::stop-commands::x",
         "##[error]x", "a ##[add-mask]x", "##vso[task.setvariable]x", "##teamcity[x]", "%0A::error::x", "%250A",
         // Markdown
         "`a", "``a``", "```\nx", "````a", "`````", "a`b`c``d", "~~gone~~", "~one~", "a|b", "a\\|b", "\\", "\\`x`",
         "[x](http:evil)", "![x](http:evil)", "[x][1]", "[^1]", "<http:evil>", "www.evil.example",
         "mail a@evil.example", "@team", "x @org-team y", "#12 !3 GH-4 $5", "$x$ and $y$",
         ":smile:", "*a* **b** _c_ __d__", "- item", "1. item", "> quote", "# heading", "    code", "* * *", "a*b*c",
         "x_y_z", "x `| y", "| --- |", "[[wiki]]", "[ ] task",
         // HTML and XML
         "<script>alert(1)<", "<img src=x onerror=alert(1)>", "<b>bold<", "-->", "<!-- x", "]]>", "<![CDATA[x",
         "&#x3c;b&#62;", "&lt;b&gt;", "&amp;", "\" onmouseover=\"x", "' onmouseover='x", "@DATA@ @SCRIPT@", "</script",
         "{{constructor}}", "${x}",
         // spreadsheets
         "=1+1", " =1+1", "\t=1+1", "\u3000=1+1", "+1", "-1", "@SUM(A1)", "\uff1d1+1", "a;=1+1", "a,\"=1+1",
         "=cmd|'x'!A1", "\"quoted\"",
         // shells
         "$(touch hostile)", "`touch hostile`", "a; touch hostile", "a' ; touch hostile; '", "'", "''", "\"$HOME\"",
         "a && b", "a\\", "~", "*.x", "-x", "--force", "!!", "a=b", "%s%n",
         // our own escapes
         "\\u{202e}", "\\u{zz}", "\\u202e", "\\n",
         // what must pass unharmed
         "émigré", "日本語", "שלום", "مرحبا", "Ωmega", "\U0001F600", "\U0001F468\u200D\U0001F469\u200D\U0001F467",
         "\u2764\uFE0F", "plain name", std::string(200, 'x')});
    return strings;
}

/// What cannot be the name of a file that is read.
inline const std::vector<std::string>& strings_not_utf8() {
    static const std::vector<std::string> strings = {"caf\xe9",
                                                     "\xc3",
                                                     "\xed\xa0\x80",
                                                     "\xf5\x80\x80\x80",
                                                     "\xc0\xaf",
                                                     "\xe2\x80",
                                                     "\x9b"
                                                     "31m",
                                                     "\xff\xfe"};
    return strings;
}

}  // namespace porttool::testing
