// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "experiments/executor.h"
#include "renderer/gl/context.h"

namespace limen::experiments {

/// What --device can choose, by index. Throws Error without EGL.
std::vector<SweepDevice> listDevices();

/// The same without their names, for which they would have to be opened.
std::vector<SweepDevice> listUnopenedDevices();

/// Makes a context on the device that --device names, which the next call of takeContext() gets. Throws
/// Error.
SweepDevice openDevice();

/// The context that openDevice() made in this thread, or a new one. Throws Error.
std::unique_ptr<gl::Context> takeContext();

}  // namespace limen::experiments
