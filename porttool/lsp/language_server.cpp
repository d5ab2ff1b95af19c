// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/lsp/language_server.h"

#include <algorithm>

#include "porttool/lsp/file_uri.h"
#include "porttool/read/bounded_json.h"
#include "porttool/read/glob.h"
#include "porttool/text/sink/json.h"

namespace porttool::lsp {
namespace {

constexpr int kErrorMessage = 1, kInfoMessage = 3, kLogMessage = 4;

constexpr int kDeepestMessage = 64;  // no client nests as deep

bool holds_text(const Json& list, const std::string& text) {
    return list.is_array() && std::any_of(list.begin(), list.end(), [&](const Json& one) { return one == text; });
}

ActionSupport support_in(const Json& params) {
    const auto is_on = [&](std::initializer_list<const char*> path) { return value_at(params, path) == true; };
    return {
        is_on({"capabilities", "textDocument", "codeAction", "disabledSupport"}),
        is_on({"capabilities", "workspace", "workspaceEdit", "documentChanges"}),
        holds_text(value_at(params, {"capabilities", "workspace", "workspaceEdit", "resourceOperations"}), "create")};
}

/// The folders that an editor has open.
std::vector<std::string> workspace_folders(const Json& params) {
    std::vector<std::string> out;
    const auto add = [&](const Json& uri) {
        if (!uri.is_string()) return;
        if (const auto path = path_of_uri(uri.get<std::string>())) out.push_back(*path);
    };
    const Json& folders = value_at(params, {"workspaceFolders"});
    if (folders.is_array())
        for (const Json& folder : folders) add(value_at(folder, {"uri"}));
    add(value_at(params, {"rootUri"}));
    if (const Json& path = value_at(params, {"rootPath"}); path.is_string()) out.push_back(path.get<std::string>());
    return out;
}

Json server_capabilities() {
    constexpr int kIncremental = 2;
    return {{"positionEncoding", "utf-16"},
            {"textDocumentSync", {{"openClose", true}, {"change", kIncremental}, {"save", {{"includeText", false}}}}},
            {"hoverProvider", true},
            {"definitionProvider", true},
            {"declarationProvider", true},
            {"implementationProvider", true},
            {"codeActionProvider", {{"codeActionKinds", {"quickfix"}}}},
            {"executeCommandProvider", {{"commands", Json::array({kAcceptCommand})}}}};
}

/// One change of didChange. Throws RequestError.
DocumentChange change_in(const Json& value) {
    DocumentChange out{std::nullopt, string_at(value, {"text"})};
    if (!value_at(value, {"range"}).is_null()) out.range = range_at(value, {"range"});
    return out;
}

int64_t version_in(const Json& params) {
    const Json& version = value_at(params, {"textDocument", "version"});
    return version.is_number_integer() ? version.get<int64_t>() : 0;
}

}  // namespace

void LanguageServer::take(const IncomingMessage& message) {
    if (!message.problem.empty()) return send_error(nullptr, ErrorCode::ParseError, message.problem);
    const Json json = bounded_json<Json>(message.body, kDeepestMessage);
    if (json.is_discarded()) return send_error(nullptr, ErrorCode::ParseError, "this is no JSON");
    if (!json.is_object())
        return send_error(nullptr, ErrorCode::InvalidRequest,
                          "a message is one object; batches are not of this protocol");
    const Json& id = value_at(json, {"id"});
    const Json& method = value_at(json, {"method"});
    const bool has_id = json.contains("id");
    const bool id_fits = id.is_string() || id.is_number_integer();
    if (method.is_null() && (json.contains("result") || json.contains("error"))) return;  // of no request of ours
    const Json& params = value_at(json, {"params"});
    if (!method.is_string() || (has_id && !id_fits) || value_at(json, {"jsonrpc"}) != "2.0" ||
        !(params.is_null() || params.is_object() || params.is_array()))
        return send_error(id_fits ? id : Json(nullptr), ErrorCode::InvalidRequest,
                          "expected {\"jsonrpc\": \"2.0\", \"id\", \"method\", \"params\"}");
    if (has_id)
        answer(id, method.get<std::string>(), params);
    else
        notice(method.get<std::string>(), params);
}

void LanguageServer::answer(const Json& id, const std::string& method, const Json& params) {
    static const std::map<std::string, Handler> kHandlers = {
        {"initialize", &LanguageServer::initialize},
        {"shutdown", &LanguageServer::shut_down},
        {"textDocument/definition", &LanguageServer::definition},
        {"textDocument/declaration", &LanguageServer::counterparts},
        {"textDocument/implementation", &LanguageServer::counterparts},
        {"textDocument/hover", &LanguageServer::hover},
        {"textDocument/codeAction", &LanguageServer::actions},
        {"workspace/executeCommand", &LanguageServer::execute},
    };
    try {
        if (state_ == State::New && method != "initialize")
            throw RequestError(ErrorCode::ServerNotInitialized, "send 'initialize' first");
        if (state_ == State::ShutDown) throw RequestError(ErrorCode::InvalidRequest, "the server has been shut down");
        const auto handler = kHandlers.find(method);
        if (handler == kHandlers.end()) throw RequestError(ErrorCode::MethodNotFound, "no method " + method);
        Json result = (this->*handler->second)(params);
        send({{"id", id}, {"result", std::move(result)}});
    } catch (const RequestError& problem) {
        send_error(id, problem.code, problem.what());
    } catch (const CannotDo& problem) {
        send_error(id, ErrorCode::RequestFailed, problem.what());
    } catch (const std::exception& problem) {
        send_error(id, ErrorCode::InternalError, problem.what());
    }
}

void LanguageServer::notice(const std::string& method, const Json& params) {
    if (method == "exit") {
        exit_code_ = exit_code_at_end();
        return;
    }
    if (state_ != State::Running) return;
    try {
        if (method == "initialized") note_change();
        if (method == "textDocument/didOpen") open(params);
        if (method == "textDocument/didChange") change(params);
        if (method == "textDocument/didClose") close(params);
        if (method == "textDocument/didSave" || method == "workspace/didChangeWatchedFiles") note_change();
    } catch (const RequestError& problem) {
        log(kLogMessage, method + ": " + problem.what());
    }
}

Json LanguageServer::initialize(const Json& params) {
    if (state_ != State::New) throw RequestError(ErrorCode::InvalidRequest, "'initialize' was sent before");
    state_ = State::Running;
    support_ = support_in(params);
    if (!set_up_.folder_given) {
        const std::vector<std::string> folders = workspace_folders(params);
        const auto has_map = [&](const std::string& folder) {
            return disk_.exists(join_path(find_root(disk_, folder), "portmap.toml"));
        };
        const auto chosen = std::find_if(folders.begin(), folders.end(), has_map);
        if (chosen != folders.end())
            set_up_.choice.directory = *chosen;
        else if (!folders.empty())
            set_up_.choice.directory = folders.front();
    }
    project_ = std::make_unique<LiveProject>(set_up_.choice, disk_);
    return {{"capabilities", server_capabilities()},
            {"serverInfo", {{"name", "porttool"}, {"version", set_up_.version}}}};
}

Json LanguageServer::shut_down(const Json&) {
    state_ = State::ShutDown;
    is_due_ = false;
    return nullptr;
}

void LanguageServer::open(const Json& params) {
    const std::string path = path_in(params), text = string_at(params, {"textDocument", "text"});
    Document& document = documents_[path];
    document = {string_at(params, {"textDocument", "uri"}), version_in(params), ""};
    published_.erase(path);  // the editor may know it by another URI now
    show(path, document, {{std::nullopt, text}});
}

void LanguageServer::change(const Json& params) {
    const std::string path = path_in(params);
    const auto document = documents_.find(path);
    if (document == documents_.end()) throw RequestError(ErrorCode::InvalidParams, "the document is not open");
    const Json& changes = value_at(params, {"contentChanges"});
    if (!changes.is_array()) throw RequestError(ErrorCode::InvalidParams, "params.contentChanges: expected a list");
    std::vector<DocumentChange> all;
    for (const Json& one : changes) all.push_back(change_in(one));
    document->second.version = version_in(params);
    show(path, document->second, all);
}

void LanguageServer::show(const std::string& path, Document& document, const std::vector<DocumentChange>& changes) {
    if (const std::string problem = apply_changes(document, changes); !problem.empty())
        log(kInfoMessage, path + ": " + problem);
    if (document.is_followed)
        project_->disk().show(path, document.text);
    else
        project_->disk().show_saved(path);
    note_change();
}

void LanguageServer::close(const Json& params) {
    const std::string path = path_in(params);
    if (documents_.erase(path) == 0) throw RequestError(ErrorCode::InvalidParams, "the document is not open");
    project_->disk().show_saved(path);
    note_change();
}

std::string LanguageServer::path_in(const Json& params) const {
    const std::string uri = string_at(params, {"textDocument", "uri"});
    const auto path = path_of_uri(uri);
    // What is no file has a name that none has: it is held, and no side has it.
    return path ? *path : uri;
}

std::string LanguageServer::uri_of(const std::string& path) const {
    const auto open = documents_.find(path);
    return open == documents_.end() ? file_uri(path) : open->second.uri;
}

void LanguageServer::look() {
    is_due_ = false;
    proposals_.reset();
    places_.reset();
    const UriOf uri = [this](const std::string& path) { return uri_of(path); };
    std::string error;
    try {
        const CheckedProject& project = project_->look();
        places_.emplace(project);
        proposals_.emplace(project, project_->disk());
        publish(diagnostics_of(project, *places_, uri));
        if (project_->said() != said_ && !project_->said().empty()) log(kInfoMessage, project_->said());
        said_ = project_->said();
    } catch (const CannotDo& problem) {
        error = problem.what();
    } catch (const GlobTooLarge& problem) {
        error = problem.what();
    }
    if (!error.empty()) {
        places_.reset();
        proposals_.reset();
        const CheckChoice& choice = project_->choice();
        const std::string name = choice.config.empty() ? "portmap.toml" : choice.config;
        const std::string path = absolute_path(
            join_path(choice.config.empty() ? find_root(disk_, choice.directory) : choice.directory, name));
        std::map<std::string, Json> of_map;
        if (disk_.exists(path)) of_map[path] = Json::array({diagnostic_of_error(error, name)});
        publish(std::move(of_map));
        if (error != error_) log(disk_.exists(path) ? kErrorMessage : kInfoMessage, error);
    }
    error_ = error;
}

void LanguageServer::publish(std::map<std::string, Json> diagnostics) {
    for (const auto& [path, known] : published_)
        if (!known.empty()) diagnostics.try_emplace(path, Json::array());
    for (const auto& [path, document] : documents_) diagnostics.try_emplace(path, Json::array());
    for (const auto& [path, list] : diagnostics) {
        const auto known = published_.find(path);
        if (known != published_.end() && known->second == list) continue;
        Json params = {{"uri", uri_of(path)}, {"diagnostics", list}};
        const auto open = documents_.find(path);
        if (open != documents_.end()) params["version"] = open->second.version;
        send({{"method", "textDocument/publishDiagnostics"}, {"params", std::move(params)}});
    }
    published_ = std::move(diagnostics);
}

const CheckedProject& LanguageServer::judged() {
    if (is_due_ || !places_) look();
    if (!places_) throw RequestError(ErrorCode::RequestFailed, error_);
    return project_->last();
}

Json LanguageServer::locations(const Counterparts& found) {
    Json out = Json::array();
    for (const JudgedPair* pair : found.pairs) {
        const Side there = other(found.unit->side);
        const UnitState* unit = pair->unit[there];
        if (unit == nullptr) continue;
        const std::string path = places_->path_of(there, unit->file);
        out.push_back(location_json(uri_of(path), places_->range_of(path, unit->id, unit->start_line)));
    }
    return out;
}

Json LanguageServer::counterparts(const Json& params) {
    const Position at = position_at(params, {"position"});
    const std::string path = path_in(params);
    judged();
    return locations(counterparts_at(*places_, path, at.line + 1));
}

/// A name within a body is left to the server of its language.
Json LanguageServer::definition(const Json& params) {
    const Position at = position_at(params, {"position"});
    const std::string path = path_in(params);
    judged();
    const Counterparts found = counterparts_at(*places_, path, at.line + 1);
    if (!found.unit || !is_about_unit(*found.unit, at)) return Json::array();
    return locations(found);
}

Json LanguageServer::hover(const Json& params) {
    const Position at = position_at(params, {"position"});
    const std::string path = path_in(params);
    const CheckedProject& project = judged();
    const Counterparts found = counterparts_at(*places_, path, at.line + 1);
    if (!found.unit) return nullptr;
    const std::string text =
        hover_text(project, *places_, found, [this](const std::string& one) { return uri_of(one); });
    return {{"contents", {{"kind", "markdown"}, {"value", text}}}};
}

Json LanguageServer::actions(const Json& params) {
    const Range range = range_at(params, {"range"});
    const std::string path = path_in(params);
    const Json& only = value_at(params, {"context", "only"});
    if (only.is_array() && !holds_text(only, "quickfix") && !holds_text(only, "")) return Json::array();
    const CheckedProject& project = judged();
    return code_actions(
        project, *places_, *proposals_, path, range, documents_, [this](const std::string& one) { return uri_of(one); },
        support_);
}

/// The record is made of what is saved.
void LanguageServer::require_saved(const Finding& finding) {
    for (const auto& place : {finding.source, finding.target}) {
        if (!place) continue;
        const std::string path = absolute_path(join_path(project_->last().project.root, place->file));
        const auto open = documents_.find(path);
        if (open == documents_.end()) continue;
        const FileText saved = disk_.read(path, kLargestSource);
        if (saved.error.empty() && saved.bytes == open->second.text) continue;
        throw RequestError(ErrorCode::RequestFailed, place->file + " is not saved; save it, and accept what was saved");
    }
}

Json LanguageServer::execute(const Json& params) {
    const std::string command = string_at(params, {"command"});
    if (command != kAcceptCommand) throw RequestError(ErrorCode::InvalidParams, "no command " + command);
    const Json& arguments = value_at(params, {"arguments"});
    if (!arguments.is_array() || arguments.size() != 1 || !arguments[0].is_string())
        throw RequestError(ErrorCode::InvalidParams, "params.arguments: expected one fingerprint");
    const auto fingerprint = arguments[0].get<std::string>();
    const CheckedProject& project = judged();
    const auto& findings = project.judgement.findings;
    const auto finding = std::find_if(findings.begin(), findings.end(),
                                      [&](const Finding& one) { return one.fingerprint == fingerprint; });
    if (finding == findings.end())
        throw RequestError(ErrorCode::RequestFailed, "there is no finding " + fingerprint + " any more");
    require_saved(*finding);
    const std::string said = set_up_.accept(project.project.root, fingerprint);
    log(kInfoMessage, said);
    look();
    return nullptr;
}

/// An error is shown to the user, all else goes into the log.
void LanguageServer::log(int type, const std::string& message) {
    std::string text = message;
    while (text.ends_with('\n')) text.pop_back();
    send({{"method", type == kErrorMessage ? "window/showMessage" : "window/logMessage"},
          {"params", {{"type", type}, {"message", text}}}});
}

void LanguageServer::send_error(const Json& id, ErrorCode code, const std::string& message) {
    send({{"id", id}, {"error", {{"code", static_cast<int>(code)}, {"message", message}}}});
}

void LanguageServer::send(Json message) {
    Json whole = {{"jsonrpc", "2.0"}};
    whole.update(message);
    set_up_.send(json_text(whole, -1));
}

}  // namespace porttool::lsp
