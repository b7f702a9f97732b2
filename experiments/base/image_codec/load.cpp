// SPDX-License-Identifier: BSD-3-Clause
#include <dlfcn.h>

#include <filesystem>

#include "experiments/base/error.h"
#include "experiments/base/image_codec/functions.h"

namespace limen::codec {
namespace {

const Functions* load() {
  std::error_code code;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", code);
  const std::string module = (program.parent_path() / LIMEN_IMAGE_CODEC).string();
  // Never closed: it contains exit handlers of the libraries behind it.
  void* handle = ::dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* entry = handle ? ::dlsym(handle, kEntry) : nullptr;
  if (!entry) {
    const char* words = ::dlerror();
    throw Error("cannot read or write image files: " + std::string(words ? words : "no entry in " + module),
                {}, "build Limen again; the module belongs beside the program");
  }
  return reinterpret_cast<Entry>(entry)();
}

}  // namespace

const Functions& functions() {
  static const Functions* const kLoaded = load();
  return *kLoaded;
}

}  // namespace limen::codec
