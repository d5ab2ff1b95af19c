// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "application/locate/located.h"
#include "metrics/text/fingerprint.h"

namespace application {

namespace {

/// The entry functions of each kernel that ran in both cores, as portmap.toml has them.
Json kernel_entries(const Json& located) {
    Json entries = Json::array();
    for (uint32_t i = 0; i < render_system::PATH_KERNELS; ++i) {
        const std::string name = kernel_name(static_cast<render_system::PathKernel>(i));
        const auto is_of_kernel = [&](const Json& one) { return one["kernel"] == name; };
        const Json& differences = located["differences"];
        if (located["compared"][name] == 0 && std::none_of(differences.begin(), differences.end(), is_of_kernel))
            continue;
        entries.push_back({{"kernel", name},
                           {"source", fmt::format("source_core/kernels/{}.comp:main", name)},
                           {"target", fmt::format("target_core/kernels/{0}.cpp:target_core::kernels::{0}", name)}});
    }
    return entries;
}

}  // namespace

std::string text_fingerprint(const std::string& text) {
    metrics::Fingerprinter print;
    print.add(metrics::plain_text(text));
    return print.digits();
}

Json evidence_json(const Json& comparison, const Options& options, const std::vector<render_system::KernelText>& texts,
                   const std::vector<std::string>& pictures) {
    std::map<std::string, std::string> prints;
    for (const render_system::KernelText& text : texts) prints[text.file] = text_fingerprint(text.text);
    Json files = Json::array();
    for (const auto& [file, print] : prints) files.push_back({{"file", file}, {"fingerprint", print}});
    const Json& located = comparison["locate"];
    const uint32_t spp = *std::max_element(options.spp.begin(), options.spp.end());
    Json ssim = nullptr;
    for (const Json& result : comparison["results"])
        if (result["spp"] == spp) ssim = result["ssim"];
    return {{"version", 1},
            {"kind", "locate"},
            {"texts", files},
            {"scene", comparison["scene"]},
            {"size", comparison["size"]},
            {"seed", comparison["seed"]},
            {"spp", spp},
            {"max_path_length", options.max_path_length},
            {"russian_roulette", options.russian_roulette},
            {"next_event_estimation", options.next_event_estimation},
            {"mode", located["mode"]},
            {"tolerance", located["tolerance"]},
            {"ssim", ssim},
            {"pictures", pictures},
            {"explained_by_ties", located["explained_by_ties"]},
            {"kernels", kernel_entries(located)},
            {"differences", located["differences"]},
            {"first", located["first"]}};
}

}  // namespace application
