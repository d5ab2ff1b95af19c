// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/device/spirv_passes.h"

#include <cstddef>
#include <unordered_map>
#include <unordered_set>

#include "source_core/device/spirv_module.h"

namespace source_core {

namespace {

// Where decorations may be inserted: right before the first type.
size_t end_of_annotations(const std::vector<uint32_t>& words) {
    size_t end = 0;
    for_each_instruction(words, [&end](const Instruction& instruction) {
        if (end == 0 && instruction.op() >= OP_TYPE_FIRST && instruction.op() <= OP_TYPE_LAST) {
            end = instruction.at;
        }
    });
    return end;
}

std::vector<uint32_t> insert(const std::vector<uint32_t>& words, const std::vector<uint32_t>& decorations) {
    const auto middle = words.begin() + static_cast<std::ptrdiff_t>(end_of_annotations(words));
    std::vector<uint32_t> result(words.begin(), middle);
    result.insert(result.end(), decorations.begin(), decorations.end());
    result.insert(result.end(), middle, words.end());
    return result;
}

bool is_float_arithmetic(uint32_t op) {
    switch (op) {
        case OP_FNEGATE:
        case OP_FADD:
        case OP_FSUB:
        case OP_FMUL:
        case OP_FDIV:
        case OP_FREM:
        case OP_FMOD:
            return true;
        default:
            return op >= OP_VECTOR_TIMES_SCALAR && op <= OP_DOT;
    }
}

// What becomes of the storage buffers of a module.
class BufferAccess {
public:
    void look_at(const Instruction& instruction) {
        switch (instruction.op()) {
            case OP_TYPE_POINTER:
                pointee_[instruction[1]] = instruction[3];
                break;
            case OP_VARIABLE:
                if (instruction[3] == STORAGE_CLASS_STORAGE_BUFFER) {
                    blocks_[instruction[2]] = pointee_[instruction[1]];
                    buffer_of_[instruction[2]] = instruction[2];
                }
                break;
            case OP_ACCESS_CHAIN:
            case OP_IN_BOUNDS_ACCESS_CHAIN:
                follow(instruction[2], instruction[3]);
                break;
            case OP_LOAD:
            case OP_ATOMIC_LOAD:
                note(read_, instruction[3]);
                break;
            case OP_STORE:
            case OP_ATOMIC_STORE:
                note(written_, instruction[1]);
                break;
            default:
                if (instruction.op() >= OP_ATOMIC_EXCHANGE && instruction.op() <= OP_ATOMIC_XOR) {
                    note(read_, instruction[3]);
                    note(written_, instruction[3]);
                }
        }
    }

    std::vector<uint32_t> decorations() const {
        std::vector<uint32_t> result;
        for (const auto& [buffer, block] : blocks_) {
            const bool read = read_.contains(buffer);
            const bool written = written_.contains(buffer);
            if (read != written) {
                result.insert(result.end(), {(4u << 16) | OP_MEMBER_DECORATE, block, 0u,
                                             read ? DECORATION_NON_WRITABLE : DECORATION_NON_READABLE});
            }
        }
        return result;
    }

private:
    void follow(uint32_t result, uint32_t base) {
        const auto found = buffer_of_.find(base);
        if (found != buffer_of_.end()) {
            buffer_of_[result] = found->second;
        }
    }

    void note(std::unordered_set<uint32_t>& set, uint32_t pointer) {
        const auto found = buffer_of_.find(pointer);
        if (found != buffer_of_.end()) {
            set.insert(found->second);
        }
    }

    std::unordered_map<uint32_t, uint32_t> pointee_;
    std::unordered_map<uint32_t, uint32_t> blocks_;     // struct type of a buffer variable
    std::unordered_map<uint32_t, uint32_t> buffer_of_;  // of a pointer into a buffer
    std::unordered_set<uint32_t> read_;
    std::unordered_set<uint32_t> written_;
};

}  // namespace

void for_each_instruction(const std::vector<uint32_t>& words, const std::function<void(const Instruction&)>& visit) {
    size_t at = HEADER_WORDS;
    while (at < words.size()) {
        const Instruction instruction{&words[at], at};
        if (instruction.length() == 0 || at + instruction.length() > words.size()) {
            return;
        }
        visit(instruction);
        at += instruction.length();
    }
}

std::vector<uint32_t> forbid_contraction(const std::vector<uint32_t>& words) {
    std::unordered_set<uint32_t> float_types;
    std::unordered_set<uint32_t> decorated;
    std::vector<uint32_t> results;
    for_each_instruction(words, [&](const Instruction& instruction) {
        const uint32_t op = instruction.op();
        const bool composite = op == OP_TYPE_VECTOR || op == OP_TYPE_MATRIX;
        if (op == OP_DECORATE && instruction[2] == DECORATION_NO_CONTRACTION) {
            decorated.insert(instruction[1]);
        } else if (op == OP_TYPE_FLOAT || (composite && float_types.contains(instruction[2]))) {
            float_types.insert(instruction[1]);
        } else if (is_float_arithmetic(op) || (op == OP_EXT_INST && float_types.contains(instruction[1]))) {
            results.push_back(instruction[2]);
        }
    });
    std::vector<uint32_t> decorations;
    for (const uint32_t id : results) {
        if (!decorated.contains(id)) {
            decorations.insert(decorations.end(), {(3u << 16) | OP_DECORATE, id, DECORATION_NO_CONTRACTION});
        }
    }
    return insert(words, decorations);
}

std::vector<uint32_t> mark_buffer_access(const std::vector<uint32_t>& words) {
    BufferAccess access;
    for_each_instruction(words, [&access](const Instruction& instruction) { access.look_at(instruction); });
    return insert(words, access.decorations());
}

}  // namespace source_core
