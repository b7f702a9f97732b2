// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "experiments/base/catalogue.h"

namespace limen {

/// The contents of this program's registries of scenes, techniques and metrics. Made at the first call.
std::shared_ptr<const Catalogue> catalogueFromRegistries();

}  // namespace limen
