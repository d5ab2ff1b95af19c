// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "porttool/scan/scan.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

using Along = UseGraph::Along;
constexpr size_t kUnmarked = std::numeric_limits<size_t>::max();

/// The prints of the files that are asked for, as they are in this project.
class TextPrints {
public:
    explicit TextPrints(const Project& project) {
        for (const ScannedFile& file : project.source) files_.emplace(file.path, &file);
        for (const ScannedFile& file : project.target) files_.emplace(target_path(project.map, file.path), &file);
    }
    bool has(const std::string& path, const std::string& print) const {
        const auto [first, last] = files_.equal_range(path);
        return std::any_of(first, last, [&](const auto& one) {
            Fingerprinter now;
            now.add(one.second->lexed.text);
            return now.digits() == print;
        });
    }

private:
    std::multimap<std::string, const ScannedFile*> files_;
};

/// True for what says that two sides are out of step: a person who settled it knows that they are.
bool explains(const Finding& finding) {
    switch (finding.rule) {
        case Rule::SourceChanged:
        case Rule::PortDiffers:
        case Rule::TargetChanged:
        case Rule::Unported:
        case Rule::Orphaned:
        case Rule::DeadLink:
        case Rule::ConstantDiffers:
        case Rule::LayoutDiffers:
        case Rule::Unpaired:
        case Rule::Unrecorded:
            return finding.verdict || finding.level >= Level::Warning;
        default:
            return false;
    }
}

/// What ran without its own text among those named could be of any tree.
void require_own_texts(const EvidenceFile& evidence, const Project& project) {
    std::set<std::string> named;
    for (const auto& [file, print] : evidence.texts) named.insert(file);
    for (const SeenPair& pair : evidence.pairs)
        for (const Side side : kBothSides) {
            const std::string file = split_id(pair.id[side]).first;
            if (named.contains(side == Side::Source ? file : target_path(project.map, file))) continue;
            throw CannotDo(fmt::format(
                "--evidence {}: the pair {} ran, and its file {} is not among the \"texts\"\nRun it again here",
                terminal_text(evidence.path), terminal_line(pair.id[side]), terminal_line(file)));
        }
}

std::string share_text(const SeenKernel& kernel) {
    constexpr double kPercent = 100, kTenth = 0.1;
    if (kernel.share <= 0) return kernel.paths > 0 ? fmt::format("{} paths", kernel.paths) : "the paths";
    return (kernel.share >= kTenth ? fmt::format("{:.0f}", kPercent * kernel.share)
                                   : fmt::format("{:.2g}", kPercent * kernel.share)) +
           " % of the paths";
}

/// `31 % of the paths part in 'radiance' of shade, material 'glass', 3 bounces; SSIM 0.93`.
std::string kernel_text(const SeenKernel& kernel) {
    std::string out = share_text(kernel) + " part in " +
                      (kernel.field.empty() ? kernel.name : fmt::format("'{}' of {}", kernel.field, kernel.name));
    for (size_t i = 0; i < kernel.materials.size(); ++i) {
        const char* before = i > 0 ? ", " : kernel.materials.size() > 1 ? ", materials " : ", material ";
        out += fmt::format("{}'{}'", before, kernel.materials[i]);
    }
    if (kernel.segment == 1) out += ", no bounce";
    if (kernel.segment > 1) out += fmt::format(", {} bounce{}", kernel.segment - 1, kernel.segment == 2 ? "" : "s");
    if (kernel.ssim) out += fmt::format("; SSIM {:.4g}", *kernel.ssim);
    return out;
}

std::string pair_text(const SeenPair& pair, bool is_own) {
    const std::string what = pair.example.empty() ? "differs" : "differs " + pair.example;
    return is_own ? what : split_id(pair.id.source).second + ", which uses it, " + what;
}

}  // namespace

std::vector<std::string> other_texts(const std::vector<std::pair<std::string, std::string>>& texts,
                                     const Project& project) {
    const TextPrints now(project);
    std::vector<std::string> out;
    for (const auto& [file, print] : texts)
        if (!now.has(file, print)) out.push_back(file);
    return out;
}

std::vector<EvidenceFile> evidence_of(const std::vector<std::string>& paths, const Project& project, const Disk& disk) {
    std::vector<EvidenceFile> out;
    for (const std::string& path : paths) {
        out.push_back(read_evidence(path, disk));
        require_own_texts(out.back(), project);
        const std::vector<std::string> others = other_texts(out.back().texts, project);
        if (others.empty()) continue;
        constexpr size_t kMost = 8;
        std::string names;
        for (size_t i = 0; i < std::min(kMost, others.size()); ++i)
            names += (i > 0 ? ", " : "") + terminal_line(others[i]);
        if (others.size() > kMost) names += fmt::format(" and {} more", others.size() - kMost);
        throw CannotDo(fmt::format("--evidence {}: other texts ran than those of this tree: {}\nRun it again here",
                                   terminal_text(path), names));
    }
    return out;
}

EvidenceJoin::EvidenceJoin(const std::vector<EvidenceFile>& files, const States& states)
    : states_(states), graph_{UseGraph(states.source), UseGraph(states.target)} {
    for (const EvidenceFile& file : files) {
        for (const SeenPair& pair : file.pairs) {
            const SeenPair*& known = pairs_[{pair.id.source, pair.id.target}];
            if (known == nullptr || known->same) known = &pair;
        }
        const std::string folder = std::filesystem::path(file.path).parent_path().generic_string();
        for (const SeenKernel& kernel : file.kernels) kernels_.emplace_back(&kernel, folder);
    }
}

std::vector<const UnitState*> EvidenceJoin::units_of(const std::string& id, Side side) const {
    const auto found = states_[side].find(id);
    if (found == states_[side].end()) return {};
    std::vector<const UnitState*> out = {&found->second};
    if (found->second.kind == UnitKind::File)
        for (const UnitState* unit : graph_[side].units_of_file(found->second.file)) out.push_back(unit);
    return out;
}

/// A person left a difference as it is, and the two functions were seen to give the same.
bool EvidenceJoin::is_settled_for_nothing(const Finding& finding) const {
    if (!finding.verdict) return false;
    const auto seen = pairs_.find({finding.map_source, finding.map_target});
    return seen != pairs_.end() && seen->second->same;
}

std::vector<const UnitState*> EvidenceJoin::entry_units(const SeenKernel& kernel, Side side) const {
    std::vector<const UnitState*> out = units_of(kernel.entry[side], side);
    return out.empty() ? graph_[side].units_of_stem(kernel.name) : out;
}

RunEvidence EvidenceJoin::unexplained(const Judgement& judgement) const {
    BySide<std::map<const UnitState*, size_t>> explained;
    for (const Side side : kBothSides) {
        std::vector<UseGraph::Marked> starts;
        for (const Finding& finding : judgement.findings)
            if (const auto& place = side == Side::Source ? finding.source : finding.target;
                place && explains(finding) && !is_settled_for_nothing(finding))
                for (const UnitState* unit : units_of(place->id, side)) starts.push_back({unit, 0});
        explained[side] = graph_[side].reached(starts, Along::Users);
    }
    const auto is_explained = [&](const UnitState* unit, Side side) { return explained[side].contains(unit); };
    RunEvidence out;
    std::map<std::pair<std::string, std::string>, const JudgedPair*> judged;
    for (const JudgedPair& pair : judgement.pairs) {
        judged.emplace(std::pair(pair.id.source, pair.id.target), &pair);
        const auto seen = pairs_.find({pair.id.source, pair.id.target});
        if (seen == pairs_.end()) continue;
        if (seen->second->same)
            out.same.insert(seen->first);
        else if (!is_explained(pair.unit.source, Side::Source) && !is_explained(pair.unit.target, Side::Target))
            out.pairs.emplace(seen->first,
                              "the two sides give different results, and no finding on them or on what they use says "
                              "why");
    }
    for (const auto& [kernel, folder] : kernels_) {
        bool any = false;
        for (const Side side : kBothSides)
            for (const UnitState* unit : entry_units(*kernel, side)) any = any || is_explained(unit, side);
        if (any) continue;
        const std::string message =
            fmt::format("the pictures part in {}, and no finding on it or on what it uses says why", kernel->name);
        const std::pair key(kernel->entry.source, kernel->entry.target);
        if (judged.contains(key))
            out.pairs.emplace(key, message);
        else
            out.kernels.emplace(kernel->name, message);
    }
    return out;
}

EvidenceJoin::Marks EvidenceJoin::marks_of(const Judgement& judgement) const {
    Marks out;
    for (const Side side : kBothSides) {
        std::vector<UseGraph::Marked> pairs, kernels;
        for (size_t i = 0; i < judgement.pairs.size(); ++i) {
            const JudgedPair& pair = judgement.pairs[i];
            const auto seen = pairs_.find({pair.id.source, pair.id.target});
            if (seen != pairs_.end() && !seen->second->same && pair.unit[side] != nullptr)
                pairs.push_back({pair.unit[side], i});
        }
        for (size_t i = 0; i < kernels_.size(); ++i)
            for (const UnitState* unit : entry_units(*kernels_[i].first, side)) kernels.push_back({unit, i});
        out.pairs[side] = graph_[side].reached(pairs, Along::Uses);
        out.kernels[side] = graph_[side].reached(kernels, Along::Uses);
    }
    return out;
}

size_t EvidenceJoin::least_mark(const BySide<Marked>& marks, const Finding& finding) const {
    size_t least = kUnmarked;
    for (const Side side : kBothSides) {
        const std::optional<Place>& place = side == Side::Source ? finding.source : finding.target;
        if (!place) continue;
        for (const UnitState* unit : units_of(place->id, side))
            if (const auto found = marks[side].find(unit); found != marks[side].end())
                least = std::min(least, found->second);
    }
    return least;
}

/// Of what uses a unit that was edited, the first pair of the map tells.
const SeenPair* EvidenceJoin::pair_of(const Finding& finding, const Marks& marks, const Judgement& judgement) const {
    const auto own = pairs_.find({finding.map_source, finding.map_target});
    if (own != pairs_.end() && !own->second->same) return own->second;
    if (finding.rule == Rule::UnexplainedDifference) return nullptr;
    const size_t mark = least_mark(marks.pairs, finding);
    if (mark == kUnmarked) return nullptr;
    const BySide<std::string>& id = judgement.pairs[mark].id;
    return pairs_.at({id.source, id.target});
}

size_t EvidenceJoin::kernel_of(const Finding& finding, const Marks& marks) const {
    if (finding.rule != Rule::UnexplainedDifference) return least_mark(marks.kernels, finding);
    for (size_t i = 0; i < kernels_.size(); ++i) {
        const SeenKernel& kernel = *kernels_[i].first;
        const bool is_pair = !finding.map_target.empty();
        if (is_pair ? kernel.entry == BySide<std::string>{finding.map_source, finding.map_target}
                    : kernel.name == finding.map_source)
            return i;
    }
    return kUnmarked;
}

void EvidenceJoin::join(Judgement& judgement) const {
    const Marks marks = marks_of(judgement);
    for (Finding& finding : judgement.findings) {
        if (finding.rule != Rule::UnexplainedDifference && !explains(finding)) continue;
        const SeenPair* pair = pair_of(finding, marks, judgement);
        const size_t kernel = kernel_of(finding, marks);
        if (pair == nullptr && kernel == kUnmarked) continue;
        const auto evidence = std::make_shared<FindingEvidence>();
        finding.evidence = evidence;
        if (pair != nullptr) {
            evidence->example_json = pair->example_json;
            const bool is_own = pair->id == BySide<std::string>{finding.map_source, finding.map_target};
            finding.message += "; " + pair_text(*pair, is_own);
        }
        if (kernel == kUnmarked) continue;
        evidence->kernel = *kernels_[kernel].first;
        evidence->folder = kernels_[kernel].second;
        finding.message += "; " + kernel_text(*evidence->kernel);
    }
}

size_t EvidenceJoin::strangers(const Judgement& judgement) const {
    std::set<std::pair<std::string, std::string>> known;
    for (const JudgedPair& pair : judgement.pairs) known.emplace(pair.id.source, pair.id.target);
    return static_cast<size_t>(
        std::count_if(pairs_.begin(), pairs_.end(), [&](const auto& pair) { return !known.contains(pair.first); }));
}

}  // namespace porttool
