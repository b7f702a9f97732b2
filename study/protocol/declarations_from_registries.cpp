// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/shaded.h"
#include "renderer/scene/scene.h"
#include "renderer/techniques/technique.h"
#include "study/protocol/declarations.h"

namespace limen::study {

std::shared_ptr<const Declarations> declarationsFromRegistries() {
  auto out = std::make_shared<Declarations>();
  for (const auto& [name, info] : scene::SceneRegistry::instance().all())
    out->scenes[name] = {info.version, info.allParameters()};
  for (const auto& [name, info] : techniques::TechniqueRegistry::instance().all())
    out->techniques[name] = {info.version, info.parameters};
  out->shading = frame::ShadedSetting::table().parameters();
  return out;
}

}  // namespace limen::study
