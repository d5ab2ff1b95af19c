// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/device/exact_arithmetic.h"

#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "source_core/device/spirv_module.h"

namespace source_core {

namespace {

// Numbers of the extended set GLSL.std.450.
enum Built : uint32_t { SQRT = 31, FMIN = 37, FMAX = 40, FCLAMP = 43, CROSS = 68 };

// The function that stands for a built-in of each component; null: none does.
const char* function_by_component(uint32_t built) {
    switch (built) {
        case SQRT:
            return "exact_root(f1;";
        case FMIN:
            return "exact_smaller(f1;f1;";
        case FMAX:
            return "exact_larger(f1;f1;";
        case FCLAMP:
            return "exact_clamped(f1;f1;f1;";
        default:
            return nullptr;
    }
}

// Numbers of SPV_KHR_float_controls: a capability and the execution mode that it allows.
struct Control {
    uint32_t capability;
    uint32_t mode;
};
constexpr Control KEEP_DENORMALS{4464, 4459};
constexpr Control KEEP_ZEROS_AND_NAN{4466, 4461};
constexpr Control ROUND_TO_NEAREST{4467, 4462};
constexpr const char* FLOAT_CONTROLS = "SPV_KHR_float_controls";

// Copies a module, with calls in place of what a device may round as it likes.
class CallWriter {
public:
    explicit CallWriter(const std::vector<uint32_t>& words) : result_(words.begin(), words.begin() + HEADER_WORDS) {
        for_each_instruction(words, [this](const Instruction& instruction) { learn(instruction); });
        for_each_instruction(words, [this](const Instruction& instruction) { write(instruction); });
    }

    std::vector<uint32_t> take() { return std::move(result_); }

private:
    void learn(const Instruction& instruction) {
        if (instruction.op() == OP_NAME) {
            functions_[std::string(reinterpret_cast<const char*>(instruction.words + 2))] = instruction[1];
        } else if (instruction.op() == OP_TYPE_FLOAT) {
            components_[instruction[1]] = 1;
            float_type_ = instruction[1];
        } else if (instruction.op() == OP_TYPE_VECTOR && components_.contains(instruction[2])) {
            components_[instruction[1]] = instruction[3];
        } else if ((instruction.op() > OP_TYPE_LAST || instruction.op() == OP_EXT_INST) && instruction.length() > 2 &&
                   components_.contains(instruction[1])) {
            components_of_[instruction[2]] = components_[instruction[1]];
        }
    }

    void write(const Instruction& instruction) {
        const uint32_t* operands = instruction.words + 3;
        if (instruction.op() == OP_FDIV) {
            by_component(instruction, "exact_quotient(f1;f1;", {operands, operands + 2});
        } else if (instruction.op() == OP_DOT) {
            const std::string vector = "vf" + std::to_string(components_of_[operands[0]]) + ";";
            call(instruction[1], instruction[2], "exact_dot(" + vector + vector, {operands, operands + 2});
        } else if (instruction.op() != OP_EXT_INST || !write_built(instruction)) {
            result_.insert(result_.end(), instruction.words, instruction.words + instruction.length());
        }
    }

    bool write_built(const Instruction& instruction) {
        const std::vector<uint32_t> operands(instruction.words + 5, instruction.words + instruction.length());
        if (instruction[4] == CROSS) {
            call(instruction[1], instruction[2], "exact_cross(vf3;vf3;", operands);
            return true;
        }
        const char* function = function_by_component(instruction[4]);
        if (function != nullptr) {
            by_component(instruction, function, operands);
        }
        return function != nullptr;
    }

    void by_component(const Instruction& instruction, const std::string& function,
                      const std::vector<uint32_t>& operands) {
        const uint32_t count = components_[instruction[1]];
        if (count == 1) {
            call(instruction[1], instruction[2], function, operands);
            return;
        }
        std::vector<uint32_t> made = {instruction[1], instruction[2]};
        for (uint32_t i = 0; i < count; ++i) {
            std::vector<uint32_t> parts;
            for (const uint32_t operand : operands) {
                parts.push_back(new_id());
                append(OP_COMPOSITE_EXTRACT, {float_type_, parts.back(), operand, i});
            }
            made.push_back(new_id());
            call(float_type_, made.back(), function, parts);
        }
        append(OP_COMPOSITE_CONSTRUCT, made);
    }

    void call(uint32_t type, uint32_t id, const std::string& function, const std::vector<uint32_t>& arguments) {
        std::vector<uint32_t> words = {type, id, functions_.at(function)};
        words.insert(words.end(), arguments.begin(), arguments.end());
        append(OP_FUNCTION_CALL, words);
    }

    void append(uint32_t op, const std::vector<uint32_t>& operands) {
        result_.push_back(first_word(op, operands.size() + 1));
        result_.insert(result_.end(), operands.begin(), operands.end());
    }

    uint32_t new_id() { return result_[BOUND_WORD]++; }

    std::vector<uint32_t> result_;
    std::map<std::string, uint32_t> functions_;             // ids by glslang's names
    std::unordered_map<uint32_t, uint32_t> components_;     // of a type of floats
    std::unordered_map<uint32_t, uint32_t> components_of_;  // of a value
    uint32_t float_type_ = 0;
};

void append_extension(std::vector<uint32_t>& words, std::string_view name) {
    std::vector<uint32_t> text(name.size() / sizeof(uint32_t) + 1);
    std::memcpy(text.data(), name.data(), name.size());
    words.push_back(first_word(OP_EXTENSION, text.size() + 1));
    words.insert(words.end(), text.begin(), text.end());
}

}  // namespace

std::vector<uint32_t> call_exact_arithmetic(const std::vector<uint32_t>& words) { return CallWriter(words).take(); }

std::vector<uint32_t> ask_for_float_controls(const std::vector<uint32_t>& words, const ExactArithmetic& wanted) {
    std::vector<Control> controls;
    if (wanted.keeps_denormals) {
        controls.push_back(KEEP_DENORMALS);
    }
    if (wanted.keeps_zeros_and_nan) {
        controls.push_back(KEEP_ZEROS_AND_NAN);
    }
    if (wanted.rounds_to_nearest) {
        controls.push_back(ROUND_TO_NEAREST);
    }
    if (controls.empty()) {
        return words;
    }
    std::vector<uint32_t> result(words.begin(), words.begin() + HEADER_WORDS);
    uint32_t last = OP_CAPABILITY;
    for_each_instruction(words, [&](const Instruction& instruction) {
        if (last == OP_CAPABILITY && instruction.op() != OP_CAPABILITY) {
            for (const Control& control : controls) {
                result.insert(result.end(), {first_word(OP_CAPABILITY, 2), control.capability});
            }
            append_extension(result, FLOAT_CONTROLS);
        }
        result.insert(result.end(), instruction.words, instruction.words + instruction.length());
        if (instruction.op() == OP_ENTRY_POINT) {
            for (const Control& control : controls) {
                result.insert(result.end(), {first_word(OP_EXECUTION_MODE, 4), instruction[2], control.mode, 32u});
            }
        }
        last = instruction.op();
    });
    return result;
}

}  // namespace source_core
