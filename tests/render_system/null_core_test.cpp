// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/null_core.h"

#include "tests/render_system/core_contract_suite.h"
#include "tests/render_system/core_history_suite.h"

namespace render_system::testing {

struct NullCore {
    static std::unique_ptr<CoreAPI> create() { return create_null_core(); }
    static constexpr int EDITS = 1000;
    static CoreOptions options() { return {}; }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Null, CoreContractSuite, NullCore);
INSTANTIATE_TYPED_TEST_SUITE_P(Null, CoreHistorySuite, NullCore);

}  // namespace render_system::testing
