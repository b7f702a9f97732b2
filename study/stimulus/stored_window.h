// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "experiments/store/sessions.h"

namespace limen::study {

/// Size of the window in which a stored protocol shows its stimuli. `store` is named in errors.
glm::ivec2 windowOf(const store::StudyProtocol& protocol, const std::string& store);

}  // namespace limen::study
