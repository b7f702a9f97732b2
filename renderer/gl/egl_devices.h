// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <epoxy/egl.h>

#include <vector>

#include "renderer/gl/assigned_devices.h"

namespace limen::gl {

/// Devices of EGL; none where it cannot enumerate them. Throws Error if there is no EGL.
std::vector<EGLDeviceEXT> eglDevices();

/// What EGL, the kernel and the driver say of them. No device is started.
std::vector<DeviceIdentity> identitiesOf(const std::vector<EGLDeviceEXT>& devices);

}  // namespace limen::gl
