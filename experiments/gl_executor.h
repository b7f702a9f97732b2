// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "experiments/executor.h"

namespace limen::experiments {

/// Renders runs in a headless OpenGL context. Pictures go to `resultsFolder`/artefacts, reference products to
/// `referencesFolder`. On the device that openDevice() has opened (gl_devices.h), if any. Throws Error if
/// there is no OpenGL 4.5.
std::unique_ptr<Executor> makeGlExecutor(const std::string& resultsFolder,
                                         const std::string& referencesFolder);

}  // namespace limen::experiments
