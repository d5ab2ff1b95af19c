// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/porttool/temporary_repository.h"

namespace porttool::testing {

/// A pair of files in git, in step; what sync makes of an edit of the first.
class SyncedRepository : public TemporaryRepository {
protected:
    void start(const std::string& source, const std::string& before, const std::string& target,
               const std::string& port) {
        source_path = "src/" + source, port_path = "port/" + target;
        write(source_path, before);
        write(port_path, port);
        ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
        commit("in step");
    }
    nlohmann::json proposal_of(const std::string& now) {
        write(source_path, now);
        return nlohmann::json::parse(porttool({"sync", "--format", "json"}).out)["proposals"][0];
    }
    /// White space is a port's own affair.
    void expect_ported(const std::string& now, const std::string& ported) {
        const nlohmann::json got = proposal_of(now);
        ASSERT_EQ(got["state"], "proposed") << got.dump(1);
        ASSERT_EQ(porttool({"sync", "--apply"}).exit_code, 0);
        EXPECT_EQ(dense(port_now()), dense(ported));
    }
    /// The same, white space and all.
    void expect_written(const std::string& now, const std::string& ported) {
        const nlohmann::json got = proposal_of(now);
        ASSERT_EQ(got["state"], "proposed") << got.dump(1);
        ASSERT_EQ(porttool({"sync", "--apply"}).exit_code, 0);
        EXPECT_EQ(port_now(), ported);
    }
    /// What is left must name `what` and the line of the port.
    void expect_left(const std::string& now, const std::string& what, int line) {
        const nlohmann::json got = proposal_of(now);
        ASSERT_FALSE(got["left"].empty()) << got.dump(1);
        EXPECT_NE(got["left"][0]["message"].get<std::string>().find(what), std::string::npos) << got.dump(1);
        EXPECT_EQ(got["left"][0]["target_line"], line) << got.dump(1);
    }
    /// A text without white space.
    static std::string dense(const std::string& text) {
        std::string out;
        for (const char c : text)
            if (c != ' ' && c != '\n') out += c;
        return out;
    }
    std::string port_now() const { return disk.read((root / port_path).string(), 1 << 20).bytes; }

    std::string source_path, port_path;
};

}  // namespace porttool::testing
