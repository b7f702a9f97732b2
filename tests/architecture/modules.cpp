// SPDX-License-Identifier: BSD-3-Clause
#include "tests/architecture/modules.h"

#include <algorithm>
#include <regex>

namespace limen::architecture {

const std::vector<Module>& modules() {
  static const std::vector<Module> kModules = {
      {"experiments/base", {}, false},
      {"perception/psychometrics", {"experiments/base"}, false},
      {"renderer/gl", {"experiments/base"}, true},
      {"renderer/compute", {"experiments/base", "renderer/gl"}, true},
      {"renderer/surfaces", {"experiments/base"}, false},
      {"renderer/scene", {"experiments/base", "renderer/surfaces"}, false},
      {"renderer/ray_tracing", {"experiments/base", "renderer/gl", "renderer/compute"}, true},
      {"renderer/visibility_fields",
       {"experiments/base", "renderer/gl", "renderer/ray_tracing", "renderer/scene"},
       true},
      {"renderer/many_lods", {"experiments/base", "renderer/gl"}, true},
      {"renderer/frame",
       {"experiments/base", "renderer/gl", "renderer/ray_tracing", "renderer/surfaces", "renderer/scene"},
       true},
      {"renderer/voxels",
       {"experiments/base", "renderer/gl", "renderer/ray_tracing", "renderer/scene", "renderer/frame"},
       true},
      {"renderer/incremental_voxels",
       {"experiments/base", "renderer/gl", "renderer/ray_tracing", "renderer/scene", "renderer/frame",
        "renderer/voxels"},
       true},
      {"renderer/techniques",
       {"experiments/base", "renderer/gl", "renderer/ray_tracing", "renderer/visibility_fields",
        "renderer/many_lods", "renderer/voxels", "renderer/incremental_voxels", "renderer/compute",
        "renderer/surfaces", "renderer/scene", "renderer/frame", "perception"},
       true},
      {"renderer/references",
       {"experiments/base", "renderer/gl", "renderer/ray_tracing", "renderer/surfaces", "renderer/scene",
        "renderer/frame", "renderer/techniques", "perception"},
       true},
      // Whatever lies in no folder above.
      {"renderer",
       {"experiments/base", "renderer/gl", "renderer/scene", "renderer/frame", "renderer/techniques",
        "renderer/references", "perception"},
       true},
      // The half of perception that runs anywhere.
      {"perception/vision", {"experiments/base"}, false},
      {"perception/multiscale", {"experiments/base", "perception/vision"}, false},
      {"perception/image_analysis", {"experiments/base"}, false},
      {"perception/threshold_maps",
       {"experiments/base", "renderer/gl", "perception/vision", "perception/multiscale"},
       true},
      {"perception",
       {"experiments/base", "renderer/gl", "perception/vision", "perception/multiscale",
        "perception/image_analysis", "perception/threshold_maps"},
       true},
      {"experiments/store", {"experiments/base"}, false},
      {"experiments",
       {"experiments/base", "experiments/store", "renderer/gl", "renderer/scene", "renderer/frame",
        "renderer/techniques", "renderer/references", "renderer", "perception"},
       true},
      {"analysis/statistics", {"experiments/base", "perception/psychometrics"}, false},
      {"analysis/psychometric",
       {"experiments/base", "perception/psychometrics", "analysis/statistics"},
       false},
      {"analysis/output", {"experiments/base", "analysis/statistics"}, false},
      {"analysis/answer_tables", {"experiments/base", "analysis/output"}, false},
      {"analysis/answer_fits",
       {"experiments/base", "perception/psychometrics", "analysis/statistics", "analysis/psychometric",
        "analysis/output", "analysis/answer_tables"},
       false},
      {"analysis/observer_statistics",
       {"experiments/base", "analysis/statistics", "analysis/output", "analysis/answer_tables"},
       false},
      {"analysis/correlations",
       {"experiments/base", "perception/psychometrics", "analysis/statistics", "analysis/output",
        "analysis/answer_tables"},
       false},
      {"analysis/pair_scales",
       {"experiments/base", "perception/psychometrics", "analysis/statistics", "analysis/output",
        "analysis/answer_tables", "analysis/correlations"},
       false},
      {"analysis/sweep",
       {"experiments/base", "experiments/store", "analysis/statistics", "analysis/output"},
       false},
      {"analysis/study",
       {"experiments/base", "perception/psychometrics", "experiments/store", "analysis/statistics",
        "analysis/psychometric", "analysis/output", "analysis/answer_tables", "analysis/answer_fits",
        "analysis/observer_statistics", "analysis/correlations", "analysis/pair_scales", "study/procedures"},
       false},
      {"analysis/study_page",
       {"experiments/base", "experiments/store", "analysis/statistics", "analysis/psychometric",
        "analysis/output", "analysis/answer_fits", "analysis/observer_statistics", "analysis/correlations",
        "analysis/pair_scales", "analysis/study"},
       false},
      {"analysis/commands",
       {"experiments/base", "experiments/store", "analysis/statistics", "analysis/psychometric",
        "analysis/output", "analysis/answer_tables", "analysis/answer_fits", "analysis/observer_statistics",
        "analysis/correlations", "analysis/pair_scales", "analysis/sweep", "analysis/study",
        "analysis/study_page"},
       false},
      {"renderer/window", {"experiments/base", "renderer/gl"}, true},
      {"experiments/viewer",
       {"experiments/base", "renderer/window", "renderer/gl", "renderer/scene", "renderer/frame",
        "renderer/techniques", "renderer/references", "renderer", "perception", "experiments"},
       true},
      {"study/procedures", {"experiments/base", "perception/psychometrics"}, false},
      {"study",
       {"experiments/base", "perception/psychometrics", "study/procedures", "experiments/store",
        "renderer/gl", "renderer/scene", "renderer/frame", "renderer/techniques", "renderer/references",
        "renderer", "perception", "renderer/window"},
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
