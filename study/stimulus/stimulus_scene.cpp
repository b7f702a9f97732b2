// SPDX-License-Identifier: BSD-3-Clause
#include "study/stimulus/stimulus_scene.h"

#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "experiments/base/file_references.h"

namespace limen::study {

void checkFiles(const NamedEntry& entry, const std::string& where) {
  for (const auto& [path, hash] : entry.fileHashes) {
    const ParameterValue* file = entry.values.find(path);
    if (file && sha256WithReferences(std::get<std::string>(*file)) != hash)
      throw Error("'" + limen::toText(*file) + "' has changed since the stimulus was made", where,
                  "restore the file, or read the protocol again");
  }
}

std::shared_ptr<const frame::SceneOnGpu> buildStimulusScene(const NamedEntry& scene) {
  const std::string where = "scene '" + scene.name + "'";
  const scene::SceneInfo& info = scene::SceneRegistry::instance().get(scene.name, "stimulus");
  if (info.version != scene.version)
    throw Error("version " + std::to_string(scene.version) + " is requested", where,
                "this program builds version " + std::to_string(info.version));
  checkFiles(scene, where);
  return std::make_shared<const frame::SceneOnGpu>(
      scene::buildScene(scene.name, ParameterValues(info.allParameters(), scene.values.all(), where)));
}

std::shared_ptr<const frame::SceneOnGpu> SceneCache::get(const NamedEntry& scene) {
  const std::string key =
      scene.name + "|" + std::to_string(scene.version) + "|" + scene.values.toJson().dump();
  for (auto entry = scenes_.begin(); entry != scenes_.end(); ++entry) {
    if (entry->first != key) continue;
    scenes_.splice(scenes_.begin(), scenes_, entry);
    return entry->second;
  }
  // Free memory first: two large scenes at once may exceed the GPU's memory.
  while (!scenes_.empty() && scenes_.size() >= most_) scenes_.pop_back();
  scenes_.emplace_front(key, buildStimulusScene(scene));
  return scenes_.front().second;
}

}  // namespace limen::study
