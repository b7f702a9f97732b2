// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <list>
#include <memory>
#include <string>

#include "renderer/frame/scene_on_gpu.h"
#include "study/stimulus/stimulus.h"

namespace limen::study {

/// Throws Error if a file that the entry names no longer has the content that it was hashed with.
void checkFiles(const NamedEntry& entry, const std::string& where);

/// Builds what a stimulus names. Throws Error: unknown name, bad value, and a version that this program does
/// not have or a file that has changed, whose pictures would not be those that the stimulus stands for.
std::shared_ptr<const frame::SceneOnGpu> buildStimulusScene(const NamedEntry& scene);

/// The scenes used last: stimuli of a study mostly share theirs. Its OpenGL context is the current one.
class SceneCache {
 public:
  explicit SceneCache(size_t most = 4) : most_(most) {}
  std::shared_ptr<const frame::SceneOnGpu> get(const NamedEntry& scene);

 private:
  size_t most_;
  std::list<std::pair<std::string, std::shared_ptr<const frame::SceneOnGpu>>> scenes_;  // latest first
};

}  // namespace limen::study
