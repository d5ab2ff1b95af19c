// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// A head is what stands before a `{`, and tells what the braces hold:
//
//   template <class T> [[nodiscard]] OPTIX_DEVICE float3 Glass::sample(const Ray& ray, T u[2]) const {
//
// First its tokens become items: template prefix and attributes are left out, and a group in brackets is one.
//
//   OPTIX_DEVICE   float3   Glass   ::   sample   (...)   const
//
// Then each question is put in turn: is it a scope (`namespace`, `extern "C"`)? A type, because a key like `struct`
// stands in it and no parameter list ends it (`struct Hit trace(Ray r) {` is a function)? A block of variables
// (`layout(set = 0) uniform Camera {`)? Else it is a function if a parameter list is found, here `Glass::sample`, and
// nothing that is known if none is.
#include "porttool/scan/head.h"

#include <algorithm>
#include <array>

#include "porttool/language/words.h"
#include "porttool/scan/function_head.h"

namespace porttool {
namespace {

class HeadReader {
public:
    HeadReader(const HeadContext& context, uint32_t first, uint32_t end) : items_(context, first, end) {
        head_.first = first;
    }

    Head read() {
        if (items_.size() == 0) return head_;
        if (!read_scope() && !read_type() && !read_block()) read_function_head(items_, head_);
        head_.kernel = head_.kind == HeadKind::Function && (head_.kernel || is_kernel());
        return head_;
    }

private:
    bool read_scope() {
        constexpr size_t kFarthest = 8;
        for (size_t i = 0; i < items_.size() && i < kFarthest; ++i) {
            if (items_.word(i) != "namespace") continue;
            head_.kind = HeadKind::Namespace;
            for (size_t k = i + 1; k < items_.size(); ++k) {
                const std::string_view text = items_.word(k);
                if (!items_.is_name(k) || text == "inline") continue;
                // a macro before the name, as in `namespace EXPORT detail`
                if (!head_.name.empty() && items_.word(k - 1) != "::") head_.name.clear();
                head_.name += (head_.name.empty() ? "" : "::") + std::string(text);
            }
            return true;
        }
        const size_t count = items_.size();
        if (count < 2 || items_.word(count - 2) != "extern" || !items_.is_string(count - 1)) return false;
        head_.kind = HeadKind::Linkage;
        return true;
    }

    bool read_type() {
        size_t key = 0;
        while (key < items_.size() && !word_is(items_.word(key), kOpensType))
            key = items_.word(key) == "<" ? items_.after_angles(key) : key + 1;  // a key in arguments announces nothing
        if (key >= items_.size()) return false;
        size_t tail_end = key + 1;
        while (tail_end < items_.size() && items_.word(tail_end) != ":") ++tail_end;
        if (returns_type(key, tail_end)) return false;
        head_.kind = items_.word(key) == "enum" ? HeadKind::Enum : HeadKind::Struct;
        read_type_name(key + 1, tail_end);
        head_.first = items_.signature_start(key);
        return true;
    }

    /// `struct Foo f(int x) {` is a function: its parameter list is the last thing before the body.
    bool returns_type(size_t key, size_t tail_end) const {
        for (size_t i = key + 1; i < tail_end; ++i) {
            if (!items_.is_paren(i) || i == key + 1 || word_is(items_.word(i - 1), kTakesArguments)) continue;
            bool ends = true;
            for (size_t k = i + 1; k < tail_end && ends; ++k)
                ends = is_trailer(items_.word(k)) && items_.word(k) != "final";
            if (ends || items_.word(i + 1) == "->") return true;
        }
        return false;
    }

    void read_type_name(size_t first, size_t end) {
        for (size_t i = first; i < end;) {
            const std::string_view text = items_.word(i);
            if (text == "<") {  // arguments of a specialisation
                i = items_.after_angles(i);
                continue;
            }
            const bool has_arguments = i + 1 < end && items_.is_paren(i + 1);  // ALIGN(16)
            const bool no_name = text == "final" || text == "sealed" || text == "class" || text == "struct" ||
                                 word_is(text, kTakesArguments) || !items_.is_name(i);
            if (!no_name && !has_arguments) {
                const bool qualified = i > first && items_.word(i - 1) == "::" && !head_.name.empty();
                head_.name = qualified ? head_.name + "::" + std::string(text) : std::string(text);
                head_.name_at = items_.position(i);
            }
            ++i;
        }
    }

    /// GLSL and HLSL interface blocks: `layout(set = 0) buffer Rays {`, `uniform Camera {`.
    bool read_block() {
        const InterfaceBlocks blocks = traits_of(items_.context().language).blocks;
        if (blocks == InterfaceBlocks::None) return false;
        bool storage = false, layout = false;
        for (size_t i = 0; i < items_.size(); ++i) {
            if (items_.is_paren(i) && i > 0 && items_.word(i - 1) == "layout")
                layout = true;
            else if (items_.is_paren(i))
                return false;
            else if (word_is(items_.word(i), kBlockStorage))
                storage = true;
        }
        const size_t last = items_.size() - 1;
        if (!storage || !items_.is_name(last) || word_is(items_.word(last), kBlockStorage)) return false;
        if (blocks == InterfaceBlocks::AfterLayout && !layout) return false;
        head_.kind = HeadKind::Block;
        head_.name = items_.word(last);
        head_.name_at = items_.position(last);
        head_.first = items_.signature_start(last);
        return true;
    }

    bool is_kernel() const {
        if (items_.kernel_attribute()) return true;
        const Language language = items_.context().language;
        if (const std::string_view entry = traits_of(language).entry_point; !entry.empty()) return head_.name == entry;
        for (size_t i = 0; i < items_.size() && items_.position(i) < head_.name_at; ++i)
            if ((roles_of(items_.word(i), language) & kKernel) != 0) return true;
        constexpr std::array<std::string_view, 6> kOptix = {"__raygen__", "__closesthit__",   "__anyhit__",
                                                            "__miss__",   "__intersection__", "__direct_callable__"};
        return std::any_of(kOptix.begin(), kOptix.end(), [&](auto prefix) { return head_.name.starts_with(prefix); });
    }

    const HeadItems items_;
    Head head_;
};

}  // namespace

Head read_head(const HeadContext& context, uint32_t first, uint32_t end) {
    // No head that a person wrote is longer; the limit keeps the searches within one linear over the file.
    constexpr uint32_t kLongestHead = 1024;
    if (end - first > kLongestHead) first = end - kLongestHead;
    return HeadReader(context, first, end).read();
}

}  // namespace porttool
