// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <map>
#include <set>
#include <spirv-tools/libspirv.hpp>
#include <tuple>
#include <utility>

#include "source_core/device/kernel_compiler.h"
#include "source_core/device/kernel_files.h"
#include "source_core/device/kernel_set.h"
#include "source_core/device/spirv_passes.h"

using namespace source_core;

namespace {

constexpr uint32_t ALL_FEATURES = 0xFFFFFFFFu;

std::map<std::string, std::string> built_in_kernels() {
    auto files = read_kernel_files("");
    EXPECT_TRUE(files.ok());
    return *files;
}

// Compiled once for all tests of a process.
const std::vector<uint32_t>& compile(Kernel kernel, uint32_t features, TableAccess access, bool spelled_out = false) {
    static const auto files = built_in_kernels();
    static std::map<std::tuple<Kernel, uint32_t, TableAccess, bool>, std::vector<uint32_t>> modules;
    const auto [found, is_new] = modules.try_emplace({kernel, features, access, spelled_out});
    if (is_new) {
        KernelVariant variant;
        variant.features = features;
        variant.tables.fill(access);
        const ExactArithmetic arithmetic{spelled_out, spelled_out, spelled_out, spelled_out};
        auto words = compile_kernel(files, std::string(kernel_name(kernel)) + ".comp", variant.preamble(), arithmetic);
        EXPECT_TRUE(words.ok()) << words.status.message;
        if (words.ok()) {
            found->second = std::move(*words);
        }
    }
    EXPECT_FALSE(found->second.empty()) << "did not compile";
    return found->second;
}

std::string disassemble(const std::vector<uint32_t>& words) {
    std::string text;
    spvtools::SpirvTools(SPV_ENV_VULKAN_1_2)
        .Disassemble(words, &text, SPV_BINARY_TO_TEXT_OPTION_NO_HEADER | SPV_BINARY_TO_TEXT_OPTION_FRIENDLY_NAMES);
    return text;
}

void for_each_line(const std::string& text, const std::function<void(const std::string&)>& visit) {
    size_t at = 0;
    while (at < text.size()) {
        const size_t end = text.find('\n', at);
        visit(text.substr(at, end - at));
        at = end + 1;
    }
}

void expect_valid(const std::vector<uint32_t>& words) {
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_2);
    std::string messages;
    tools.SetMessageConsumer([&messages](spv_message_level_t, const char*, const spv_position_t&, const char* text) {
        messages += std::string(text) + "; ";
    });
    EXPECT_TRUE(tools.Validate(words)) << messages;
}

struct Includes {
    const char* what;
    std::map<std::string, std::string> added;  // in front of files that are there, or whole
    std::vector<const char*> told;             // none: compiles
};

std::vector<Includes> includes() {
    const std::string self = "#include \"finalize.glsl\"\n", own = "#include \"own0.glsl\"\n";
    std::vector<Includes> rows = {
        {"itself", {{"finalize.glsl", self}}, {"finalize.glsl:1: '#include'", "32 files deep"}},
        {"itself, twice", {{"finalize.glsl", "\n" + self + self}}, {"finalize.glsl:2: '#include'", "32 files deep"}},
        {"one another", {{"finalize.glsl", own}, {"own0.glsl", self}}, {"own0.glsl:1: '#include'", "32 files deep"}},
        {"itself behind a guard", {{"finalize.glsl", "#ifndef OWN\n#define OWN\n" + self + "#endif\n"}}, {}},
        {"none", {{"finalize.glsl", "#include \"gone.glsl\"\n"}}, {"finalize.glsl:1: '#include'", "gone.glsl"}}};
    Includes deep{"a file that includes a file, 18 times", {{"finalize.glsl", own}}, {}};
    Includes doubled{"two of the next, 24 times", {{"finalize.glsl", own}}, {"own22.glsl:", "4096 includes"}};
    for (int i = 0; i < 24; ++i) {
        const std::string name = "own" + std::to_string(i) + ".glsl";
        const std::string line = "#include \"own" + std::to_string(i + 1) + ".glsl\"\n";
        deep.added[name] = i < 18 ? line : "";
        doubled.added[name] = i < 23 ? line + line : "";
    }
    rows.push_back(deep);
    rows.push_back(doubled);
    return rows;
}

// Such a kernel was once read without end.
TEST(KernelIncludes, EndAndAreToldWithFileAndLine) {
    for (const Includes& row : includes()) {
        auto files = built_in_kernels();
        for (const auto& [name, text] : row.added) {
            files[name] = text + files[name];
        }
        const auto start = std::chrono::steady_clock::now();
        const auto words = compile_kernel(files, "finalize.comp", KernelVariant().preamble(), {});
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5)) << row.what;
        EXPECT_EQ(words.ok(), row.told.empty()) << row.what << ": " << words.status.message;
        for (const char* told : row.told) {
            EXPECT_NE(words.status.message.find(told), std::string::npos) << words.status.message;
        }
    }
}

class EveryModule : public testing::TestWithParam<std::tuple<uint32_t, uint32_t, TableAccess>> {
protected:
    Kernel kernel() const { return static_cast<Kernel>(std::get<0>(GetParam())); }
    const std::vector<uint32_t>& module() const {
        return compile(kernel(), std::get<1>(GetParam()), std::get<2>(GetParam()));
    }
};

}  // namespace

TEST_P(EveryModule, IsValid) { expect_valid(module()); }

TEST_P(EveryModule, FusesNoFloatArithmetic) {
    const std::string text = disassemble(module());
    std::set<std::string> decorated;
    std::set<std::string> computed;
    for_each_line(text, [&](const std::string& line) {
        if (line.find("NoContraction") != std::string::npos) {
            const size_t start = line.find('%');
            decorated.insert(line.substr(start, line.find(' ', start) - start));
        }
        for (const char* op : {"OpFAdd ", "OpFSub ", "OpFMul ", "OpFDiv ", "OpFNegate ", "OpDot ",
                               "OpVectorTimesScalar ", " Sqrt ", " Floor ", " FMix "}) {
            if (line.find(op) != std::string::npos && line.find(" = ") != std::string::npos) {
                const size_t start = line.find('%');
                computed.insert(line.substr(start, line.find(' ', start) - start));
            }
        }
    });
    for (const std::string& id : computed) {
        EXPECT_TRUE(decorated.contains(id)) << id;
    }
    if (kernel() == Kernel::shade) {
        EXPECT_GT(computed.size(), 300u) << "the test would not notice";
    }
}

class SpelledOutModule : public testing::TestWithParam<uint32_t> {
protected:
    const std::vector<uint32_t>& module() const {
        return compile(static_cast<Kernel>(GetParam()), ALL_FEATURES, TableAccess::storage, true);
    }
};

TEST_P(SpelledOutModule, IsValid) { expect_valid(module()); }

TEST_P(SpelledOutModule, LeavesNothingToTheDeviceThatItMayRoundAsItLikes) {
    const std::string text = disassemble(module());
    for_each_line(text, [](const std::string& line) {
        for (const char* op : {"OpFDiv ", "OpDot ", "OpFRem ", "OpFMod ", "OpMatrixTimes", "OpVectorTimesMatrix "}) {
            EXPECT_EQ(line.find(op), std::string::npos) << line;
        }
        if (const size_t at = line.find("OpExtInst "); at != std::string::npos) {
            const bool is_certain = line.find("FAbs") != std::string::npos || line.find("Floor") != std::string::npos ||
                                    line.find(" S") != std::string::npos || line.find(" U") != std::string::npos ||
                                    line.find("FindUMsb") != std::string::npos;
            EXPECT_TRUE(is_certain && line.find("Sqrt") == std::string::npos) << line;
        }
    });
    for (const char* control : {"DenormPreserve 32", "SignedZeroInfNanPreserve 32", "RoundingModeRTE 32"}) {
        EXPECT_NE(text.find(control), std::string::npos) << control;
    }
    if (static_cast<Kernel>(GetParam()) == Kernel::shade) {
        EXPECT_NE(text.find("exact_quotient"), std::string::npos) << "the test would not notice";
    }
}

INSTANTIATE_TEST_SUITE_P(Kernels, SpelledOutModule, testing::Range(0u, KERNEL_COUNT));

INSTANTIATE_TEST_SUITE_P(Kernels, EveryModule,
                         testing::Combine(testing::Range(0u, KERNEL_COUNT), testing::Values(0u, ALL_FEATURES),
                                          testing::Values(TableAccess::texels, TableAccess::storage,
                                                          TableAccess::address)));

TEST(BufferAccess, IsMarkedByWhatAKernelDoes) {
    // A buffer's member decorations, by the name of its block.
    const auto marks = [](Kernel kernel) {
        std::map<std::string, std::string> result;
        for_each_line(disassemble(compile(kernel, ALL_FEATURES, TableAccess::texels)), [&](const std::string& line) {
            for (const char* mark : {"NonWritable", "NonReadable"}) {
                if (line.find("OpMemberDecorate %") != std::string::npos && line.find(mark) != std::string::npos) {
                    const size_t start = line.find('%') + 1;
                    result[line.substr(start, line.find(' ', start) - start)] += mark;
                }
            }
        });
        return result;
    };
    auto extend = marks(Kernel::extend);
    EXPECT_EQ(extend["path_origin_block"], "NonWritable");
    EXPECT_EQ(extend["queue_block"], "NonWritable");
    EXPECT_EQ(extend["surface_queue_block"], "NonReadable");
    EXPECT_EQ(extend["shadow_origin_block"], "") << "not used";
    auto shade = marks(Kernel::shade);
    EXPECT_EQ(shade["surface_queue_block"], "NonWritable");
    EXPECT_EQ(shade["next_queue_block"], "NonReadable");
    EXPECT_EQ(shade["path_radiance_block"], "") << "read and written";
    EXPECT_EQ(shade["CountersBlock"], "") << "atomics read and write";
}

TEST(ForbidContraction, LeavesADecoratedModuleAlone) {
    const auto words = compile(Kernel::extend, 0, TableAccess::texels);
    EXPECT_EQ(forbid_contraction(words), words);
}
