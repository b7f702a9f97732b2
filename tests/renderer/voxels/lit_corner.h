// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/scene/scene.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::voxels {

inline scene::Material plainMaterial(glm::vec3 albedo, float transmittance = 0.0F, glm::vec3 emission = {}) {
  scene::Material out;
  out.albedo = albedo;
  out.transmittance = glm::vec3(transmittance);
  out.emission = emission;
  return out;
}

/// A floor, a wall, a pane of glass that both cross, and a panel that emits; two lamps.
inline scene::Scene litCorner() {
  scene::Scene scene;
  scene::addPart(scene, scene::card({0.0, -0.5, 0.0}, {1.0, 0.07, 0.03}, {0.04, 0.05, -0.9}),
                 plainMaterial({0.8F, 0.7F, 0.6F}));
  scene::addPart(scene, scene::card({-0.3, 0.1, 0.05}, {0.11, 0.7, 0.02}, {0.05, -0.03, 0.71}),
                 plainMaterial({0.8F, 0.1F, 0.2F}));
  scene::addPart(scene, scene::card({0.2, -0.2, 0.1}, {0.63, 0.2, -0.13}, {-0.1, 0.6, 0.2}),
                 plainMaterial({0.1F, 0.6F, 0.3F}, 0.5F));
  scene::addPart(scene, scene::card({0.7, 0.3, -0.4}, {0.05, 0.2, 0.03}, {0.11, -0.04, 0.22}),
                 plainMaterial({0.3F, 0.3F, 0.3F}, 0.0F, {1.0F, 0.25F, 2.0F}));
  for (const glm::dvec3 at : {glm::dvec3(0.4, 0.9, 0.3), glm::dvec3(-0.7, 0.8, 0.6)}) {
    scene::AreaLight light;
    light.centre = at;
    light.axisX = {1.0, 0.0, 0.0};
    light.axisY = {0.0, 0.0, 1.0};
    light.size = {0.1, 0.1};
    scene.lights.push_back(light);
  }
  return scene;
}

}  // namespace limen::voxels
