// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/load_module.h"

#include <dlfcn.h>

#include <filesystem>

#include "experiments/base/error.h"

namespace limen {

void* loadModule(const std::string& fileName, const char* entry, const std::string& purpose) {
  std::error_code code;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", code);
  const std::string module = (program.parent_path() / fileName).string();
  // Never closed: it contains exit handlers of the libraries behind it.
  void* handle = ::dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* address = handle ? ::dlsym(handle, entry) : nullptr;
  if (address) return address;
  const char* words = ::dlerror();
  throw Error("cannot " + purpose + ": " + std::string(words ? words : "no entry in " + module), {},
              "build Limen again; the module belongs beside the program");
}

}  // namespace limen
