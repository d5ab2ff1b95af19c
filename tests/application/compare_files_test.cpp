// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
//
// `compare` on image files: figures against closed forms, and files that cannot be compared.
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "application/bias/batches.h"
#include "application/command_line.h"
#include "application/command_table.h"
#include "application/comparison/picture_file.h"

namespace compare_files_test {
namespace {

using namespace application;
using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

struct Answer {
    int exit_code = -1;
    std::string out, err;
    json parsed() const { return json::parse(out); }
};

class CompareFiles : public testing::Test {
protected:
    void SetUp() override {
        folder = std::filesystem::temp_directory_path() / ("compare_files_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string file(const std::string& name) const { return (folder / name).string(); }

    /// Writes `values`, interleaved, in the format that the name asks for.
    std::string write(const std::string& name, int width, int height, int channels, const std::vector<float>& values) {
        OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::FLOAT);
        auto output = OIIO::ImageOutput::create(file(name));
        EXPECT_TRUE(output && output->open(file(name), spec) && output->write_image(spec.format, values.data()) &&
                    output->close());
        return file(name);
    }
    std::string grey(const std::string& name, int width, int height, int channels, float value) {
        return write(name, width, height, channels,
                     std::vector<float>(static_cast<size_t>(width * height * channels), value));
    }
    Answer compare(std::vector<std::string> words) {
        words.insert(words.begin(), {"compare", "--format", "json"});
        const Invocation invocation = parse_command_line(words);
        if (invocation.command == nullptr) return {invocation.exit_code, "", invocation.text};
        Console console(invocation.options, false, false);
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        const int code = invocation.command->run(invocation.options, console);
        const std::string out = testing::internal::GetCapturedStdout();
        return {code, out, testing::internal::GetCapturedStderr()};
    }
    void expect_refused(const std::vector<std::string>& words, const std::string& reason) {
        const Answer answer = compare(words);
        EXPECT_EQ(answer.exit_code, 2) << reason;
        EXPECT_THAT(answer.out, IsEmpty());
        EXPECT_THAT(answer.err, HasSubstr(reason));
    }
    /// Names of `count` noisy pictures of that mean, 32x16.
    std::vector<std::string> noisy(const std::string& stem, int count, float mean, unsigned seed) {
        std::mt19937 random(seed);
        std::vector<std::string> names;
        for (int n = 0; n < count; ++n) {
            std::vector<float> values(32 * 16 * 3);
            for (float& value : values) value = mean * (0.9f + 0.2f * static_cast<float>(random() % 1001) / 1000.0f);
            names.push_back(write(stem + std::to_string(n) + ".exr", 32, 16, 3, values));
        }
        return names;
    }
    Answer compare_sets(const std::vector<std::string>& a, const std::vector<std::string>& b,
                        const std::vector<std::string>& more = {}) {
        std::vector<std::string> words = {"--bias"};
        words.insert(words.end(), more.begin(), more.end());
        words.insert(words.end(), a.begin(), a.end());
        words.emplace_back("--");
        words.insert(words.end(), b.begin(), b.end());
        return compare(words);
    }

    std::filesystem::path folder;
};

TEST_F(CompareFiles, CountsAndPlacesWhatIsNoNumberAndLeavesItOut) {
    std::vector<float> a(20 * 12 * 3, 0.25f), b(a);
    for (size_t i = 0; i < b.size(); i += 3) b[i] += 0.5f;  // red, everywhere
    b[(3 * 20 + 7) * 3 + 1] = std::numeric_limits<float>::quiet_NaN();
    a[(5 * 20 + 2) * 3] = std::numeric_limits<float>::infinity();
    a[(9 * 20 + 19) * 3 + 2] = -std::numeric_limits<float>::infinity();
    const std::string name_a = write("a.exr", 20, 12, 3, a), name_b = write("b.exr", 20, 12, 3, b);
    const Answer answer = compare({name_a, name_b, "-o", file("out")});
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    EXPECT_THAT(answer.err, HasSubstr("1 pixel is NaN, the first at 7,3"));
    EXPECT_THAT(answer.err, HasSubstr("a.exr: 2 pixels are infinite, the first at 2,5"));
    const json found = answer.parsed();
    EXPECT_EQ(found["infinite_pixels_a"], 2);
    EXPECT_EQ(found["infinite_places_a"], json::parse("[[2,5],[19,9]]"));
    EXPECT_EQ(found["infinite_pixels_b"], 0);
    EXPECT_EQ(found["a"], name_a);
    EXPECT_EQ(found["b"], name_b);
    EXPECT_EQ(found["size"], json::array({20, 12}));
    EXPECT_EQ(found["nan_pixels_a"], 0);
    EXPECT_EQ(found["nan_pixels_b"], 1);
    EXPECT_EQ(found["nan_places_b"], json::parse("[[7,3]]"));
    const json& row = found["results"][0];
    EXPECT_TRUE(row["spp"].is_null());
    EXPECT_NEAR(row["rmse_linear"], 0.5 / std::sqrt(3.0), 1e-7);
    EXPECT_EQ(row["pixels_off"], 1.0);
    EXPECT_EQ(row["identical_pixels"], 0.0);
    const auto shown = read_picture_file(file("out/difference.png"));
    ASSERT_TRUE(shown.ok());
    std::set<size_t> magenta;
    for (size_t pixel = 0; pixel < 20 * 12; ++pixel) {
        const uint8_t* rgb = &shown->forms.levels.rgb[pixel * 3];
        if (rgb[0] == 255 && rgb[1] == 0 && rgb[2] == 255) magenta.insert(pixel);
    }
    EXPECT_EQ(magenta, (std::set<size_t>{3 * 20 + 7, 5 * 20 + 2, 9 * 20 + 19}));
}

TEST_F(CompareFiles, ReadsOneChannelAndOtherFormats) {
    const std::string one = grey("one.exr", 16, 12, 1, 0.25f), two = grey("two.exr", 16, 12, 1, 0.5f);
    EXPECT_NEAR(compare({one, two}).parsed()["results"][0]["rmse_linear"], 0.25, 1e-7);
    const std::string hdr = grey("a.hdr", 16, 12, 3, 0.5f), exr = grey("a.exr", 16, 12, 3, 0.5f);
    EXPECT_EQ(compare({hdr, exr}).parsed()["results"][0]["identical_pixels"], 1.0) << "0.5 is exact in both";
    // 188 is the sRGB level of 0.5, so the PNG's levels agree with it.
    const std::string png = grey("a.png", 16, 12, 3, 188.0f / 255.0f);
    const json row = compare({png, exr}).parsed()["results"][0];
    EXPECT_EQ(row["rmse"], 0.0);
    EXPECT_LT(row["rmse_linear"].get<double>(), 0.005);
}

TEST_F(CompareFiles, RefusesWhatCannotBeCompared) {
    const std::string rgb = grey("rgb.exr", 16, 12, 3, 0.5f), one = grey("one.exr", 16, 12, 1, 0.5f);
    const std::string wide = grey("wide.png", 17, 12, 3, 0.5f);
    expect_refused({rgb, one}, "one.exr has 1");
    expect_refused({rgb, wide}, "wide.png is 17x12");
    expect_refused({rgb, file("none.exr")}, "none.exr");
    expect_refused({rgb, CMAKE_LISTS}, "convert it");
    expect_refused({rgb, rgb, rgb}, "not 3 files");
    expect_refused({rgb, rgb, "--size", "4x4"}, "--size: is for rendering a scene");
    expect_refused({"--bias", rgb, "--", rgb, "-o", "out"}, "-o: stands behind --");
    expect_refused({rgb, "--", rgb}, "are for --bias");
    expect_refused({"s.gltf", "--bias", "--frames", "0:3"}, "unknown option '--frames'");
    expect_refused({rgb, rgb, "--bias"}, "--bias A... -- B...");
    expect_refused({rgb, rgb, "--alpha", "0.1"}, "is for --bias");
    expect_refused({rgb, "--alpha", "0", "--bias"}, "0.001");
    expect_refused({"s.gltf", "--bias", "--locate"}, "ask one at a time");
    expect_refused({"s.gltf", "--seed-target", "1", "--locate"}, "leave --seed-target out");
    expect_refused({"s.gltf", "--bias", "--spp", "1,4"}, "one count");
    expect_refused({grey("s.exr", 8, 8, 3, 0), grey("t.exr", 8, 8, 3, 0), "--limit-ssim", "0.9"}, "below 11 pixels");
    const auto set = noisy("n", 2, 0.5f, 1);
    EXPECT_EQ(compare_sets({set[0], set[1], set[0]}, set).exit_code, 2);
    EXPECT_THAT(compare_sets({set[0], set[1], set[0]}, set).err, HasSubstr("seeds of their own"));
}

TEST_F(CompareFiles, TellsABiasOfSetsOfFilesFromTheirNoise) {
    const auto a = noisy("a", 16, 0.5f, 1), b = noisy("b", 20, 0.5f, 2), c = noisy("c", 16, 0.505f, 3);
    const Answer equal = compare_sets(a, b);
    ASSERT_EQ(equal.exit_code, 0) << equal.err;
    EXPECT_EQ(equal.parsed()["bias"]["verdict"], "agree");
    EXPECT_EQ(equal.parsed()["b"].size(), 20u);

    const Answer biased = compare_sets(a, c, {"-o", file("out")});
    ASSERT_EQ(biased.exit_code, 1) << biased.err;
    const json bias = biased.parsed()["bias"];
    EXPECT_EQ(bias["verdict"], "differ");
    EXPECT_EQ(bias["tiles"], 8);
    // The spread of a uniform number in 0.9 to 1.1 is 0.2 / sqrt(12); there are 512 x 3 x 16 of them on each side.
    const double error = 0.5 * 0.2 / std::sqrt(12.0) * std::sqrt(2.0 / (512 * 3 * 16));
    EXPECT_NEAR(bias["standard_error"], error, 0.4 * error);
    EXPECT_NEAR(bias["mean_difference"], 0.005, 5 * error);
    EXPECT_LT(bias["p_value"], 1e-6);
    const auto map = read_picture_file(file("out/bias.png"));
    ASSERT_TRUE(map.ok());
    EXPECT_EQ(std::set<uint8_t>(map->forms.levels.rgb.begin(), map->forms.levels.rgb.end()).count(255), 1u);
    EXPECT_GT(map->forms.levels.rgb[0], 0) << "red: b is brighter";
    EXPECT_EQ(map->forms.levels.rgb[2], 0);

    const Answer few = compare_sets({a[0], a[1], a[2]}, {b[0], b[1], b[2]});
    EXPECT_EQ(few.exit_code, 0);
    EXPECT_EQ(few.parsed()["bias"]["verdict"], "too_few");
    EXPECT_EQ(few.parsed()["bias"]["samples_needed"], 16);
    const json single = compare_sets({a[0]}, {b[0]}).parsed()["bias"];
    EXPECT_EQ(single["samples_needed"], 16);
    EXPECT_TRUE(single["standard_error"].is_null()) << "one picture has no spread";
}

TEST_F(CompareFiles, SetsLeaveOutWhatIsNoNumberAndPlaceIt) {
    auto a = noisy("a", 16, 0.5f, 1);
    const auto b = noisy("b", 16, 0.5f, 2);
    std::vector<float> odd(32 * 16 * 3, 0.5f);
    odd[0] = 0.51f;
    odd[(4 * 32 + 30) * 3] = std::numeric_limits<float>::infinity();
    odd[(11 * 32 + 6) * 3 + 2] = std::numeric_limits<float>::quiet_NaN();
    a[7] = write("odd.exr", 32, 16, 3, odd);
    const Answer answer = compare_sets(a, b, {"-o", file("out")});
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    EXPECT_THAT(answer.err, HasSubstr("odd.exr: 1 pixel is NaN, the first at 6,11"));
    EXPECT_THAT(answer.err, HasSubstr("odd.exr: 1 pixel is infinite, the first at 30,4"));
    const json found = answer.parsed();
    EXPECT_EQ(found["nan_places_a"], json::parse("[[6,11]]"));
    EXPECT_EQ(found["infinite_places_a"], json::parse("[[30,4]]"));
    EXPECT_EQ(found["bias"]["verdict"], "agree");
    const auto shown = read_picture_file(file("out/difference.png"));
    ASSERT_TRUE(shown.ok());
    for (const size_t pixel : {11 * 32 + 6, 4 * 32 + 30}) EXPECT_EQ(shown->forms.levels.rgb[pixel * 3], 255) << pixel;
}

TEST_F(CompareFiles, APixelThatOneSetLacksIsNoBias) {
    constexpr size_t kLamp = (4 * 32 + 20) * 3;
    const auto with_lamp = [&](const std::string& stem, unsigned seed, float lamp) {
        std::mt19937 random(seed);
        std::vector<std::string> names;
        for (int n = 0; n < 16; ++n) {
            std::vector<float> values(32 * 16 * 3);
            for (float& value : values) value = 0.45f + 0.1f * static_cast<float>(random() % 1001) / 1000.0f;
            for (size_t i = 0; i < 3; ++i) values[kLamp + i] = lamp;
            names.push_back(write(stem + std::to_string(n) + ".exr", 32, 16, 3, values));
        }
        return names;
    };
    const auto lit = with_lamp("lit", 1, 1000.0f);
    auto lost = with_lamp("nan", 2, std::numeric_limits<float>::quiet_NaN());
    lost[3] = with_lamp("inf", 3, std::numeric_limits<float>::infinity())[3];
    for (const auto& [a, b] : {std::pair(lit, lost), std::pair(lost, lit)}) {
        const Answer answer = compare_sets(a, b);
        ASSERT_EQ(answer.exit_code, 0) << answer.out;
        const json bias = answer.parsed()["bias"];
        EXPECT_EQ(bias["verdict"], "agree");
        EXPECT_NEAR(bias["mean"], 0.5, 0.001) << "the lamp is in neither";
        EXPECT_THAT(answer.err, HasSubstr("as NaN or infinite in one: 1 of the pixels"));
    }
}

TEST_F(CompareFiles, WhatIsComparedInNoFileIsSaid) {
    auto a = noisy("a", 16, 0.5f, 1);
    const auto b = noisy("b", 16, 0.5f, 2);
    std::vector<float> values(32 * 16 * 3, 0.5f);
    const auto spoil = [&](size_t rows) {
        std::fill_n(values.begin(), rows * 32 * 3, std::numeric_limits<float>::quiet_NaN());
        a[5] = write("broken.exr", 32, 16, 3, values);
        return compare_sets(a, b);
    };
    const Answer half = spoil(8);  // a row of four tiles
    EXPECT_EQ(half.exit_code, 0);
    EXPECT_THAT(half.err, HasSubstr("256 of the pixels; 4 of 8 tiles are compared in none"));
    const Answer all = spoil(16);
    EXPECT_EQ(all.exit_code, 2) << "nothing is no agreement";
    EXPECT_THAT(all.err, HasSubstr("no pixel is a number in all files"));
    EXPECT_THAT(all.out, IsEmpty());
}

TEST_F(CompareFiles, ReadsTwoChannelsThatAreNoGreyAndAlpha) {
    OIIO::ImageSpec spec(16, 12, 2, OIIO::TypeDesc::FLOAT);
    const auto motion = [&](const std::string& name, float second, std::vector<std::string> channels) {
        spec.channelnames = std::move(channels);
        std::vector<float> values(16 * 12 * 2, 0.5f);
        for (size_t i = 1; i < values.size(); i += 2) values[i] = second;
        auto output = OIIO::ImageOutput::create(file(name));
        EXPECT_TRUE(output && output->open(file(name), spec) && output->write_image(spec.format, values.data()) &&
                    output->close());
        return file(name);
    };
    const std::string a = motion("a.exr", 0.1f, {"R", "G"}), b = motion("b.exr", 0.4f, {"R", "G"});
    EXPECT_NEAR(compare({a, b}).parsed()["results"][0]["rmse_linear"], 0.3 / std::sqrt(3.0), 1e-7);
    const std::string c = motion("c.exr", 0.1f, {"Y", "A"}), d = motion("d.exr", 0.4f, {"Y", "A"});
    EXPECT_EQ(compare({c, d}).parsed()["results"][0]["rmse_linear"], 0.0) << "alpha is not compared";
}

TEST(BatchPlan, CutsSamplesIntoBatchesWithSeedsOfTheirOwn) {
    EXPECT_EQ(plan_batches(5).batches, 5u);
    EXPECT_EQ(plan_batches(16).batches, 16u);
    EXPECT_EQ(plan_batches(63).total(), 48u);
    EXPECT_EQ(plan_batches(64).batches, 32u);
    EXPECT_EQ(plan_batches(100).total(), 96u);
    for (const double wanted : {0.0, 1.0, 17.0, 63.5, 64.0, 65.0, 1e4}) {
        const auto samples = samples_of_plan(wanted);
        EXPECT_GE(static_cast<double>(samples), wanted);
        EXPECT_EQ(plan_batches(static_cast<uint32_t>(samples)).total(), samples) << "used to the last";
    }
    std::set<uint32_t> seeds;
    for (uint32_t seed = 0; seed < 10; ++seed)
        for (uint32_t core = 0; core < 2; ++core)
            for (uint32_t batch = 0; batch < 32; ++batch) seeds.insert(batch_seed(seed, core, batch));
    EXPECT_EQ(seeds.size(), 640u);
}

}  // namespace
}  // namespace compare_files_test
