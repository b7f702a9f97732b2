// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/gl_devices.h"

#include "experiments/base/error.h"
#include "renderer/gl/devices.h"

namespace limen::experiments {
namespace {

void setAssigned(std::vector<SweepDevice>& devices) {
  try {
    const std::vector<bool> assigned = gl::assignedHeadlessDevices();
    for (size_t i = 0; i < devices.size(); ++i) devices[i].assigned = assigned[i];
  } catch (const Error&) {
    for (SweepDevice& device : devices)
      if (!device.software) device.assigned.reset();
  }
}

std::unique_ptr<gl::Context>& openContext() {
  static thread_local std::unique_ptr<gl::Context> kept;
  return kept;
}

}  // namespace

std::vector<SweepDevice> listDevices() {
  std::vector<SweepDevice> out;
  for (const gl::DeviceInfo& device : gl::listHeadlessDevices())
    out.push_back({device.renderer.empty() ? "" : device.line(), device.software});
  setAssigned(out);
  return out;
}

std::vector<SweepDevice> listUnopenedDevices() {
  std::vector<SweepDevice> out;
  for (const bool software : gl::softwareHeadlessDevices()) out.push_back({"", software});
  setAssigned(out);
  return out;
}

SweepDevice openDevice() {
  openContext() = gl::createHeadlessContext();
  const gl::DeviceInfo& device = openContext()->device();
  return {device.line(), device.software};
}

std::unique_ptr<gl::Context> takeContext() {
  return openContext() ? std::move(openContext()) : gl::createHeadlessContext();
}

}  // namespace limen::experiments
