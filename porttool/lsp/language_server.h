// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "porttool/live/live_project.h"
#include "porttool/lsp/code_actions.h"
#include "porttool/lsp/documents.h"
#include "porttool/lsp/hover.h"
#include "porttool/lsp/message_reader.h"
#include "porttool/lsp/project_places.h"

namespace porttool::lsp {

/// What the server is given by the command that starts it.
struct ServerSetUp {
    CheckChoice choice;         ///< which project; its folder counts where the user named one
    bool folder_given = false;  ///< else that of the editor's workspace
    std::string version;        ///< of the program
    /// Records a finding as in step, as `porttool accept FINGERPRINT` in that folder does; returns what that says.
    /// Throws CannotDo.
    std::function<std::string(const std::string& folder, const std::string& fingerprint)> accept;
    std::function<void(const std::string& message)> send;  ///< one whole message of JSON
};

/// A server of the Language Server Protocol 3.17, without its transport: messages in, messages out. Nothing of the
/// project is run; what is written is what `accept` writes, and only when the client asks for it.
class LanguageServer {
public:
    /// `disk` must outlive it.
    LanguageServer(ServerSetUp set_up, Disk& disk) : set_up_(std::move(set_up)), disk_(disk) {}

    void take(const IncomingMessage& message);
    /// The exit code, once the client has said `exit`.
    std::optional<int> exit_code() const { return exit_code_; }
    /// That of a client that goes away without it.
    int exit_code_at_end() const { return state_ == State::ShutDown ? 0 : 1; }

    /// The project that is open; nullptr before there is one.
    LiveProject* project() { return project_.get(); }
    /// Files on the disk changed.
    void note_change() { is_due_ = is_due_ || project_ != nullptr; }
    /// True where the project is to be judged again.
    bool is_due() const { return is_due_; }
    /// Judges the project, and sends the diagnostics that changed.
    void look();

private:
    enum class State : uint8_t { New, Running, ShutDown };
    using Handler = Json (LanguageServer::*)(const Json& params);

    void answer(const Json& id, const std::string& method, const Json& params);
    void notice(const std::string& method, const Json& params);
    Json initialize(const Json& params);
    Json shut_down(const Json& params);
    Json counterparts(const Json& params);
    Json definition(const Json& params);
    Json hover(const Json& params);
    Json actions(const Json& params);
    Json execute(const Json& params);
    void open(const Json& params);
    void change(const Json& params);
    void close(const Json& params);
    void show(const std::string& path, Document& document, const std::vector<DocumentChange>& changes);

    /// The judgement of what is open now. Throws RequestError where there is none.
    const CheckedProject& judged();
    Json locations(const Counterparts& found);
    std::string path_in(const Json& params) const;
    std::string uri_of(const std::string& path) const;
    void publish(std::map<std::string, Json> diagnostics);
    void log(int type, const std::string& message);
    void send(Json message);
    void send_error(const Json& id, ErrorCode code, const std::string& message);
    void require_saved(const Finding& finding);

    ServerSetUp set_up_;
    Disk& disk_;
    State state_ = State::New;
    std::optional<int> exit_code_;
    ActionSupport support_;
    Documents documents_;
    std::unique_ptr<LiveProject> project_;
    bool is_due_ = false;
    std::string error_, said_;
    std::optional<ProjectPlaces> places_;  ///< of the last judgement, as are the proposals
    std::optional<Proposals> proposals_;
    std::map<std::string, Json> published_;  ///< by path
};

}  // namespace porttool::lsp
