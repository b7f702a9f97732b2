// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/voxel_propagation/light_programs.h"

#include <cmath>
#include <numbers>
#include <string>
#include <variant>

#include "renderer/techniques/global_illumination/surface_light.h"

namespace limen::techniques {
namespace {

const std::string kLightGridFolder = "renderer/techniques/global_illumination/voxel_propagation/";

/// Harmonics of a cone as transport.glsl takes them.
void setCone(const gl::Program& program, double halfAngleDeg, double scale) {
  const double cosine = std::cos(glm::radians(halfAngleDeg));
  program.set("coneShare", static_cast<float>(0.5 * (1.0 - cosine)));
  program.set("coneSlope", static_cast<float>(0.75 * (1.0 - cosine * cosine)));
  program.set("coneDirection", static_cast<float>(0.5 * (1.0 + cosine)));
  program.set("coneScale", static_cast<float>(scale));
}

}  // namespace

LightPrograms::LightPrograms(frame::Frame& frame, const LightGridSettings& settings,
                             const frame::SurfaceLightSettings& lighting, const voxels::Volume& volume)
    : transport_(settings.transport) {
  gl::ProgramCache& programs = frame.context().programs();
  gl::ShaderDefines defines = surfaceLightDefines(lighting, frame);
  defines.merge(volume.defines());
  inject = &programs.compute(kLightGridFolder + "inject.comp.glsl", defines);
  defines = volume.defines();
  defines["FIELD_FORMAT"] = settings.format == FieldFormat::Half ? "rgba16f" : "rgba32f";
  gl::ShaderDefines seeding = defines;
  seeding["FIELD_TOO"] = "1";
  seed = &programs.compute(kLightGridFolder + "seed.comp.glsl", seeding);
  flux = &programs.compute(kLightGridFolder + "light_flux.comp.glsl");
  cells = &programs.compute(kLightGridFolder + "light_cells.comp.glsl", defines);
  int number = 0;
  for (const char* name : {"MOMENTS", "FACES", "CONES", "COMPONENTS"})
    defines["TRANSPORT_" + std::string(name)] = std::to_string(number++);
  defines["TRANSPORT"] = std::to_string(settings.transport.index());
  arriveDefines_ = defines;
  const bool summed = settings.sumsArrivals();
  arriveDefines_["ARRIVED_FORMAT"] = summed ? "rgba32f" : defines["FIELD_FORMAT"];
  arriveDefines_["ARRIVED_ACCESS"] = summed ? "" : "writeonly";
  if (summed) arriveDefines_["SUMMED"] = "1";
  arrive = &step(frame, "arrive.comp.glsl", arriveDefines_);
  defineEnum(defines, "REFLECTION", settings.reflection);
  defineEnum(defines, "ALBEDO", settings.albedo);
  if (settings.steps.stopBelow > 0.0) defines["STOPS"] = "1";
  if (frame.scene().traits().count("refractive_materials") != 0) defines["TRANSPARENT"] = "1";
  if (settings.format == FieldFormat::Half) defines["FIELD_HALF"] = "1";
  if (settings.generations() > 1) reflect = &step(frame, "reflect.comp.glsl", defines);
  if (std::holds_alternative<LimitedBounces>(settings.steps.bounces)) defines["ABSORBS"] = "1";
  stepDefines_ = defines;
  propagate = &step(frame, "propagate.comp.glsl", defines);
}

const gl::Program& LightPrograms::residentSteps(frame::Frame& frame, const ResidentSteps::Form& form) const {
  gl::ShaderDefines defines = stepDefines_;
  form.define(defines);
  return step(frame, "propagate_resident.comp.glsl", defines);
}

const gl::Program& LightPrograms::arriveAfterResident(frame::Frame& frame) const {
  gl::ShaderDefines defines = arriveDefines_;
  defines["RESIDENT"] = "1";
  return step(frame, "arrive.comp.glsl", defines);
}

const gl::Program& LightPrograms::step(frame::Frame& frame, const char* shader,
                                       const gl::ShaderDefines& defines) const {
  return frame.context().programs().compute(kLightGridFolder + shader, defines);
}

void LightPrograms::setTransport(const gl::Program& program) const {
  if (const auto* cones = std::get_if<ConeTransport>(&transport_)) {
    const double solidAngle = 2.0 * std::numbers::pi * (1.0 - std::cos(glm::radians(cones->halfAngleDeg)));
    setCone(program, cones->halfAngleDeg, cones->normalised ? 1.0 : solidAngle);
  } else if (const auto* components = std::get_if<ComponentTransport>(&transport_)) {
    // So that six neighbours of equal light keep it.
    setCone(program, components->halfAngleDeg,
            1.0 / (3.0 * (1.0 - std::cos(glm::radians(components->halfAngleDeg)))));
  }
}

}  // namespace limen::techniques
