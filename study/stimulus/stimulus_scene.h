// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <list>
#include <memory>
#include <string>

#include "renderer/frame/scene_on_gpu.h"
#include "study/stimulus/stimulus.h"

namespace limen::study {

/// Throws Error if a file that the entry names no longer has the content that was hashed.
void checkFiles(const NamedEntry& entry, const std::string& where);

/// Builds what a stimulus names. Throws Error: unknown name, bad value, a version that this program does not
/// have or a file that has changed, since its pictures would not be those of the stimulus.
std::shared_ptr<const frame::SceneOnGpu> buildStimulusScene(const NamedEntry& scene);

/// The most recently used scenes: stimuli of a study mostly share theirs. Uses the current OpenGL context.
class SceneCache {
 public:
  explicit SceneCache(size_t most = 4) : most_(most) {}
  std::shared_ptr<const frame::SceneOnGpu> get(const NamedEntry& scene);

 private:
  size_t most_;
  std::list<std::pair<std::string, std::shared_ptr<const frame::SceneOnGpu>>> scenes_;  // latest first
};

}  // namespace limen::study
