// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/bitmask/bitmask_settings.h"
#include "renderer/techniques/soft_shadows/search_technique.h"

namespace limen::techniques {

/// What soft_shadows/bitmask is composed of.
SearchParts bitmaskParts(const BitmaskSettings& settings);

}  // namespace limen::techniques
