// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "experiments/base/catalogue.h"

namespace limen {

/// What the registries of scenes, techniques and metrics hold in this program. Made at the first call.
std::shared_ptr<const Catalogue> catalogueFromRegistries();

}  // namespace limen
