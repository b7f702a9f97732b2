// SPDX-License-Identifier: BSD-3-Clause
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cstdlib>
#include <mutex>
#include <optional>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "renderer/gl/context.h"

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

  void makeCurrent() final { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_); }

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

/// libepoxy ends the process where it finds no library.
void requireEgl() {
  static void* const library = ::dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr)
    throw Error("libEGL.so.1 cannot be loaded", {},
                "install a GPU driver with EGL, or the packages libegl1 and libgl1-mesa-dri for a software "
                "renderer");
}

std::optional<int> forcedDevice() {
  const char* text = std::getenv("LIMEN_EGL_DEVICE");
  if (!text || !*text) return {};
  char* end = nullptr;
  const long index = std::strtol(text, &end, 10);
  if (*end != '\0' || index < 0)
    throw Error("LIMEN_EGL_DEVICE is '" + std::string(text) + "'", {},
                "give the index of an EGL device, from 0");
  return static_cast<int>(index);
}

}  // namespace

const std::vector<std::string>& headlessCandidates() { return candidateLines(); }

std::unique_ptr<Context> createHeadlessContext() {
  // Several threads may create contexts at the same time; the report is about the latest one.
  static std::mutex guard;
  const std::scoped_lock lock(guard);
  candidateLines().clear();
  const std::optional<int> forced = forcedDevice();
  requireEgl();
  std::unique_ptr<Context> best;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") ||
      epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) {
    std::array<EGLDeviceEXT, 32> devices{};
    EGLint count = 0;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration"))
      eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
    for (int i = 0; i < count; ++i) {
      if (forced && *forced != i) continue;
      auto context = tryDisplay(
          eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<size_t>(i)], nullptr),
          "EGL device " + std::to_string(i));
      if (context && (!best || (best->device().software && !context->device().software)))
        best = std::move(context);
      if (best && !best->device().software) break;
    }
    if (forced && !best)
      throw Error("EGL device " + std::to_string(*forced) + " gives no OpenGL 4.5 context",
                  "LIMEN_EGL_DEVICE", "there are " + std::to_string(count) + " devices, counted from 0");
  }
  if (!best && epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    best = tryDisplay(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
                      "EGL surfaceless");
  if (!best)
    throw Error(
        "no OpenGL 4.5 core context without a window: " + join(candidateLines(), "; "), {},
        "install a GPU driver with EGL, or the packages libegl1 and libgl1-mesa-dri for a software renderer");
  best->makeCurrent();
  return best;
}

}  // namespace limen::gl
