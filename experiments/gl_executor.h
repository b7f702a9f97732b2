// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiments/executor.h"

namespace limen::experiments {

/// Renders runs in a headless OpenGL context. Pictures go to `resultsFolder`/artefacts, reference products to
/// `resultsFolder`/references. Throws Error if there is no OpenGL 4.5.
std::unique_ptr<Executor> makeGlExecutor(const std::string& resultsFolder);

/// "0  NVIDIA H200 (OpenGL ...)": what --device can choose, by index. Throws Error without EGL.
std::vector<std::string> listDevices();

}  // namespace limen::experiments
