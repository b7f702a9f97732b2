// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/voxel_propagation/resident_steps.h"

#include <epoxy/gl.h>

#include "renderer/techniques/global_illumination/illumination_bindings.h"

namespace limen::techniques {
namespace {

/// Of a neighbour; one takes some .5 us on a GPU. A trial that gets stuck lasts as long.
constexpr uint32_t kPollsOfTrial = 1U << 14U, kPollsOfFrame = 1U << 18U;
/// See pause() in resident_tile.glsl.
constexpr uint32_t kPollsOfThreadsTrial = 20000, kPollsOfThread = 60000;
constexpr int kStepsOfTrial = 8, kTrials = 4;
constexpr int kMostInvocations = 768;  // of a group, so that each may have 80 registers
constexpr glm::ivec3 kUsualTile{8, 8, 4};
constexpr int64_t kMostShared = 32768 - 64;  // bytes; what is left is for all else

int64_t lightBytes(FieldFormat field) { return field == FieldFormat::Half ? 8 : 16; }

int64_t shellBytes(FieldFormat field, glm::ivec3 tile) {
  return 3 * lightBytes(field) * (tile.x + 2) * (tile.y + 2) * (tile.z + 2);
}

int64_t groupsOf(glm::ivec3 groups) { return int64_t{groups.x} * groups.y * groups.z; }

}  // namespace

const char* ResidentSteps::Form::shader() const {
  return exchange == StepExchange::Tags ? "propagate_tagged.comp.glsl" : "propagate_resident.comp.glsl";
}

void ResidentSteps::Form::define(gl::ShaderDefines& defines) const {
  defines["TILE_X"] = std::to_string(tile.x);
  defines["TILE_Y"] = std::to_string(tile.y);
  defines["TILE_Z"] = std::to_string(tile.z);
  defines["SHELLS"] = std::to_string(shells);
  if (threads) defines["PATIENT"] = "1";
}

ResidentSteps::Form ResidentSteps::formOf(StepExchange exchange, FieldFormat field, glm::ivec3 gridSize,
                                          bool software) {
  Form form{exchange, field, kUsualTile, 1, false};
  if (3 * groupsOf(gridSize) <= kMostInvocations && shellBytes(field, gridSize) <= kMostShared)
    form.tile = gridSize;
  form.threads = software && form.tile != gridSize;
  if (exchange == StepExchange::Tags && !form.threads && 2 * shellBytes(field, form.tile) <= kMostShared)
    form.shells = 2;
  return form;
}

ResidentSteps::ResidentSteps(const gl::Program& program, const Form& form, glm::ivec3 gridSize)
    : program_(program),
      groups_((gridSize + form.tile - 1) / form.tile),
      // With tags `stuck` and one word, as a block that ends with an array has at least.
      signals_(form.exchange == StepExchange::Tags ? 8 : int64_t{4} * (kSignalStride * groups() + 1),
               nullptr),
      // Of two steps; a tag is as long as what it is of.
      lights_(int64_t{2} * 3 * groupsOf(gridSize) * lightBytes(form.field) *
                  (form.exchange == StepExchange::Tags ? 2 : 1),
              nullptr),
      pollsOfTrial_(form.threads ? kPollsOfThreadsTrial : kPollsOfTrial),
      pollsOfFrame_(form.threads ? kPollsOfThread : kPollsOfFrame) {
  signals_.clearUint(kFirstSignal);
  constexpr uint32_t kNotStuck = 0;
  signals_.write(0, sizeof(kNotStuck), &kNotStuck);
  lights_.clearUint(0);
}

void ResidentSteps::run(int from, int to, int steps) { dispatch(from, to, steps, pollsOfFrame_); }

bool ResidentSteps::works() {
  for (int i = 0; i < kTrials; ++i) dispatch(0, 1, kStepsOfTrial, pollsOfTrial_);
  return !stuck();
}

bool ResidentSteps::stuck() const {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return signals_.read<uint32_t>(0, 1)[0] != 0;
}

void ResidentSteps::dispatch(int from, int to, int steps, uint32_t mostPolls) {
  program_.set("from", from);
  program_.set("to", to);
  program_.set("steps", steps);
  program_.set("firstSignal", firstSignal_);
  program_.set("mostPolls", mostPolls);
  signals_.bindStorage(kStepSignalsBuffer);
  lights_.bindStorage(kStepLightsBuffer);
  program_.use();
  glDispatchCompute(static_cast<GLuint>(groups_.x), static_cast<GLuint>(groups_.y),
                    static_cast<GLuint>(groups_.z));
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_SHADER_STORAGE_BARRIER_BIT);
  // The last step sends no signal, so that the next dispatch counts on from that before it.
  firstSignal_ += static_cast<uint32_t>(steps);
}

}  // namespace limen::techniques
