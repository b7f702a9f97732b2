// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "renderer/gl/program.h"

namespace limen::gl {

/// What a context runs on.
struct DeviceInfo {
  std::string vendor, renderer, version;  ///< GL_VENDOR, GL_RENDERER, GL_VERSION
  std::string platform;                   ///< "EGL device 1", "EGL surfaceless", "GLFW window"
  bool software = false;                  ///< a CPU renders: llvmpipe, softpipe, SwiftShader
  /// Renderer and version on one line: what timings depend on.
  std::string line() const { return renderer + " (OpenGL " + version + ")"; }
};

/// A message of the driver (KHR_debug) of medium or high severity.
struct DebugMessage {
  std::string text;
  bool performance = false;  ///< performance advice, not an error
};

/// An OpenGL 4.5 core context, current on the thread that made it. Clip space is set to upper-left origin and
/// depth 0..1, so row 0 of every image is its top.
class Context {
 public:
  virtual ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  virtual void makeCurrent() = 0;

  const DeviceInfo& device() const { return device_; }
  ProgramCache& programs() { return programs_; }
  /// Messages since the last call.
  std::vector<DebugMessage> takeDebugMessages();
  /// Throws std::runtime_error with the driver's message if it reported an error since the last call.
  void checkDebugMessages();

 protected:
  Context() = default;
  /// Called by subclasses once the context is current: reads the device, checks the version, sets debug
  /// output. Throws Error naming what is missing.
  void initialize(const std::string& platform);
  /// Called first by a subclass's destructor: deletes the context's objects while it still exists.
  void deleteObjects();

 private:
  DeviceInfo device_;
  ProgramCache programs_;
  std::vector<DebugMessage> messages_;
};

/// Off-screen context through EGL: device platform first, then surfaceless. A real GPU is preferred to a
/// software renderer. The environment variable LIMEN_EGL_DEVICE (an index) forces one. Throws Error.
std::unique_ptr<Context> createHeadlessContext();

/// What createHeadlessContext() tried, one line each: "EGL device 0: llvmpipe ... (taken)".
const std::vector<std::string>& headlessCandidates();

}  // namespace limen::gl
