// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/render_core.h"
#include "tests/render_system/core_contract_suite.h"
#include "tests/render_system/core_history_suite.h"

namespace render_system::testing {

struct TargetCore {
    static std::unique_ptr<CoreAPI> create() { return target_core::create_core(); }
    static constexpr int EDITS = 1000;
    static CoreOptions options() { return {}; }
};

struct ExactTargetCore {
    static std::unique_ptr<CoreAPI> create() { return target_core::create_core(); }
    static constexpr int EDITS = 1000;
    static CoreOptions options() {
        CoreOptions options;
        options.exact = true;
        return options;
    }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Target, CoreContractSuite, TargetCore);
INSTANTIATE_TYPED_TEST_SUITE_P(Target, CoreHistorySuite, TargetCore);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactTarget, CoreContractSuite, ExactTargetCore);
INSTANTIATE_TYPED_TEST_SUITE_P(ExactTarget, CoreHistorySuite, ExactTargetCore);

}  // namespace render_system::testing
