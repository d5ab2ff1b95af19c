// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/sync/edit_reading.h"

namespace porttool {

/// Leaves uses of a name that the source comes to say otherwise throughout, where the port has them in statements of
/// its own:
///
///     int at = axis < 0 ? n + axis : axis ;        the same, and besides:
///     if ( at == 0 ) ...                           if ( axis != 0 ) return other ( ) ;
void leave_old_uses(const EditReading& reading, Transplant& out);

}  // namespace porttool
