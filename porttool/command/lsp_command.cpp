// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <array>
#include <cerrno>
#include <sstream>

#include "porttool/command/commands.h"
#include "porttool/lsp/language_server.h"

namespace porttool {
namespace {

/// What is typed is judged once the keys rest so long, or when an answer needs it.
constexpr int kTypingMs = 60;

/// Carries messages between a client on stdin and stdout and the server.
class LspSession {
public:
    LspSession(const Options& options, Workplace& place) : place_(place), server_(set_up(options), place.disk) {}

    /// Returns the exit code.
    int run() {
        while (!server_.exit_code()) {
            const Woken woken = wait();
            if (woken == Woken::Changed) server_.note_change();
            if (woken == Woken::Other && !take_input()) return server_.exit_code_at_end();
            if (woken != Woken::Other && server_.is_due()) server_.look();
        }
        return *server_.exit_code();
    }

private:
    lsp::ServerSetUp set_up(const Options& options) {
        lsp::ServerSetUp out;
        out.choice = options;
        out.folder_given = options.directory != ".";
        out.version = kVersionNumber;
        out.accept = [this, options](const std::string& folder, const std::string& fingerprint) {
            Options accepting = options;
            accepting.format = "text";
            if (options.directory == ".") accepting.directory = folder;
            accepting.paths = {fingerprint};
            std::ostringstream said;
            Workplace there{place_.disk, said};
            const Outcome outcome = run_accept(accepting, there);
            return said.str() + outcome.text;
        };
        out.send = [this](const std::string& message) { print(*place_.out, lsp::framed(message)); };
        return out;
    }

    /// Before there is a project only stdin is waited for.
    Woken wait() {
        if (server_.project() == nullptr) return Woken::Other;
        return server_.project()->watch().wait(STDIN_FILENO, server_.is_due() ? kTypingMs : -1);
    }

    /// False at the end of the input.
    bool take_input() {
        constexpr size_t kRoom = 65536;
        static std::array<char, kRoom> room;
        const ssize_t got = ::read(STDIN_FILENO, room.data(), room.size());
        if (got < 0) return errno == EINTR || errno == EAGAIN;
        if (got == 0) return false;
        reader_.add({room.data(), static_cast<size_t>(got)});
        while (!server_.exit_code()) {
            const auto message = reader_.next();
            if (!message) break;
            server_.take(*message);
        }
        return true;
    }

    Workplace& place_;
    lsp::LanguageServer server_;
    lsp::MessageReader reader_;
};

}  // namespace

void declare_lsp(Declare& declare, Options& options) {
    declare.flag("--stdio", options.stdio, "Speak on stdin and stdout, as it does in any case; editors give it");
}

Outcome run_lsp(const Options& options, Workplace& place) {
    require_format(options.format, {"text"});
    if (!options.output.empty()) throw CannotDo("lsp speaks with an editor on stdout; leave out -o");
    return {"", LspSession(options, place).run()};
}

}  // namespace porttool
