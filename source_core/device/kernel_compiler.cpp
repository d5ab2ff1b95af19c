// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/device/kernel_compiler.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <spirv-tools/optimizer.hpp>
#include <sstream>

#include "source_core/device/spirv_passes.h"

namespace source_core {

namespace {

constexpr int MESSAGES_SHOWN = 3;

// A kernel that includes itself would be read without end: ours include at most ten deep, and a hundred times.
constexpr size_t DEEPEST_INCLUDE = 32;
constexpr size_t MOST_INCLUDES = 4096;
constexpr size_t LARGEST_INCLUDED = size_t{1} << 24;

// Finds includes in the map of kernel files: one flat folder.
class MapIncluder : public glslang::TShader::Includer {
public:
    explicit MapIncluder(const std::map<std::string, std::string>& files) : files_(files) {}

    IncludeResult* includeLocal(const char* header, const char*, size_t depth) override {
        const auto file = files_.find(header);
        if (file == files_.end()) {
            return nullptr;
        }
        if (depth > DEEPEST_INCLUDE) {
            return refuse("includes go more than 32 files deep; does one of them include itself?");
        }
        included_ += file->second.size();
        if (++includes_ > MOST_INCLUDES || included_ > LARGEST_INCLUDED) {
            return refuse("more than 4096 includes or 16 MiB of them; does a file include others twice?");
        }
        return new IncludeResult(file->first, file->second.data(), file->second.size(), nullptr);
    }
    IncludeResult* includeSystem(const char*, const char*, size_t) override { return nullptr; }
    void releaseInclude(IncludeResult* result) override { delete result; }

    // Why an include of a file that is there was not read; "" where none was refused.
    const std::string& refused() const { return refused_; }

private:
    // glslang goes on behind what it could not include: nothing more is read.
    IncludeResult* refuse(const char* why) {
        refused_ = refused_.empty() ? why : refused_;
        includes_ = MOST_INCLUDES;
        return nullptr;
    }

    const std::map<std::string, std::string>& files_;
    std::string refused_;
    size_t includes_ = 0, included_ = 0;  // how many, and their characters
};

// glslang writes "ERROR: file:line: text" among summary lines; the first few such lines are what a person needs.
// What follows an include that was refused is of a text that is not whole.
Status compile_error(const std::string& name, const std::string& log, const std::string& refused = "") {
    const int most = refused.empty() ? MESSAGES_SHOWN : 1;
    std::istringstream lines(log);
    std::string line;
    std::string text = "failed to compile the kernel " + name;
    int shown = 0;
    while (std::getline(lines, line) && shown < most) {
        const bool is_summary = line.find("compilation errors") != std::string::npos ||
                                line.find("compilation terminated") != std::string::npos;
        if (line.rfind("ERROR: ", 0) == 0 && !is_summary) {
            line.erase(line.find_last_not_of(" \r") + 1);
            text += (shown == 0 ? ": " : "; ") + line.substr(7);
            ++shown;
        }
    }
    return Status::error(StatusCode::internal, text + (refused.empty() ? "" : ": " + refused));
}

// glslang wants one initialisation a process; it counts calls, so a static pair is enough.
struct GlslangProcess {
    GlslangProcess() { glslang::InitializeProcess(); }
    ~GlslangProcess() { glslang::FinalizeProcess(); }
};

Result<std::vector<uint32_t>> finish(const std::string& name, const std::vector<uint32_t>& compiled,
                                     const ExactArithmetic& arithmetic) {
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);
    // What the scene's features leave out goes first: a driver inlines every call that is left, and only then sees what
    // is never run. On lavapipe that was three quarters of the time that a core takes to start.
    optimizer.RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    const std::vector<uint32_t> words =
        forbid_contraction(arithmetic.spelled_out ? call_exact_arithmetic(compiled) : compiled);
    std::vector<uint32_t> live;
    if (!optimizer.Run(words.data(), words.size(), &live, options)) {
        return Status::error(StatusCode::internal, "failed to remove what is never run from the kernel " + name);
    }
    return ask_for_float_controls(mark_buffer_access(live), arithmetic);
}

}  // namespace

Result<std::vector<uint32_t>> compile_kernel(const std::map<std::string, std::string>& files, const std::string& name,
                                             const std::string& preamble, const ExactArithmetic& arithmetic) {
    static const GlslangProcess process;
    const auto file = files.find(name);
    if (file == files.end()) {
        return Status::error(StatusCode::not_found, "there is no kernel '" + name + "'");
    }
    const char* text = file->second.c_str();
    const int text_length = static_cast<int>(file->second.size());
    const char* text_name = name.c_str();
    // No text calls what is spelled out yet.
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules |
                                                   (arithmetic.spelled_out ? EShMsgKeepUncalled : EShMsgDefault));

    glslang::TShader shader(EShLangCompute);
    shader.setStringsWithLengthsAndNames(&text, &text_length, &text_name, 1);
    const std::string before = preamble + (arithmetic.spelled_out ? EXACT_ARITHMETIC_TEXT : "");
    shader.setPreamble(before.c_str());
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    MapIncluder includer(files);
    if (!shader.parse(GetDefaultResources(), 460, false, messages, includer)) {
        return compile_error(name, shader.getInfoLog(), includer.refused());
    }
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages)) {
        return compile_error(name, program.getInfoLog());
    }
    std::vector<uint32_t> words;
    glslang::SpvOptions options;
    options.disableOptimizer = true;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), words, &options);
    return finish(name, words, arithmetic);
}

}  // namespace source_core
