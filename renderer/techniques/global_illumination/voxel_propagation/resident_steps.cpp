// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/voxel_propagation/resident_steps.h"

#include <epoxy/gl.h>

#include "renderer/techniques/global_illumination/illumination_bindings.h"

namespace limen::techniques {
namespace {

/// Of a word; one takes some .5 us on a GPU. A trial that gets stuck lasts as long.
constexpr uint32_t kPollsOfTrial = 1U << 14U, kPollsOfFrame = 1U << 18U;
/// See pause() in propagate_resident.comp.glsl.
constexpr uint32_t kPollsOfThreadsTrial = 20000, kPollsOfThread = 60000;
constexpr int kTrials = 4;
constexpr int kMostInvocations = 768;  // of a group, so that each may have 80 registers
/// The smallest of which a grid has at most kMostGroups, as a step takes longer in larger ones; the last for
/// grids that have more.
constexpr glm::ivec3 kTiles[] = {{4, 4, 4}, {8, 4, 4}, {8, 8, 4}};
constexpr int64_t kMostGroups = 128;         // processors of the GPU that this was measured on: 132
constexpr int64_t kMostShared = 32768 - 64;  // bytes; what is left is for all else

int64_t lightBytes(FieldFormat field) { return field == FieldFormat::Half ? 8 : 16; }

int64_t shellBytes(FieldFormat field, glm::ivec3 tile) {
  return 3 * lightBytes(field) * (tile.x + 2) * (tile.y + 2) * (tile.z + 2);
}

int64_t product(glm::ivec3 sides) { return int64_t{sides.x} * sides.y * sides.z; }

}  // namespace

void ResidentSteps::Form::define(gl::ShaderDefines& defines) const {
  defines["TILE_X"] = std::to_string(tile.x);
  defines["TILE_Y"] = std::to_string(tile.y);
  defines["TILE_Z"] = std::to_string(tile.z);
  defines["SHELLS"] = std::to_string(shells);
  if (threads) defines["PATIENT"] = "1";
}

ResidentSteps::Form ResidentSteps::formOf(FieldFormat field, glm::ivec3 gridSize, bool software) {
  Form form{field, gridSize, 1, false};
  if (3 * product(gridSize) > kMostInvocations || shellBytes(field, gridSize) > kMostShared) {
    form.threads = software;
    for (const glm::ivec3 tile : kTiles) {
      form.tile = tile;
      // A software renderer has few threads, of which each has a group.
      if (!software && product(form.groups(gridSize)) <= kMostGroups) break;
    }
  }
  if (!form.threads && 2 * shellBytes(field, form.tile) <= kMostShared) form.shells = 2;
  return form;
}

ResidentSteps::ResidentSteps(const gl::Program& program, const Form& form, glm::ivec3 gridSize)
    : program_(program),
      groups_(form.groups(gridSize)),
      stuck_(4, nullptr),
      // Of two steps; a tag is as long as what it is of.
      lights_(int64_t{2} * 3 * product(gridSize) * 2 * lightBytes(form.field), nullptr),
      pollsOfTrial_(form.threads ? kPollsOfThreadsTrial : kPollsOfTrial),
      pollsOfFrame_(form.threads ? kPollsOfThread : kPollsOfFrame) {
  stuck_.clearUint(0);
  lights_.clearUint(0);
}

void ResidentSteps::run(int from, int to, int steps) { dispatch(from, to, steps, pollsOfFrame_); }

bool ResidentSteps::works() {
  // So many that no group can end before all have begun: in fewer, those far from others leave their place to
  // them, and the trial tells nothing of longer ones.
  const int steps = groups_.x + groups_.y + groups_.z;
  for (int i = 0; i < kTrials; ++i) dispatch(0, 1, steps, pollsOfTrial_);
  return !stuck();
}

bool ResidentSteps::stuck() const {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return stuck_.read<uint32_t>(0, 1)[0] != 0;
}

void ResidentSteps::dispatch(int from, int to, int steps, uint32_t mostPolls) {
  program_.set("from", from);
  program_.set("to", to);
  program_.set("steps", steps);
  program_.set("firstTag", firstTag_);
  program_.set("mostPolls", mostPolls);
  stuck_.bindStorage(kStepStuckBuffer);
  lights_.bindStorage(kStepLightsBuffer);
  program_.use();
  glDispatchCompute(static_cast<GLuint>(groups_.x), static_cast<GLuint>(groups_.y),
                    static_cast<GLuint>(groups_.z));
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_SHADER_STORAGE_BARRIER_BIT);
  // The last step sends nothing, so that the next dispatch counts on from that before it.
  firstTag_ += static_cast<uint32_t>(steps);
}

}  // namespace limen::techniques
