// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/shaded.h"
#include "renderer/scene/lod_set.h"
#include "renderer/scene/scene.h"
#include "renderer/techniques/technique.h"
#include "study/stimulus/stimulus.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::study {

using Given = std::map<std::string, ParameterValue>;

inline NamedEntry sceneEntry(const std::string& name, const Given& given) {
  const scene::SceneInfo& info = scene::SceneRegistry::instance().get(name);
  return {name, info.version, ParameterValues(info.allParameters(), given), {}};
}

inline NamedEntry techniqueEntry(const std::string& name, const Given& given = {}) {
  const techniques::TechniqueInfo& info = techniques::TechniqueRegistry::instance().get(name);
  return {name, info.version, ParameterValues(info.parameters, given), {}};
}

/// The patch of Schwarz 2009, section 10.4.1, a short approach with its change in the middle: 12 frames at 60
/// Hz, the seventh is the first with the finer level.
inline Stimulus patchStimulus() {
  Stimulus out;
  out.scene = sceneEntry("lod/patch", {{"distance", 4.0}});
  out.levels = LevelChange{0, 1, 0, "finest"};
  out.durationS = 0.2;
  out.changeAtS = 0.1;
  return out;
}

/// Its display, of whose screen the pictures are a small part.
inline perception::DisplayProfile studyDisplay() { return perception::displayPreset("schwarz_2009"); }

}  // namespace limen::study
