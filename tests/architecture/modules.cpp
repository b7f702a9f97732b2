// SPDX-License-Identifier: BSD-3-Clause
#include "tests/architecture/modules.h"

#include <algorithm>
#include <regex>

namespace limen::architecture {

const std::vector<Module>& modules() {
  static const std::vector<Module> kModules = {
      {"base", {}, false},
      {"psychometrics", {"base"}, false},
      {"renderer/gl", {"base"}, true},
      {"renderer/scene", {"base"}, false},
      {"renderer/frame", {"base", "renderer/gl", "renderer/scene"}, true},
      {"renderer/techniques",
       {"base", "renderer/gl", "renderer/scene", "renderer/frame", "perception"},
       true},
      {"renderer/references",
       {"base", "renderer/gl", "renderer/scene", "renderer/frame", "renderer/techniques", "perception"},
       true},
      // Whatever lies in no folder above.
      {"renderer",
       {"base", "renderer/gl", "renderer/scene", "renderer/frame", "renderer/techniques",
        "renderer/references", "perception"},
       true},
      // The half of perception that runs anywhere.
      {"perception/vision", {"base"}, false},
      {"perception/multiscale", {"base", "perception/vision"}, false},
      {"perception/threshold_maps",
       {"base", "renderer/gl", "perception/vision", "perception/multiscale"},
       true},
      {"perception",
       {"base", "renderer/gl", "perception/vision", "perception/multiscale", "perception/threshold_maps"},
       true},
      {"experiments/store", {"base"}, false},
      {"experiments",
       {"base", "experiments/store", "renderer/gl", "renderer/scene", "renderer/frame", "renderer/techniques",
        "renderer/references", "perception"},
       true},
      {"analysis/statistics", {"base", "psychometrics"}, false},
      {"analysis/psychometric", {"base", "psychometrics", "analysis/statistics"}, false},
      {"analysis/output", {"base", "analysis/statistics"}, false},
      {"analysis/data", {"base", "analysis/output"}, false},
      {"analysis/fits",
       {"base", "psychometrics", "analysis/statistics", "analysis/psychometric", "analysis/output",
        "analysis/data"},
       false},
      {"analysis/groups", {"base", "analysis/statistics", "analysis/output", "analysis/data"}, false},
      {"analysis/relations",
       {"base", "psychometrics", "analysis/statistics", "analysis/output", "analysis/data"},
       false},
      {"analysis/sweep", {"base", "experiments/store", "analysis/statistics", "analysis/output"}, false},
      {"analysis/study",
       {"base", "psychometrics", "experiments/store", "analysis/statistics", "analysis/psychometric",
        "analysis/output", "analysis/data", "analysis/fits", "analysis/groups", "analysis/relations"},
       false},
      {"analysis/study_page",
       {"base", "experiments/store", "analysis/statistics", "analysis/psychometric", "analysis/output",
        "analysis/fits", "analysis/groups", "analysis/relations", "analysis/study"},
       false},
      {"analysis/commands",
       {"base", "experiments/store", "analysis/statistics", "analysis/psychometric", "analysis/output",
        "analysis/data", "analysis/fits", "analysis/groups", "analysis/relations", "analysis/sweep",
        "analysis/study", "analysis/study_page"},
       false},
      {"window", {"base", "renderer/gl"}, true},
      {"viewer",
       {"base", "window", "renderer/gl", "renderer/scene", "renderer/frame", "renderer/techniques",
        "renderer/references", "perception", "experiments"},
       true},
      {"study/procedures", {"base", "psychometrics"}, false},
      {"study",
       {"base", "psychometrics", "study/procedures", "experiments/store", "renderer/gl", "renderer/scene",
        "renderer/frame", "renderer/techniques", "renderer/references", "renderer", "perception", "window"},
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
  if (user.folder == used.folder) return true;
  // Who may use perception may use its parts.
  return std::any_of(user.mayUse.begin(), user.mayUse.end(), [&](const std::string& folder) {
    return used.folder == folder || (folder == "perception" && used.folder.rfind("perception/", 0) == 0);
  });
}

bool namesGl(const std::string& name) {
  static const std::regex kGl("epoxy|glfw|opengl|(^|[^a-z])(lib|-l)?(egl|gl|glx|gles[0-9v]*)([^a-z]|$)",
                              std::regex::icase | std::regex::optimize);
  return std::regex_search(name, kGl);
}

}  // namespace limen::architecture
