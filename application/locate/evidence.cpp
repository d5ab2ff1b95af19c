// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>

#include "application/locate/located.h"

namespace application {

namespace {

/// SipHash-2-4 (Aumasson and Bernstein 2012) over whole words.
class WordHash {
public:
    void word(uint64_t value) {
        d_ ^= value;
        round();
        round();
        a_ ^= value;
    }

    uint64_t finish() {
        word(0);
        c_ ^= 0xFF;
        for (int i = 0; i < 4; ++i) round();
        return a_ ^ b_ ^ c_ ^ d_;
    }

private:
    static constexpr uint64_t kKey[] = {0x706f7274746f6f6cull, 0x6e6f726d616c2032ull};  // "porttool", "normal 2"

    void round() {
        a_ += b_;
        c_ += d_;
        b_ = std::rotl(b_, 13) ^ a_;
        d_ = std::rotl(d_, 16) ^ c_;
        a_ = std::rotl(a_, 32);
        c_ += b_;
        a_ += d_;
        b_ = std::rotl(b_, 17) ^ c_;
        d_ = std::rotl(d_, 21) ^ a_;
        c_ = std::rotl(c_, 32);
    }

    uint64_t a_ = kKey[0] ^ 0x736f6d6570736575ull, b_ = kKey[1] ^ 0x646f72616e646f6dull,
             c_ = kKey[0] ^ 0x6c7967656e657261ull, d_ = kKey[1] ^ 0x7465646279746573ull;
};

/// Up to eight bytes as a number, the first the lowest.
uint64_t little_endian(std::string_view bytes) {
    uint64_t number = 0;
    for (size_t i = 0; i < bytes.size(); ++i) number |= uint64_t{static_cast<uint8_t>(bytes[i])} << (8 * i);
    return number;
}

/// As porttool reads it: without byte order mark and carriage returns, lines that end in a backslash joined to the
/// next.
std::string plain_text(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    std::string plain;
    for (size_t i = 0; i < text.size(); ++i) {
        const std::string_view rest = text.substr(i);
        if (rest.starts_with("\\\r\n") || rest.starts_with("\\\n"))
            i += rest[1] == '\r' ? 2 : 1;
        else if (!rest.starts_with("\r\n"))
            plain.push_back(rest[0] == '\r' ? '\n' : rest[0]);
    }
    return plain;
}

/// The entry functions of each kernel in both cores, as portmap.toml has them.
Json kernel_entries() {
    Json entries = Json::array();
    for (uint32_t i = 0; i < render_system::PATH_KERNELS; ++i) {
        const std::string name = kernel_name(static_cast<render_system::PathKernel>(i));
        entries.push_back({{"kernel", name},
                           {"source", fmt::format("source_core/kernels/{}.comp:main", name)},
                           {"target", fmt::format("target_core/kernels/{0}.cpp:target_core::kernels::{0}", name)}});
    }
    return entries;
}

}  // namespace

std::string text_fingerprint(const std::string& text) {
    constexpr size_t WORD = 8, LONG = 0xFF;
    const std::string plain = plain_text(text);
    const std::string_view rest = plain;
    WordHash hash;
    if (rest.size() >= LONG) hash.word(rest.size());
    hash.word(little_endian(rest.substr(0, WORD - 1)) << 8 | std::min(rest.size(), LONG));
    for (size_t at = WORD - 1; at < rest.size(); at += WORD) hash.word(little_endian(rest.substr(at, WORD)));
    return fmt::format("{:016x}", hash.finish());
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
            {"kernels", kernel_entries()},
            {"differences", located["differences"]},
            {"first", located["first"]}};
}

}  // namespace application
