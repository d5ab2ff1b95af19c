// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/render_core.h"
#include "tests/render_system/core_contract_suite.h"
#include "tests/render_system/core_history_suite.h"

namespace render_system::testing {

struct SourceCore {
    static std::unique_ptr<CoreAPI> create() { return source_core::create_core(); }
    static constexpr int EDITS = 180;  // each core compiles its kernels
    static CoreOptions options() { return {}; }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Source, CoreContractSuite, SourceCore);
INSTANTIATE_TYPED_TEST_SUITE_P(Source, CoreHistorySuite, SourceCore);

}  // namespace render_system::testing
