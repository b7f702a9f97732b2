// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/voxel_propagation/resident_steps.h"

#include <epoxy/gl.h>

#include "renderer/techniques/global_illumination/illumination_bindings.h"

namespace limen::techniques {
namespace {

/// Of a neighbour's signal; one takes some .5 us. A trial that gets stuck lasts as long.
constexpr uint32_t kPollsOfTrial = 1U << 14U, kPollsOfFrame = 1U << 18U;
constexpr int kStepsOfTrial = 8;
constexpr int kMostInvocations = 768;  // of a group, so that each may have 80 registers

}  // namespace

glm::ivec3 ResidentSteps::tileOf(glm::ivec3 gridSize) {
  if (3 * gridSize.x * gridSize.y * gridSize.z <= kMostInvocations) return gridSize;
  return {8, 8, 4};
}

void ResidentSteps::define(gl::ShaderDefines& defines, glm::ivec3 tile) {
  defines["TILE_X"] = std::to_string(tile.x);
  defines["TILE_Y"] = std::to_string(tile.y);
  defines["TILE_Z"] = std::to_string(tile.z);
}

ResidentSteps::ResidentSteps(const gl::Program& program, glm::ivec3 gridSize, glm::ivec3 tile,
                             gl::Format field)
    : program_(program),
      groups_((gridSize + tile - 1) / tile),
      signals_(int64_t{4} * (kSignalStride * groups() + 1), nullptr),
      lights_(int64_t{2} * 3 * gridSize.x * gridSize.y * gridSize.z * (field == gl::Format::RGBA16F ? 8 : 16),
              nullptr) {
  signals_.clearUint(0);
  lights_.clearUint(0);
}

void ResidentSteps::run(int from, int to, int steps) { dispatch(from, to, steps, kPollsOfFrame); }

bool ResidentSteps::works() {
  for (int i = 0; i < 4; ++i) dispatch(0, 1, kStepsOfTrial, kPollsOfTrial);
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
