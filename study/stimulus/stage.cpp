// SPDX-License-Identifier: BSD-3-Clause
#include "study/stimulus/stage.h"

#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"

namespace limen::study {

void checkFiles(const NamedEntry& entry, const std::string& where) {
  for (const auto& [parameter, hash] : entry.fileHashes)
    if (entry.values.has(parameter) && sha256File(entry.values.text(parameter)) != hash)
      throw Error("'" + entry.values.text(parameter) + "' has changed since the stimulus was made", where,
                  "put the file back, or read the protocol anew");
}

std::shared_ptr<const Stage> buildStage(const NamedEntry& scene) {
  const std::string where = "scene '" + scene.name + "'";
  const scene::SceneInfo& info = scene::SceneRegistry::instance().get(scene.name, "stimulus");
  if (info.version != scene.version)
    throw Error("version " + std::to_string(scene.version) + " is asked for", where,
                "this program builds version " + std::to_string(info.version));
  checkFiles(scene, where);
  return std::make_shared<const Stage>(
      scene::buildScene(scene.name, ParameterValues(info.allParameters(), scene.values.all(), where)));
}

std::shared_ptr<const Stage> StageCache::get(const NamedEntry& scene) {
  const std::string key =
      scene.name + "|" + std::to_string(scene.version) + "|" + scene.values.toJson().dump();
  for (auto entry = stages_.begin(); entry != stages_.end(); ++entry) {
    if (entry->first != key) continue;
    stages_.splice(stages_.begin(), stages_, entry);
    return entry->second;
  }
  // Room is made first: two large scenes at once may be more than the GPU holds.
  while (!stages_.empty() && stages_.size() >= most_) stages_.pop_back();
  stages_.emplace_front(key, buildStage(scene));
  return stages_.front().second;
}

}  // namespace limen::study
