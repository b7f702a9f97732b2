// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "renderer/gl/pass_list.h"

namespace limen::perception {

/// Opens a pass if there is a list to record it; closed when the result is destroyed.
inline std::unique_ptr<gl::PassList::Scope> openPass(gl::PassList* passes, const char* name) {
  return std::unique_ptr<gl::PassList::Scope>(passes ? new gl::PassList::Scope(passes->open(name)) : nullptr);
}

}  // namespace limen::perception
