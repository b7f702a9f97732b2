// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/vertex_reflection/reflector.h"

#include <glm/gtc/matrix_transform.hpp>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/reflections/vertex_reflection/vertex_reflection_bindings.h"

namespace limen::techniques {
namespace {

/// A facet that its centre sees at less than this is seen along its edge: rounding may turn it round.
constexpr double kLeastStarCosine = 1e-4;

}  // namespace

std::vector<StarReflector> makeReflectors(const scene::Scene& scene, const ReflectorMapSettings& settings,
                                          const reflections::ReflectedMesh& reflected,
                                          const frame::ShownMirrors& shown) {
  std::vector<StarReflector> out;
  for (size_t p = 0; p < scene.parts.size(); ++p) {
    const scene::Part& part = scene.parts[p];
    if (!shown.has(p)) continue;
    if (part.triangleCount == 0 || !scene.materials[part.material].reflects()) continue;
    const scene::TriangleRange range{part.firstTriangle, part.triangleCount};
    const reflections::StarCentre centre = reflections::findStarCentre(scene.mesh, range);
    if (!(centre.leastCosine > kLeastStarCosine))
      throw Error("vertex reflection needs mirrors that some point sees as a whole; part '" + part.name +
                      "' has none",
                  scene.name, "split the part into convex ones, or choose reflections/ray_traced");
    const auto mesh = std::make_shared<const reflections::StarMesh>(scene.mesh, range, centre.position);
    const reflections::StarMap map = reflections::bakeStarMap(
        reflections::StarMesh::surface(mesh), settings.layout, settings.resolution, centre.meanRadius);
    const std::vector<glm::vec4> none(reflected.positions.size(), glm::vec4(0.0F));
    out.push_back({range, centre, mesh, map.filledShare,
                   ReflectorTexture(map, settings.format == MapFormat::Rgba16f, settings.filter),
                   reflected.ownVertices(part.firstTriangle, part.triangleCount), gl::Buffer(none)});
  }
  return out;
}

gl::ShaderDefines secantDefines(const SecantSettings& solver, const ReflectorMapSettings& map) {
  gl::ShaderDefines defines;
  defineEnum(defines, "GRADIENT", solver.gradient);
  defineEnum(defines, "GUESS", solver.guess);
  defineEnum(defines, "SAFEGUARD", solver.safeguard);
  defineEnum(defines, "STOP", solver.stop);
  defines["CAP"] = std::to_string(solver.cap);
  if (map.layout == reflections::MapLayout::LatLong) defines["MAP_LAT_LONG"] = "1";
  return defines;
}

void configureSecant(const gl::Program& program, const frame::Frame& frame, const SecantSettings& solver,
                     const StarReflector& reflector, glm::dvec3 eyeOffset) {
  const glm::dvec3 centre = reflector.centre.position - frame.gpuScene().anchor();
  const double unit = reflector.centre.meanRadius;
  program.set("reflectorCentre", glm::vec3(centre));
  program.set("reflectorUnit", static_cast<float>(unit));
  program.set("mirrorSide", reflector.centre.inside ? -1.0F : 1.0F);
  program.set("solverEye", glm::vec3((frame.camera().eye + eyeOffset - reflector.centre.position) / unit));
  const glm::dmat4 fromUnits = glm::scale(glm::translate(glm::dmat4(1.0), centre), glm::dvec3(unit));
  program.set("reflectorToClip", glm::mat4(glm::dmat4(frame::anchorToClip(frame)) * fromUnits));
  program.set("halfSizePx", 0.5F * glm::vec2(frame.sizePx()));
  program.set("stopAreaPx2", static_cast<float>(solver.stopAreaPx2));
  program.set("determinantShare", static_cast<float>(solver.determinantShare));
  program.set("leastSide", static_cast<float>(solver.leastSide));
  program.set("falseRootLength", static_cast<float>(solver.falseRootLength));
  reflector.map.bindTextures(kReflectorMapUnit, kReflectorPresentUnit);
  program.set("openMirror", reflector.filledShare > 0.0 ? 1 : 0);
}

}  // namespace limen::techniques
