// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/evidence_file.h"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "porttool/read/bounded_json.h"
#include "porttool/read/cannot_do.h"
#include "porttool/text/fingerprint.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

using nlohmann::ordered_json;

constexpr uint64_t kLargestEvidence = 32ull << 20;
constexpr int kDeepest = 16;
constexpr size_t kMostNames = 8;  // of materials and pictures that are told

const ordered_json& member(const ordered_json& object, const char* name) {
    static const ordered_json none;
    if (!object.is_object()) return none;
    const auto found = object.find(name);
    return found == object.end() ? none : *found;
}

std::string text_in(const ordered_json& object, const char* name) {
    const ordered_json& value = member(object, name);
    return value.is_string() ? value.get<std::string>() : std::string();
}

uint64_t count_in(const ordered_json& object, const char* name) {
    const ordered_json& value = member(object, name);
    return value.is_number_unsigned() ? value.get<uint64_t>() : 0;
}

bool is_absent(const ordered_json& object, const char* name) { return member(object, name).is_null(); }

/// A number between two others; none where there is no number or another one.
std::optional<double> number_in(const ordered_json& object, const char* name, double least, double most) {
    const ordered_json& value = member(object, name);
    if (!value.is_number()) return std::nullopt;
    const auto number = value.get<double>();
    return number >= least && number <= most ? std::optional(number) : std::nullopt;
}

bool is_pixel(const ordered_json& value) {
    return value.is_array() && value.size() == 2 && value[0].is_number_unsigned() && value[1].is_number_unsigned();
}

/// The field of a difference, or of the whole, that holds a number which cannot be; "" for none.
std::string odd_number(const ordered_json& difference, const ordered_json& whole) {
    for (const char* name : {"segment", "paths"})
        if (!is_absent(difference, name) && !member(difference, name).is_number_unsigned()) return name;
    if (!is_absent(difference, "share") && !number_in(difference, "share", 0, 1)) return "share";
    if (!is_absent(difference, "pixel") && !is_pixel(member(difference, "pixel"))) return "pixel";
    if (!is_absent(whole, "ssim") && !number_in(whole, "ssim", -1, 1)) return "ssim";
    return {};
}

std::vector<std::string> texts_in(const ordered_json& object, const char* name) {
    std::vector<std::string> out;
    for (const ordered_json& value : member(object, name))
        if (value.is_string() && out.size() < kMostNames) out.push_back(value.get<std::string>());
    return out;
}

/// A number as a person writes it: few digits where they say it all.
std::string short_number(const ordered_json& value) {
    if (value.is_string()) return value.get<std::string>();  // nan, inf
    if (!value.is_number_float()) return value.is_number() ? value.dump() : "?";
    const double number = value.get<double>();
    const auto single = static_cast<float>(number);
    std::array<char, 40> digits{};
    const bool is_single = static_cast<double>(single) == number;
    const auto end = is_single ? std::to_chars(digits.data(), digits.data() + digits.size(), single).ptr
                               : std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    return std::string(digits.data(), end);
}

/// `for x = 1, y = 2: 3, 4`. Of many inputs, those that are not 0 are told first to be needed.
std::string example_text(const ordered_json& example) {
    constexpr size_t kFew = 4, kMost = 8;
    const ordered_json& inputs = member(example, "inputs");
    std::string out;
    size_t told = 0, left = 0;
    for (const auto& [name, value] : inputs.items()) {
        const bool is_zero = value.is_number() && value.get<double>() == 0;
        if ((is_zero && inputs.size() > kFew) || told == kMost) {
            ++left;
            continue;
        }
        out += (told++ == 0 ? "for " : ", ") + name + " = " + short_number(value);
    }
    if (left > 0) out += (told == 0 ? "for " : " and ") + std::to_string(left) + (told == 0 ? " inputs of 0" : " more");
    const std::string output = text_in(example, "output");
    return out + ": " + (output.empty() ? "" : output + " is ") + short_number(member(example, "source")) + ", " +
           short_number(member(example, "target"));
}

SeenKernel kernel_of(const ordered_json& difference, const ordered_json& whole) {
    SeenKernel out;
    out.name = text_in(difference, "kernel");
    out.field = text_in(difference, "field");
    out.segment = count_in(difference, "segment");
    out.paths = count_in(difference, "paths");
    out.share = number_in(difference, "share", 0, 1).value_or(0);
    out.materials = texts_in(difference, "materials");
    const ordered_json& pixel = member(difference, "pixel");
    if (is_pixel(pixel)) out.pixel = {pixel[0].get<uint64_t>(), pixel[1].get<uint64_t>()};
    out.ssim = number_in(whole, "ssim", -1, 1);
    out.pictures = texts_in(whole, "pictures");
    for (const ordered_json& kernel : member(whole, "kernels"))
        if (text_in(kernel, "kernel") == out.name) out.entry = {text_in(kernel, "source"), text_in(kernel, "target")};
    return out;
}

/// One file while it is read; what is wrong with it is one line that names it.
class EvidenceReader {
public:
    explicit EvidenceReader(const std::string& path) { out_.path = path; }

    EvidenceFile read(const std::string& text) {
        const auto whole = bounded_json<ordered_json>(text, kDeepest);
        if (!whole.is_object()) fail("is no whole JSON object");
        const std::string kind = text_in(whole, "kind");
        if (kind != "difftest" && kind != "locate")
            fail("is no evidence; porttool difftest --evidence and pathtracer compare --locate --evidence write it");
        if (count_in(whole, "version") != 1) fail("is evidence of another version; this porttool reads version 1");
        read_texts(member(whole, "texts"));
        if (kind == "difftest")
            read_pairs(member(whole, "pairs"));
        else
            read_kernels(whole);
        return std::move(out_);
    }

    [[noreturn]] void fail(const std::string& why) const {
        throw CannotDo("--evidence " + terminal_text(out_.path) + ": " + why);
    }

private:
    void read_texts(const ordered_json& texts) {
        if (!texts.is_array()) fail("does not say which texts ran (\"texts\")");
        for (const ordered_json& one : texts) {
            std::string file = text_in(one, "file"), print = text_in(one, "fingerprint");
            if (file.empty() || !is_fingerprint(print)) fail("has a text without file or fingerprint");
            out_.texts.emplace_back(std::move(file), std::move(print));
        }
    }

    void read_pairs(const ordered_json& pairs) {
        if (!pairs.is_array()) fail("has no \"pairs\"");
        for (const ordered_json& one : pairs) {
            const std::string state = text_in(one, "state");
            if (state == "not_run") continue;
            SeenPair pair{{text_in(one, "source"), text_in(one, "target")}};
            if (!is_absent(one, "inputs") && !member(one, "inputs").is_number_unsigned())
                fail("has a pair with \"inputs\" that cannot be");
            if (pair.id.source.empty() || pair.id.target.empty() || (state != "same" && state != "differs"))
                fail("has a pair without source, target or state");
            pair.same = state == "same";
            if (const ordered_json& example = member(one, "counterexample"); example.is_object() && !pair.same) {
                pair.example = example_text(example);
                pair.example_json = example.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
            }
            out_.pairs.push_back(std::move(pair));
        }
        require_texts(out_.pairs.empty());
    }

    void read_kernels(const ordered_json& whole) {
        const ordered_json& differences = member(whole, "differences");
        const ordered_json& first = member(whole, "first");
        constexpr size_t kMost = 64;
        if (differences.is_array()) {
            for (const ordered_json& one : differences)
                if (out_.kernels.size() < kMost) add_kernel(one, whole);
        } else if (!whole.contains("first")) {
            fail("says neither \"differences\" nor \"first\"");
        }
        if (out_.kernels.empty() && !first.is_null()) add_kernel(first, whole);
        require_texts(false);
    }

    void add_kernel(const ordered_json& difference, const ordered_json& whole) {
        if (const std::string odd = odd_number(difference, whole); !odd.empty())
            fail("has a difference with a \"" + odd + "\" that cannot be");
        out_.kernels.push_back(kernel_of(difference, whole));
        if (out_.kernels.back().name.empty()) fail("has a difference without a kernel");
    }

    /// What ran without a text could be of any tree.
    void require_texts(bool nothing_ran) const {
        if (out_.texts.empty() && !nothing_ran) fail("names no text that ran");
    }

    EvidenceFile out_;
};

}  // namespace

EvidenceFile read_evidence(const std::string& path, const Disk& disk) {
    EvidenceReader reader(path);
    const FileText text = disk.read(path, kLargestEvidence);
    if (!text.error.empty()) reader.fail(text.error);
    return reader.read(text.bytes);
}

}  // namespace porttool
