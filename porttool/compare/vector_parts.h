// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// How a text names the parts of vectors, and what it makes vectors of.
#pragma once

#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "porttool/language/language.h"
#include "porttool/normal/normal_text.h"

namespace porttool {

/// The names that a text declares as vectors of which each part has more than one name: `vec3 v`. In C++ and CUDA that
/// may be anything, but for `glm :: vec3 v`.
using VectorNames = std::unordered_set<std::string_view>;
void note_vectors(const Words& text, Language language, VectorNames& names);

/// Writes the components of colours and texture coordinates of these as those of positions: `v . rg` is `v . xy`.
void write_plain_components(Words& statement, const VectorNames& names);

/// Writes the vectors of one language's texts in one of the ways that this language has for them. What is a vector is
/// known: it is declared as one, made by a constructor, or given by a built-in that gives nothing else. A field of a
/// struct keeps its name, and so does what any class of that name may have.
///
///     OpenCL    ( float4 ) ( 0f , 0f , 0f , 0f )        float4 ( 0 )
///               v . s3        v . s012                  v . w        v . xyz
///     GLSL      imageLoad ( a , p ) . rgb               imageLoad ( a , p ) . xyz
///               v [ 1 ]                                 v . y
///     SYCL      v . w ( )                               v [ 3 ]
class VectorSpelling {
public:
    explicit VectorSpelling(Language language) : language_(language) {}

    /// The texts whose statements are to be written; they must outlive it.
    void note(const Words& text);

    void write_plain(std::vector<std::string>& statement) const;

private:
    std::string plain_part(const std::string& part) const;
    bool is_hlsl() const { return language_ == Language::Hlsl || language_ == Language::Slang; }
    bool brings_vectors() const;
    bool gives_vector(const std::vector<std::string>& words, size_t open) const;
    bool is_vector_before(const std::vector<std::string>& words, size_t end) const;
    void write_parts(std::vector<std::string>& words) const;
    void write_methods(std::vector<std::string>& words) const;
    void write_constructors(std::vector<std::string>& words) const;

    Language language_;
    VectorNames names_;        ///< declared as vectors and as nothing else
    VectorNames class_names_;  ///< the same as SYCL's own vectors
    VectorNames others_;       ///< declared as something else
    bool may_change_ = false;  ///< something is volatile: read twice, it may be two values
};

}  // namespace porttool
