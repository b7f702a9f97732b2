// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/egl_devices.h"

#include <dlfcn.h>

#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "experiments/base/error.h"

namespace limen::gl {
namespace {

// EGL_EXT_device_drm, EGL_EXT_device_drm_render_node, EGL_NV_device_cuda, EGL_EXT_device_persistent_id.
constexpr EGLint kDrmDeviceFile = 0x3233, kDrmRenderNodeFile = 0x3377, kCudaDevice = 0x323A,
                 kDeviceUuid = 0x335C;

/// libepoxy ends the process where it finds no library.
void requireEgl() {
  static void* const library = ::dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr)
    throw Error("libEGL.so.1 cannot be loaded", {},
                "install a GPU driver with EGL, or the packages libegl1 and libgl1-mesa-dri for a software "
                "renderer");
}

std::string nameIn(EGLDeviceEXT device, EGLint name) {
  const char* const text = eglQueryDeviceStringEXT(device, name);
  return text ? text : "";
}

/// "0000:65:00.0" of "/dev/dri/card1" or "/dev/dri/renderD129".
std::string pciAddressOf(const std::string& deviceFile) {
  std::error_code none;
  const std::string name = std::filesystem::path(deviceFile).filename().string();
  return std::filesystem::canonical("/sys/class/drm/" + name + "/device", none).filename().string();
}

std::optional<int> renderNodeNumber(const std::string& file) {
  const std::string start = "/dev/dri/renderD";
  int number = 0;
  if (file.rfind(start, 0) != 0 ||
      std::from_chars(file.data() + start.size(), file.data() + file.size(), number).ec != std::errc{})
    return {};
  return number - 128;
}

std::string uuidText(const std::array<unsigned char, 16>& bytes) {
  static constexpr const char* kDigits = "0123456789abcdef";
  std::string out = "GPU-";
  for (size_t i = 0; i < bytes.size(); ++i) {
    if (i == 4 || i == 6 || i == 8 || i == 10) out += '-';
    out += kDigits[bytes[i] >> 4];
    out += kDigits[bytes[i] & 15];
  }
  return out;
}

DeviceIdentity identityOf(EGLDeviceEXT device) {
  DeviceIdentity out;
  const std::string extensions = " " + nameIn(device, EGL_EXTENSIONS) + " ";
  const auto has = [&](const std::string& name) {
    return extensions.find(" " + name + " ") != std::string::npos;
  };
  out.software = has("EGL_MESA_device_software");
  if (out.software) return out;
  const std::string node =
      has("EGL_EXT_device_drm_render_node") ? nameIn(device, kDrmRenderNodeFile) : std::string();
  const std::string file = has("EGL_EXT_device_drm") ? nameIn(device, kDrmDeviceFile) : std::string();
  out.pciAddress = pciAddressOf(file.empty() ? node : file);
  const auto queryBinary = reinterpret_cast<EGLBoolean (*)(EGLDeviceEXT, EGLint, EGLint, void*, EGLint*)>(
      eglGetProcAddress("eglQueryDeviceBinaryEXT"));
  std::array<unsigned char, 16> uuid{};
  EGLint size = 0;
  if (has("EGL_EXT_device_persistent_id") && queryBinary &&
      queryBinary(device, kDeviceUuid, static_cast<EGLint>(uuid.size()), uuid.data(), &size) &&
      size == static_cast<EGLint>(uuid.size()))
    out.uuid = uuidText(uuid);
  EGLAttrib cuda = 0;
  if (has("EGL_NV_device_cuda") && eglQueryDeviceAttribEXT(device, kCudaDevice, &cuda))
    out.number = static_cast<int>(cuda);
  else
    out.number = renderNodeNumber(node);
  return out;
}

}  // namespace

// EGL_EXT_device_base is the older extension that EGL_EXT_device_enumeration and EGL_EXT_device_query were
// split from; NVIDIA's driver names it alone.
std::vector<EGLDeviceEXT> eglDevices() {
  requireEgl();
  std::vector<EGLDeviceEXT> devices(32);
  EGLint count = 0;
  if ((epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") ||
       epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) &&
      (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") ||
       epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base")))
    eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
  devices.resize(static_cast<size_t>(count));
  return devices;
}

std::vector<DeviceIdentity> identitiesOf(const std::vector<EGLDeviceEXT>& devices) {
  std::vector<DeviceIdentity> out(devices.size());
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_query") &&
      !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base"))
    return out;
  for (size_t i = 0; i < devices.size(); ++i) out[i] = identityOf(devices[i]);
  completeIdentities(out);
  return out;
}

}  // namespace limen::gl
