// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/importer/obj_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "render_system/importer/glb_builder.h"
#include "render_system/importer/importer.h"

namespace importer {

namespace {

constexpr std::string_view kBlanks = " \t\r";

// tinyobjloader's time for one face grows by the square of its corners: a quarter of a second for so many.
constexpr size_t kMostCorners = 10000;

// What a material without a colour of its own looks like, as faces without a material do.
constexpr const char* kPlainDiffuse = "Kd 0.8 0.8 0.8";

// Takes the next word off a line; empty at its end and where a comment begins.
std::string_view next_word(std::string_view& line) {
    const size_t start = std::min(line.find_first_not_of(kBlanks), line.size());
    const size_t end = std::min(line.find_first_of(kBlanks, start), line.size());
    const std::string_view word = line.substr(start, end - start);
    line.remove_prefix(end);
    return word.starts_with('#') ? std::string_view() : word;
}

// Takes the next line, without its break, off a text.
std::string_view next_line(std::string_view& text) {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
}

// Whether the word is a number; one past the range of its type is, and is met later.
bool is_number(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::invalid_argument || end != word.data() + word.size()) return false;
    return error == std::errc::result_out_of_range || std::isfinite(value);
}

[[noreturn]] void refuse_line(size_t line, const std::string& what) {
    throw ImportError{"line " + std::to_string(line) + ": " + what};
}

std::string quoted(std::string_view word) { return "\"" + std::string(word.substr(0, 40)) + "\""; }

// A corner somewhere else would be another shape.
void check_position(std::string_view rest, size_t line) {
    size_t count = 0;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest), ++count) {
        if (is_number(word)) continue;
        refuse_line(line, "v has " + quoted(word) + " where a finite number should be; export the file again");
    }
    if (count >= 3) return;
    refuse_line(line, "v has " + std::to_string(count) + " of at least 3 numbers; export the file again");
}

bool has_numbers(std::string_view rest, size_t least) {
    size_t count = 0;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest), ++count) {
        if (!is_number(word)) return false;
    }
    return count >= least;
}

// "7", "7/8", "7//9" or "7/8/9"; an index may count backwards. An index of 0 is tinyobjloader's to refuse.
void check_corner(std::string_view keyword, std::string_view word, size_t line) {
    const std::string_view whole = word;
    for (int part = 0; part < 3; ++part) {
        const size_t end = std::min(word.find('/'), word.size());
        const std::string_view number = word.substr(0, end);
        int32_t index = 0;
        const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), index);
        if (error == std::errc::result_out_of_range) {
            refuse_line(line, std::string(keyword) + " names " + quoted(number) + ", past the " +
                                  std::to_string(std::numeric_limits<int32_t>::max()) +
                                  " that are the most; export the file again");
        }
        const bool is_left_out = number.empty() && part > 0;
        if (!is_left_out && (error != std::errc() || stop != number.data() + number.size())) break;
        if (end == word.size()) return;
        word.remove_prefix(end + 1);
    }
    refuse_line(line, std::string(keyword) + " has " + quoted(whole) +
                          " where a corner (v, v/vt, v//vn or v/vt/vn) should be; export the file again");
}

size_t check_corners(std::string_view keyword, std::string_view rest, size_t line) {
    size_t corners = 0;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest), ++corners) {
        check_corner(keyword, word, line);
    }
    if (corners > kMostCorners) {
        refuse_line(line, "a face of " + std::to_string(corners) + " corners; " + std::to_string(kMostCorners) +
                              " are the most, export the file as triangles");
    }
    return corners;
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// One line of an MTL file, made plain.
class MtlLine {
public:
    MtlLine(std::string_view line, std::string place, GlbBuilder& builder)
        : line_(line), rest_(line), keyword_(next_word(rest_)), place_(std::move(place)), builder_(builder) {}

    std::string plain() const {
        if (is_one_of(keyword_, {"Ka", "Kd", "Ks", "Ke", "Kt", "Tf"})) return color();
        if (is_one_of(keyword_, {"Ns", "Ni", "d", "Tr", "Pr", "Pm", "Ps", "Pc", "Pcr", "aniso", "anisor", "illum"}))
            return number();
        return std::string(line_);
    }

private:
    // A colour of one number is a grey.
    std::string color() const {
        std::string_view rest = rest_;
        const std::array<std::string_view, 3> words{next_word(rest), next_word(rest), next_word(rest)};
        if (is_one_of(words[0], {"spectral", "xyz"})) return without("colours of MTL given as spectra or by CIE XYZ");
        const bool is_grey = words[1].empty();
        const bool good = is_number(words[0]) && (is_grey || (is_number(words[1]) && is_number(words[2])));
        if (!good) return without_number();
        if (!is_grey) return std::string(line_);
        const std::string grey(words[0]);
        return std::string(keyword_) + " " + grey + " " + grey + " " + grey;
    }

    std::string number() const {
        std::string_view rest = rest_;
        std::string_view word = next_word(rest);
        const bool has_halo = keyword_ == "d" && word == "-halo";
        if (has_halo) {
            builder_.leave_out("halos of MTL (d -halo), which have the same coverage all over", place_);
            word = next_word(rest);
        }
        if (!is_number(word)) return without_number();
        return has_halo ? "d " + std::string(word) : std::string(line_);
    }

    std::string without_number() const { return without("values of MTL that are no numbers"); }

    std::string without(const char* what) const {
        builder_.leave_out(what, place_);
        return keyword_ == "Kd" ? kPlainDiffuse : "";
    }

    std::string_view line_, rest_, keyword_;
    std::string place_;
    GlbBuilder& builder_;
};

}  // namespace

std::string joined_lines(std::string_view text) {
    std::string joined;
    size_t owed = 0;  // line breaks
    for (size_t at = 0; at < text.size(); ++at) {
        const std::string_view ahead = text.substr(at, 3);
        const size_t taken = ahead.starts_with("\\\n") ? 2 : ahead == "\\\r\n" ? 3 : 0;
        if (taken > 0 && joined.empty()) {
            joined.reserve(text.size());
            joined.assign(text.substr(0, at));
        }
        if (taken > 0) {
            joined += ' ';
            at += taken - 1;
            ++owed;
        } else if (owed > 0 || !joined.empty()) {
            joined += text[at];
            if (text[at] == '\n') joined.append(std::exchange(owed, 0), '\n');
        }
    }
    return joined;
}

std::string closed_corners(std::string_view text) {
    std::string closed;
    for (std::string_view left = text; !left.empty();) {
        const auto start = static_cast<size_t>(left.data() - text.data());
        std::string_view line = next_line(left);
        const size_t length = line.size();
        if (!is_one_of(next_word(line), {"f", "l", "p"})) continue;
        bool at_end = true;  // behind this there is nothing of the corner
        for (size_t i = length; i-- > length - line.size();) {
            const char c = text[start + i];
            at_end = kBlanks.find(c) != std::string_view::npos || (at_end && c == '/');
            if (!at_end || c != '/') continue;
            if (closed.empty()) closed = text;
            closed[start + i] = ' ';
        }
    }
    return closed;
}

std::map<std::string, size_t> check_obj(std::string_view text, GlbBuilder& builder) {
    std::map<std::string, size_t> materials;
    for (size_t line = 1; !text.empty(); ++line) {
        std::string_view rest = next_line(text);
        const std::string_view keyword = next_word(rest);
        if (keyword == "v") {
            check_position(rest, line);
        } else if (keyword == "vn" || keyword == "vt") {
            if (!has_numbers(rest, keyword == "vn" ? 3 : 1))
                builder.leave_out("normals and texture coordinates that are no numbers",
                                  "line " + std::to_string(line));
        } else if (keyword == "f") {
            const size_t corners = check_corners(keyword, rest, line);
            if (corners < 3) builder.leave_out("faces of fewer than three corners", "line " + std::to_string(line));
        } else if (keyword == "l" || keyword == "p") {
            check_corners(keyword, rest, line);
        } else if (keyword == "usemtl") {
            materials.emplace(next_word(rest), line);
        }
    }
    return materials;
}

std::string plain_mtl(std::string_view text, const std::string& name, GlbBuilder& builder) {
    std::string plain;
    plain.reserve(text.size());
    for (size_t line = 1; !text.empty(); ++line) {
        plain += MtlLine(next_line(text), name + " line " + std::to_string(line), builder).plain();
        plain += '\n';
    }
    return plain;
}

}  // namespace importer
