// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/spirv/spirv.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <new>
#include <spirv-tools/optimizer.hpp>
#include <sstream>

#include "porttool/read/cannot_do.h"
#include "porttool/spirv/compile_limit.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

// glslang wants one initialisation a process.
struct GlslangProcess {
    GlslangProcess() { glslang::InitializeProcess(); }
    ~GlslangProcess() { glslang::FinalizeProcess(); }
};

EShLanguage language_of(ShaderStage stage) {
    constexpr EShLanguage kLanguages[] = {EShLangVertex,   EShLangTessControl, EShLangTessEvaluation, EShLangGeometry,
                                          EShLangFragment, EShLangCompute,     EShLangRayGen,         EShLangIntersect,
                                          EShLangAnyHit,   EShLangClosestHit,  EShLangMiss,           EShLangCallable,
                                          EShLangTask,     EShLangMesh};
    return kLanguages[static_cast<size_t>(stage)];
}

class Includer : public glslang::TShader::Includer {
public:
    Includer(const ShaderFiles& files, const std::vector<std::string>& include) : files_(files), include_(include) {}

    IncludeResult* includeLocal(const char* name, const char* from, size_t depth) override {
        return find(from, name, depth);
    }
    IncludeResult* includeSystem(const char* name, const char* from, size_t depth) override {
        return find(from, name, depth);
    }
    void releaseInclude(IncludeResult* result) override { delete result; }

private:
    static constexpr size_t kDeepest = 100;  // a file without a guard that includes itself

    IncludeResult* find(const std::string& from, const std::string& name, size_t depth) const {
        const std::string path = depth > kDeepest ? "" : find_include(files_, from, name, include_);
        if (path.empty()) return nullptr;
        const std::string* text = files_(path);
        return new IncludeResult(path, text->data(), text->size(), nullptr);
    }

    const ShaderFiles& files_;
    const std::vector<std::string>& include_;
};

/// "ERROR: file:line: text" without its first word; the first such line is what a person needs.
std::string first_error(const std::string& log) {
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("ERROR: ")) return line.substr(7);
    return log.empty() ? "no reason given" : log.substr(0, log.find('\n'));
}

/// The module as glslang makes it, with names; or the error.
std::vector<uint32_t> compile(const ShaderFiles& files, const std::string& entry,
                              const std::vector<std::string>& include, const std::string& preamble,
                              glslang::EShClient client, std::string& error) {
    const bool vulkan = client == glslang::EShClientVulkan;
    const EShLanguage stage = language_of(*stage_of_path(entry));
    const std::string* file = files(entry);
    if (file == nullptr) {
        error = entry + " is not there";
        return {};
    }
    const char* text = file->data();
    const int length = static_cast<int>(file->size());
    const char* name = entry.c_str();
    const std::string before = "#extension GL_GOOGLE_include_directive : enable\n" + preamble + "\n";
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | (vulkan ? EShMsgVulkanRules : EShMsgDefault));
    glslang::TShader shader(stage);
    shader.setStringsWithLengthsAndNames(&text, &length, &name, 1);
    shader.setPreamble(before.c_str());
    shader.setEnvInput(glslang::EShSourceGlsl, stage, client, 100);
    shader.setEnvClient(client, vulkan ? glslang::EShTargetVulkan_1_3 : glslang::EShTargetOpenGL_450);
    shader.setEnvTarget(glslang::EShTargetSpv, vulkan ? glslang::EShTargetSpv_1_6 : glslang::EShTargetSpv_1_0);
    shader.setAutoMapLocations(true);
    shader.setAutoMapBindings(true);
    Includer includer(files, include);
    constexpr int kVersion = 460;  // where the text names none
    if (!shader.parse(GetDefaultResources(), kVersion, false, messages, includer)) {
        error = first_error(shader.getInfoLog());
        return {};
    }
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages) || !program.mapIO()) {
        error = first_error(program.getInfoLog());
        return {};
    }
    glslang::SpvOptions options;
    options.disableOptimizer = true;
    std::vector<uint32_t> words;
    glslang::GlslangToSpv(*program.getIntermediate(stage), words, &options);
    return words;
}

std::vector<uint32_t> passed(const std::vector<uint32_t>& words, std::vector<spvtools::Optimizer::PassToken> passes) {
    spvtools::Optimizer optimizer(SPV_ENV_UNIVERSAL_1_6);
    for (auto& pass : passes) optimizer.RegisterPass(std::move(pass));
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    std::vector<uint32_t> out;
    return optimizer.Run(words.data(), words.size(), &out, options) ? out : words;
}

template <class... Tokens>
std::vector<spvtools::Optimizer::PassToken> passes(Tokens&&... tokens) {
    std::vector<spvtools::Optimizer::PassToken> out;
    (out.push_back(std::forward<Tokens>(tokens)), ...);
    return out;
}

}  // namespace

bool spirv_is_built_in() { return true; }

namespace {

SpirvModule compile_both_ways(const ShaderFiles& files, const std::string& entry,
                              const std::vector<std::string>& include, const std::string& preamble) {
    using namespace spvtools;
    SpirvModule module;
    std::vector<uint32_t> words = compile(files, entry, include, preamble, glslang::EShClientVulkan, module.error);
    if (!module.error.empty()) {
        std::string ignored;
        words = compile(files, entry, include, preamble, glslang::EShClientOpenGL, ignored);
        if (!ignored.empty()) return module;
        module.error.clear();
    }
    module.stripped = passed(words, passes(CreateStripDebugInfoPass(), CreateCompactIdsPass()));
    // Nothing here rewrites arithmetic: two modules that agree afterwards compute the same bits.
    module.reduced =
        passed(module.stripped,
               passes(CreateEliminateDeadFunctionsPass(), CreateLocalAccessChainConvertPass(),
                      CreateLocalSingleBlockLoadStoreElimPass(), CreateLocalSingleStoreElimPass(),
                      CreateSSARewritePass(), CreateAggressiveDCEPass(true), CreateDeadBranchElimPass(),
                      CreateAggressiveDCEPass(true), CreateEliminateDeadConstantPass(), CreateCompactIdsPass()));
    return module;
}

}  // namespace

SpirvModule compile_to_spirv(const ShaderFiles& files, const std::string& entry,
                             const std::vector<std::string>& include, const std::string& preamble) {
    static const GlslangProcess process;
    const CompileLimit limit(entry);
    try {
        return compile_both_ways(files, entry, include, preamble);
    } catch (const std::bad_alloc&) {
        throw CannotDo("--spirv: " + terminal_text(entry) +
                       " takes more than 2 GiB of memory to compile; check without --spirv, or look what it does");
    }
}

}  // namespace porttool
