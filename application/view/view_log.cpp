// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/view_log.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstring>

#include "application/file_output.h"

namespace application {

using render_system::Status;

Status ViewLog::open(const std::string& file) {
    name_ = file;
    const auto descriptor = open_emptied(file);
    if (!descriptor.ok()) return Status::invalid("--log: " + descriptor.status.message);
    file_.reset(fdopen(*descriptor, "w"));
    return Status::success();
}

double ViewLog::ms_of(std::chrono::steady_clock::time_point moment) const {
    return std::chrono::duration<double, std::milli>(moment - start_).count();
}

void ViewLog::say(const char* event, const nlohmann::ordered_json& detail) {
    if (!file_) return;
    constexpr double TENTHS = 10.0;
    const nlohmann::ordered_json line = {
        {"t_ms", std::round(now_ms() * TENTHS) / TENTHS}, {"event", event}, {"detail", detail}};
    const std::string text = line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    const bool is_written = std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size();
    if (is_written && std::fflush(file_.get()) == 0) return;
    status_ = Status::invalid(fmt::format("--log {}: {}; what came later is not in it", name_, std::strerror(errno)));
    file_.reset();
}

}  // namespace application
