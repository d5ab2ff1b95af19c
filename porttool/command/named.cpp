// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/named.h"

#include "porttool/command/commands.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {

Named require_named(const Judgement& judgement, const std::string& id) {
    Named named = named_by(judgement, id);
    if (!named.pairs.empty() || !named.lone.empty()) return named;
    const std::string near = nearest_named(judgement, id);
    throw CannotDo(terminal_text(id) + ": no such pair or finding" +
                   (near.empty() ? std::string("; porttool map lists the pairs")
                                 : "; did you mean '" + terminal_text(near) + "'?"));
}

}  // namespace porttool
