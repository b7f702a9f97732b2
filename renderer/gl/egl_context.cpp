// SPDX-License-Identifier: BSD-3-Clause
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <mutex>
#include <optional>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "renderer/gl/devices.h"
#include "renderer/gl/egl_devices.h"
#include "renderer/gl/fills.h"

namespace limen::gl {
namespace {

std::vector<std::string>& candidateLines() {
  static std::vector<std::string> lines;
  return lines;
}

class EglContext : public Context {
 public:
  /// Throws Error naming the missing capability.
  EglContext(EGLDisplay display, const std::string& platform) : display_(display) {
    try {
      create(platform);
    } catch (...) {
      destroy();
      throw;
    }
  }
  ~EglContext() override {
    EglContext::deleteObjects();
    destroy();
  }

  void makeCurrent() final {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
    Fills::madeCurrent(*this);
  }

 private:
  void create(const std::string& platform) {
    if (!eglInitialize(display_, nullptr, nullptr))
      throw Error("EGL display cannot be initialised", platform);
    if (!epoxy_has_egl_extension(display_, "EGL_KHR_surfaceless_context"))
      throw Error("EGL_KHR_surfaceless_context is missing", platform);
    if (!eglBindAPI(EGL_OPENGL_API)) throw Error("EGL offers no desktop OpenGL", platform);
    const std::array<EGLint, 5> configWish = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE,
                                              EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display_, configWish.data(), &config, 1, &count) || count == 0)
      throw Error("EGL has no configuration for OpenGL", platform);
    const std::array<EGLint, 9> contextWish = {EGL_CONTEXT_MAJOR_VERSION,
                                               4,
                                               EGL_CONTEXT_MINOR_VERSION,
                                               5,
                                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                               EGL_CONTEXT_OPENGL_DEBUG,
                                               EGL_TRUE,
                                               EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, contextWish.data());
    if (context_ == EGL_NO_CONTEXT) throw Error("no OpenGL 4.5 core context", platform);
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      throw Error("cannot make the context current without a surface", platform);
    initialize(platform);
  }

  void destroy() {
    if (context_ != EGL_NO_CONTEXT) {
      eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      eglDestroyContext(display_, context_);
      context_ = EGL_NO_CONTEXT;
    }
    // The display is shared by all contexts on one device, so it stays initialised.
  }

  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

std::unique_ptr<Context> tryDisplay(EGLDisplay display, const std::string& platform) {
  if (display == EGL_NO_DISPLAY) {
    candidateLines().push_back(platform + ": no display");
    return nullptr;
  }
  try {
    auto context = std::make_unique<EglContext>(display, platform);
    candidateLines().push_back(platform + ": " + context->device().line());
    return context;
  } catch (const Error& error) {
    candidateLines().push_back(std::string(error.what()));
    return nullptr;
  }
}

/// Where a device is named.
constexpr const char* kWhere = "--device or LIMEN_EGL_DEVICE";

std::unique_ptr<Context> tryDevice(const std::vector<EGLDeviceEXT>& devices, size_t index) {
  return tryDisplay(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[index], nullptr),
                    "EGL device " + std::to_string(index));
}

/// Which of them Slurm lets this process use.
std::vector<bool> allowedDevices(const std::vector<EGLDeviceEXT>& devices) {
  const std::optional<Assignment> assignment =
      readAssignment([](const char* name) -> const char* { return std::getenv(name); });
  if (!assignment) return std::vector<bool>(devices.size(), true);
  return assignedDevices(identitiesOf(devices), *assignment);
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// What LIMEN_EGL_DEVICE asks for: an index or a name.
struct Wish {
  std::string text;
  std::optional<size_t> index;

  bool allows(size_t device) const { return !index || *index == device; }
  bool allows(const DeviceInfo& device) const {
    return text.empty() || index || lower(device.renderer).find(lower(text)) != std::string::npos;
  }
};

Wish readWish() {
  const char* text = std::getenv(kDeviceVariable);
  Wish wish{text ? text : "", {}};
  size_t index = 0;
  const char* const end = wish.text.data() + wish.text.size();
  const auto read = std::from_chars(wish.text.data(), end, index);
  if (read.ec == std::errc{} && read.ptr == end) wish.index = index;
  return wish;
}

}  // namespace

const std::vector<std::string>& headlessCandidates() { return candidateLines(); }

std::vector<DeviceInfo> listHeadlessDevices() {
  const std::vector<EGLDeviceEXT> devices = eglDevices();
  std::vector<DeviceInfo> out;
  for (size_t i = 0; i < devices.size(); ++i) {
    const std::unique_ptr<Context> context = tryDevice(devices, i);
    out.push_back(context ? context->device() : DeviceInfo{});
  }
  return out;
}

std::vector<bool> softwareHeadlessDevices() {
  std::vector<bool> out;
  for (const DeviceIdentity& device : identitiesOf(eglDevices())) out.push_back(device.software);
  return out;
}

std::vector<bool> assignedHeadlessDevices() { return allowedDevices(eglDevices()); }

std::unique_ptr<Context> createHeadlessContext() {
  // Several threads may create contexts at the same time; the report is about the latest one.
  static std::mutex guard;
  const std::scoped_lock lock(guard);
  candidateLines().clear();
  const Wish wish = readWish();
  const std::vector<EGLDeviceEXT> devices = eglDevices();
  // Whoever gives an index means that device.
  const std::vector<bool> allowed =
      wish.index ? std::vector<bool>(devices.size(), true) : allowedDevices(devices);
  std::unique_ptr<Context> best;
  for (size_t i = 0; i < devices.size(); ++i) {
    if (!wish.allows(i) || !allowed[i]) continue;
    auto context = tryDevice(devices, i);
    if (context && wish.allows(context->device()) &&
        (!best || (best->device().software && !context->device().software)))
      best = std::move(context);
    if (best && !best->device().software) break;
  }
  if (!best && wish.index)
    throw Error("EGL device " + wish.text + " gives no OpenGL 4.5 context", kWhere,
                "there are " + std::to_string(devices.size()) + " devices, counted from 0");
  if (!best && epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    best = tryDisplay(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
                      "EGL surfaceless");
    if (best && !wish.allows(best->device())) best.reset();
  }
  if (!best && !wish.text.empty())
    throw Error("no device with OpenGL 4.5 has '" + wish.text + "' in its name", kWhere,
                "there are: " + join(candidateLines(), "; "));
  if (!best)
    throw Error(
        "no OpenGL 4.5 core context without a window: " + join(candidateLines(), "; "), {},
        "install a GPU driver with EGL, or the packages libegl1 and libgl1-mesa-dri for a software renderer");
  best->makeCurrent();
  return best;
}

}  // namespace limen::gl
