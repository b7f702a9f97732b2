// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/gl/context.h"

namespace limen::gl {

/// Environment variable that chooses the device of createHeadlessContext(): its index, or a part of its
/// renderer's name in any case ("nvidia").
inline constexpr const char* kDeviceVariable = "LIMEN_EGL_DEVICE";

/// The devices that give an OpenGL 4.5 context without a window, in the order of their indices; one that
/// gives none has an empty renderer. Throws Error if there is no EGL.
std::vector<DeviceInfo> listHeadlessDevices();

/// For each of them whether EGL says that a CPU renders. None is started. Throws Error if there is no EGL.
std::vector<bool> softwareHeadlessDevices();

/// For each of them whether createHeadlessContext() takes it without being asked: in a job of Slurm only
/// GPUs that the job was given, elsewhere all. Throws Error if that cannot be told.
std::vector<bool> assignedHeadlessDevices();

}  // namespace limen::gl
