// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

namespace porttool {

/// Goes through JSON, and stops where it is nested too deep or has too many values.
template <class Json>
class JsonBounds final : public nlohmann::json_sax<Json> {
public:
    explicit JsonBounds(int deepest) : deepest_(deepest) {}

    bool null() override { return step(); }
    bool boolean(bool) override { return step(); }
    bool number_integer(typename Json::number_integer_t) override { return step(); }
    bool number_unsigned(typename Json::number_unsigned_t) override { return step(); }
    bool number_float(typename Json::number_float_t, const std::string&) override { return step(); }
    bool string(std::string&) override { return step(); }
    bool binary(typename Json::binary_t&) override { return step(); }
    bool key(std::string&) override { return step(); }
    bool start_object(size_t) override { return ++depth_ <= deepest_ && step(); }
    bool start_array(size_t) override { return ++depth_ <= deepest_ && step(); }
    bool end_object() override { return --depth_, true; }
    bool end_array() override { return --depth_, true; }
    bool parse_error(size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

private:
    bool step() {
        constexpr size_t kMostValues = size_t{4} << 20;  // names of values among them
        return ++values_ <= kMostValues;
    }
    int deepest_, depth_ = 0;
    size_t values_ = 0;
};

/// JSON whose author may be anybody; discarded where it is none, is nested deeper than that, or has millions of values:
/// two bytes of text can stand for a hundred in memory. (A callback that refuses while the values are made takes time
/// in the square of the length of a list of objects.)
template <class Json>
Json bounded_json(const std::string& text, int deepest) {
    JsonBounds<Json> bounds(deepest);
    if (!Json::sax_parse(text, &bounds)) return Json(Json::value_t::discarded);
    return Json::parse(text, nullptr, false);
}

}  // namespace porttool
