// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/error.h"
#include "experiments/gl_executor.h"
#include "renderer/gl/devices.h"

namespace limen::experiments {

std::vector<SweepDevice> listDevices() {
  std::vector<SweepDevice> out;
  for (const gl::DeviceInfo& device : gl::listHeadlessDevices())
    out.push_back({device.renderer.empty() ? "" : device.line(), device.software});
  try {
    const std::vector<bool> assigned = gl::assignedHeadlessDevices();
    for (size_t i = 0; i < out.size(); ++i) out[i].assigned = assigned[i];
  } catch (const Error&) {
    for (SweepDevice& device : out)
      if (!device.software) device.assigned.reset();
  }
  return out;
}

}  // namespace limen::experiments
