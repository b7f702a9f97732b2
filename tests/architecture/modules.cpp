// SPDX-License-Identifier: BSD-3-Clause
#include "tests/architecture/modules.h"

#include <algorithm>
#include <regex>

namespace limen::architecture {

const std::vector<Module>& modules() {
  static const std::vector<Module> kModules = {
      {"base", {}, false},
      {"renderer/gl", {"base"}, true},
      {"renderer/scene", {"base"}, false},
      {"renderer/frame", {"base", "renderer/gl", "renderer/scene"}, true},
      {"renderer/techniques",
       {"base", "renderer/gl", "renderer/scene", "renderer/frame", "perception"},
       true},
      {"renderer/references",
       {"base", "renderer/gl", "renderer/scene", "renderer/frame", "renderer/techniques"},
       true},
      // The viewer, and whatever else lies in no folder above.
      {"renderer",
       {"base", "renderer/gl", "renderer/scene", "renderer/frame", "renderer/techniques",
        "renderer/references", "perception"},
       true},
      {"perception", {"base", "renderer/gl"}, true},
      {"experiments/store", {"base"}, false},
      {"experiments",
       {"base", "experiments/store", "renderer/gl", "renderer/scene", "renderer/frame", "renderer/techniques",
        "renderer/references", "perception"},
       true},
      {"analysis", {"base", "experiments/store"}, false},
      {"study",
       {"base", "experiments/store", "renderer/gl", "renderer/scene", "renderer/frame", "renderer/techniques",
        "renderer/references", "renderer", "perception"},
       true},
  };
  return kModules;
}

const Module* moduleOf(const std::string& path) {
  const Module* best = nullptr;
  for (const Module& module : modules()) {
    const bool inside = path == module.folder || path.rfind(module.folder + "/", 0) == 0;
    if (inside && (!best || module.folder.size() > best->folder.size())) best = &module;
  }
  return best;
}

bool mayUse(const Module& user, const Module& used) {
  return user.folder == used.folder ||
         std::find(user.mayUse.begin(), user.mayUse.end(), used.folder) != user.mayUse.end();
}

bool namesGl(const std::string& name) {
  static const std::regex kGl("epoxy|glfw|opengl|(^|[^a-z])(lib|-l)?(egl|gl|glx|gles[0-9v]*)([^a-z]|$)",
                              std::regex::icase | std::regex::optimize);
  return std::regex_search(name, kGl);
}

}  // namespace limen::architecture
