// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/history/in_turn.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <vector>

namespace porttool::testing::in_turn_test {
namespace {

TEST(InTurn, KeepsTheOrderAndHandsOnWhatIsThrown) {
    std::vector<int> done;
    std::vector<std::future<int>> results;
    InTurn<int> worker;
    for (int i = 0; i < 300; ++i)
        results.push_back(worker.add([i, &done]() -> int {
            done.push_back(i);
            if (i == 7) throw std::runtime_error("seven");
            return i * i;
        }));
    for (int i = 0; i < 300; ++i) {
        if (i == 7)
            EXPECT_THROW(results[7].get(), std::runtime_error);
        else
            EXPECT_EQ(results[static_cast<size_t>(i)].get(), i * i);
    }
    for (int i = 0; i < 300; ++i) EXPECT_EQ(done[static_cast<size_t>(i)], i);
}

TEST(InTurn, ADoneTaskHoldsNothingThoughItsResultIsNotYetAskedFor) {
    const auto held = std::make_shared<int>(1);
    InTurn<int> worker;
    std::future<int> first = worker.add([held] { return *held; });
    worker.add([] { return 0; }).get();
    EXPECT_EQ(held.use_count(), 1);
    EXPECT_EQ(first.get(), 1);
}

TEST(InTurn, WhatHasNotBegunIsForgotten) {
    std::promise<void> go;
    std::future<int> left;
    std::thread later([&go] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        go.set_value();
    });
    {
        InTurn<int> worker;
        worker.add([wait = go.get_future().share()] {
            wait.wait();
            return 0;
        });
        left = worker.add([] { return 1; });
    }
    later.join();
    EXPECT_THROW(left.get(), std::future_error);
}

}  // namespace
}  // namespace porttool::testing::in_turn_test
