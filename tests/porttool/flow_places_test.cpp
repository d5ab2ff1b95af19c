// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// A statement that both sides gain stands at one place of the source and at each place of the port in turn, among
// statements that the sides say in words of their own.
#include <gtest/gtest.h>

#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::flow_places_test {
namespace {

const std::string kKernel =
    "__global__ void f(const float4* bodies, float4* sums, int n, float soft, float most) {\n"
    "    int i = blockIdx.x * blockDim.x + threadIdx.x;\n"
    "    if (i >= n) return;\n"
    "    float ax = 0.0f;\n"
    "    float ay = 0.0f;\n"
    "    for (int j = 0; j < n; ++j) {\n"
    "        float dx = bodies[j].x - bodies[i].x;\n"
    "        float dy = bodies[j].y - bodies[i].y;\n"
    "        float r2 = dx * dx + dy * dy + soft;\n"
    "        /*in*/\n"
    "        float inv = rsqrtf(r2);\n"
    "        ax += bodies[j].w * inv * inv * inv * dx;\n"
    "        ay += bodies[j].w * inv * inv * inv * dy;\n"
    "    }\n"
    "    float pull = sqrtf(ax * ax + ay * ay);\n"
    "    /*out*/\n"
    "    sums[i].x = ax;\n"
    "    sums[i].y = ay;\n"
    "    sums[i].z = pull;\n"
    "    sums[i].w = pull * most;\n"
    "}\n";

/// The places of the port have numbers.
const std::string kPortOfKernel =
    "void f(const Crowd& crowd, std::vector<Push>& all, float soft, float most) {\n"
    "    for (size_t a = 0; a < crowd.size(); ++a) {\n"
    "        Push force = {0, 0};\n"
    "        for (size_t b = 0; b < crowd.size(); ++b) {\n"
    "            const float rx = crowd[b].at[0] - crowd[a].at[0];\n"
    "            const float ry = crowd[b].at[1] - crowd[a].at[1];\n"
    "            /*0*/\n"
    "            const float dist2 = rx * rx + ry * ry + soft;\n"
    "            /*1*/\n"
    "            const float w = 1.0f / std::sqrt(dist2);\n"
    "            /*2*/\n"
    "            const float mass = crowd[b].mass * w * w * w;\n"
    "            force.x += mass * rx;\n"
    "            /*3*/\n"
    "            force.y += mass * ry;\n"
    "            /*4*/\n"
    "        }\n"
    "        /*5*/\n"
    "        const float length = std::sqrt(force.x * force.x + force.y * force.y);\n"
    "        /*6*/\n"
    "        all[a].x = force.x;\n"
    "        all[a].y = force.y;\n"
    "        all[a].z = length;\n"
    "        /*7*/\n"
    "        all[a].w = length * most;\n"
    "        /*8*/\n"
    "    }\n"
    "}\n";

std::string put_at(std::string text, const std::string& mark, const std::string& statement) {
    const size_t at = text.find("/*" + mark + "*/");
    EXPECT_NE(at, std::string::npos) << mark;
    return text.replace(at, mark.size() + 4, statement);
}

/// A local that is written is no constant any more.
std::string with_variables(std::string text, const std::string& name) {
    const std::string constant = "const float " + name + " ";
    const size_t at = text.find(constant);
    return at == std::string::npos ? text : text.erase(at, 6);
}

struct PlacedStatement {
    std::string source, mark, target, written;
    std::string right;  ///< the places of the port that give the same program
    std::string wrong;  ///< those that do not
};

std::string level_of_placed(const PlacedStatement& row, const std::string& place) {
    MemoryDisk disk;
    disk.files = {{"/r/s/k.cu", kKernel},
                  {"/r/t/k.cpp", kPortOfKernel},
                  {"/r/portmap.toml",
                   "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n[[pair]]\nsource = "
                   "\"s/k.cu:f\"\ntarget = \"t/k.cpp:f\"\n"}};
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
    const CommandRun paired = run(disk, {"-C", "/r", "accept", "s/k.cu:f=t/k.cpp:f"});
    EXPECT_EQ(paired.exit_code, 0) << paired.err;
    disk.files["/r/s/k.cu"] = put_at(kKernel, row.mark, row.source);
    disk.files["/r/t/k.cpp"] = put_at(with_variables(kPortOfKernel, row.written), place, row.target);
    std::string out;
    const nlohmann::json report = check(disk);
    for (const auto& finding : report["findings"])
        if (out.empty() || finding["level"] == "error") out = finding["level"];
    return out;
}

TEST(FlowPlaces, AStatementStandsWhereItStandsAmongTheUsesOfItsLocals) {
    const std::vector<PlacedStatement> rows = {
        {"r2 *= 2.0f;", "in", "dist2 *= 2.0f;", "dist2", "1", "02345678"},
        {"if (r2 > 9.0f) r2 = 9.0f;", "in", "if (dist2 > 9.0f) dist2 = 9.0f;", "dist2", "1", "02345678"},
        {"if (r2 == 0.5f) continue;", "in", "if (dist2 == 0.5f) continue;", "", "12", "0345678"},
        {"if (r2 == 0.5f) break;", "in", "if (dist2 == 0.5f) break;", "", "12", "0345678"},
        {"pull *= 0.25f;", "out", "length *= 0.25f;", "length", "6", "1234578"},
        {"if (pull > 0.25f) return;", "out", "if (length > 0.25f) continue;", "", "6", "1234578"},
    };
    for (const PlacedStatement& row : rows) {
        for (const char place : row.right) {
            SCOPED_TRACE(row.target + " at its place " + place);
            EXPECT_EQ(level_of_placed(row, {place}), "");
        }
        for (const char place : row.wrong) {
            SCOPED_TRACE(row.target + " at the wrong place " + place);
            EXPECT_EQ(level_of_placed(row, {place}), "error");
        }
    }
}

TEST(FlowPlaces, ADeletedStatementIsOfTheSameLocalOnBothSides) {
    const std::string kernel =
        "__kernel void f(__global const float* h, __global float* water, __global float* mud, float rain) {\n"
        "    int i = get_global_id(0);\n"
        "    float w = water[i];\n"
        "    float m = mud[i];\n"
        "    w += rain;\n"
        "    w *= 0.99f;\n"
        "    for (int k = 0; k < 8; k++) {\n"
        "        float cap = w * h[i];\n"
        "        m += (cap - m) * 0.3f;\n"
        "    }\n"
        "    m *= 0.99f;\n"
        "    water[i] = w;\n"
        "    mud[i] = m;\n"
        "}\n";
    const std::string port =
        "void f(std::vector<Column>& columns, float drops) {\n"
        "    for (Column& column : columns) {\n"
        "        float wet = column.wet;\n"
        "        float dirt = column.dirt;\n"
        "        wet += drops;\n"
        "        wet *= 0.99f;\n"
        "        for (int turn = 0; turn < 8; ++turn) {\n"
        "            float room = wet * column.height;\n"
        "            dirt += (room - dirt) * 0.3f;\n"
        "        }\n"
        "        dirt *= 0.99f;\n"
        "        column.wet = wet;\n"
        "        column.dirt = dirt;\n"
        "    }\n"
        "}\n";
    for (const bool right : {true, false}) {
        MemoryDisk disk;
        disk.files = {{"/r/s/k.cl", kernel},
                      {"/r/t/k.cpp", port},
                      {"/r/portmap.toml",
                       "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n[[pair]]\nsource = "
                       "\"s/k.cl:f\"\ntarget = \"t/k.cpp:f\"\n"}};
        ASSERT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
        ASSERT_EQ(run(disk, {"-C", "/r", "accept", "s/k.cl:f=t/k.cpp:f"}).exit_code, 0);
        disk.files["/r/s/k.cl"] = replaced(kernel, "    w *= 0.99f;\n", "");
        disk.files["/r/t/k.cpp"] = replaced(port, right ? "        wet *= 0.99f;\n" : "        dirt *= 0.99f;\n", "");
        const nlohmann::json report = check(disk);
        EXPECT_EQ(rules(report), right ? Rules{} : Rules{"port-differs"}) << report.dump(1);
        if (!right) {
            EXPECT_EQ(report["findings"][0]["level"], "error");
        }
    }
}

// However a local is declared, what is written to it stands before or behind where it is read.
TEST(FlowPlaces, LocalsAreDeclaredInManyWays) {
    const std::string kernel =
        "__global__ void f(const Surface* hits, float* out, int n, int depth) {\n"
        "    int i = blockIdx.x * blockDim.x + threadIdx.x;\n"
        "    if (i >= n) return;\n"
        "    float beta = 1.0f;\n"
        "    float sum = 0.0f;\n"
        "    for (int k = 0; k < depth; ++k) {\n"
        "        sum += beta * hits[i].emission;\n"
        "        beta *= hits[i].albedo;\n"
        "        /*in*/\n"
        "    }\n"
        "    out[i] = sum;\n"
        "}\n";
    const std::string port =
        "void Shader::Run(Film& film) const {\n"
        "    for (int pixel = 0; pixel < film.size(); ++pixel) {\n"
        "        LOCALS\n"
        "        for (int bounce = 0; bounce < options_.maxDepth; ++bounce) {\n"
        "            /*0*/\n"
        "            total += throughput * Fetch(pixel).emission;\n"
        "            /*1*/\n"
        "            throughput *= Fetch(pixel).albedo;\n"
        "            /*2*/\n"
        "        }\n"
        "        film.Accumulate(pixel, total);\n"
        "    }\n"
        "}\n";
    const auto told = [&](const std::string& locals, const std::string& edit, const std::string& of_port,
                          const std::string& place) {
        const std::string text = replaced(port, "LOCALS", locals);
        MemoryDisk disk;
        disk.files = {{"/r/s/k.cu", kernel},
                      {"/r/t/k.cpp", text},
                      {"/r/portmap.toml",
                       "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n[[pair]]\nsource = "
                       "\"s/k.cu:f\"\ntarget = \"t/k.cpp:Shader::Run\"\n"}};
        EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
        disk.files["/r/s/k.cu"] = put_at(kernel, "in", edit);
        disk.files["/r/t/k.cpp"] = put_at(text, place, of_port);
        return rules(check(disk));
    };
    for (const char* locals :
         {"float total = 0.0f; float throughput = 1.0f;", "Spectrum total(0.0f), throughput(1.0f);",
          "Spectrum total(0.0f); Spectrum throughput(1.0f);", "float total(0.0f); float throughput(1.0f);",
          "static thread_local Spectrum total(0.0f), throughput(1.0f);",
          "float total = 0.0f; float& throughput = state_[pixel].throughput;"}) {
        for (const std::string edit : {"X = 0.5f * X + 0.1f;", "X = clamp_firefly(X);", "if (X > 4.0f) X = 4.0f;"}) {
            const auto of = [&](const std::string& name) {
                std::string out = edit;
                for (size_t at = out.find('X'); at != std::string::npos; at = out.find('X')) out.replace(at, 1, name);
                return out;
            };
            SCOPED_TRACE(locals + (" " + edit));
            EXPECT_EQ(told(locals, of("beta"), of("throughput"), "2"), Rules{});
            for (const char* place : {"0", "1"})
                EXPECT_EQ(told(locals, of("beta"), of("throughput"), place), Rules{"port-differs"}) << place;
        }
    }
}

// The `v` of the one loop is not that of the other: their uses are not counted together.
TEST(FlowPlaces, LocalsOfOneNameInTwoLoopsAreTwo) {
    const std::string kernel =
        "__global__ void f(const float* in, float* out, int n) {\n"
        "    int i = blockIdx.x * blockDim.x + threadIdx.x;\n"
        "    if (i >= n) return;\n"
        "    float v = in[i];\n"
        "    v = v * 0.5f;\n"
        "    out[i] = v * v;\n"
        "}\n";
    const std::string port =
        "void f(const std::vector<float>& in, std::vector<float>& out, std::vector<float>& all) {\n"
        "    for (size_t k = 0; k < in.size(); ++k) {\n"
        "        float v = all[k];\n"
        "        v = v + 1.0f;\n"
        "        all[k] = v;\n"
        "    }\n"
        "    for (size_t k = 0; k < in.size(); ++k) {\n"
        "        float v = in[k];\n"
        "        v = v * 0.5f;\n"
        "        out[k] = v * v;\n"
        "    }\n"
        "}\n";
    MemoryDisk disk;
    disk.files = {{"/r/s/k.cu", kernel},
                  {"/r/t/k.cpp", port},
                  {"/r/portmap.toml",
                   "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n[[pair]]\nsource = "
                   "\"s/k.cu:f\"\ntarget = \"t/k.cpp:f\"\n"}};
    ASSERT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
    ASSERT_EQ(run(disk, {"-C", "/r", "accept", "s/k.cu:f=t/k.cpp:f"}).exit_code, 0);
    disk.files["/r/s/k.cu"] = replaced(kernel, "v * 0.5f;\n", "v * 0.5f;\n    v += 3.0f;\n");
    disk.files["/r/t/k.cpp"] = replaced(port, "v * 0.5f;\n", "v * 0.5f;\n        v += 3.0f;\n");
    const nlohmann::json report = check(disk);
    EXPECT_EQ(rules(report), Rules{}) << report.dump(1);
}

}  // namespace
}  // namespace porttool::testing::flow_places_test
