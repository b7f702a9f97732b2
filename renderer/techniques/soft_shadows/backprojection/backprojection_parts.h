// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/backprojection/backprojection_settings.h"
#include "renderer/techniques/soft_shadows/search_technique.h"

namespace limen::techniques {

/// What soft_shadows/backprojection is composed of.
SearchParts backprojectionParts(const BackprojectionSettings& settings);

}  // namespace limen::techniques
