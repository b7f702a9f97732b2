// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limen::gl {

/// Initialises GLFW; may be called repeatedly. Throws Error if there is no window system.
void startWindowLibrary();

}  // namespace limen::gl
