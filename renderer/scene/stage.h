// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace limen::scene {

enum class Role { Caster, ReceiverOnly };

/// Adds `mesh` as a separate part with a material of the same name.
void addPart(Scene& scene, const std::string& name, const Mesh& mesh, glm::vec3 albedo,
             Role role = Role::Caster);

/// As above, with any material; the part bears its name.
void addPart(Scene& scene, const Mesh& mesh, const Material& material, Role role = Role::Caster);

/// Adds a square ground plane facing +y as a part "ground" that only receives.
void addGround(Scene& scene, double size, glm::dvec3 centre = glm::dvec3(0.0));

/// Rectangular light at `centre` facing `target`, its x axis horizontal.
AreaLight lightTowards(glm::dvec3 centre, glm::dvec3 target, glm::dvec2 size);

/// Camera around `target`: azimuth 0 looks along -z and grows towards +x; elevation 90 looks straight down.
Camera orbitCamera(glm::dvec3 target, double distance, double azimuthDeg, double elevationDeg,
                   double verticalFovDeg = 32.0);

void setStillCamera(Scene& scene, const Camera& camera);

/// Adds light and camera for an object of the given height that stands on the ground at the origin, `reach`
/// being its radius around the y axis: the light (a fifth of the height wide) comes from the left, the camera
/// sees object and shadow. A ground up to 9 times as wide as the larger of the two is entirely in front of
/// the light.
void frameStanding(Scene& scene, double height, double reach);

}  // namespace limen::scene
