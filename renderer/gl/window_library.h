// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limen::gl {

/// Starts GLFW, which may be done again and again. Throws Error if there is no window system.
void startWindowLibrary();

}  // namespace limen::gl
