// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/flip/flip_gpu.h"

#include <epoxy/gl.h>

#include <cassert>
#include <string>
#include <vector>

#include "perception/metrics/flip/flip_bindings.h"
#include "perception/metrics/flip/flip_filters.h"

namespace limen::perception {
namespace {

using gl::Access;
using gl::Format;

constexpr int kRun = 8;  ///< pixels per invocation of the column pass
constexpr glm::ivec2 kRowGroup{kFlipRowsGroupX, kFlipRowsGroupY};
constexpr glm::ivec2 kColumnGroup{kFlipColumnsGroupX, kFlipColumnsGroupY};

/// As the uniform block lays them out: both kernels, one after the other.
std::vector<glm::vec4> kernels(double pixelsPerDegree) {
  const FlipFilters filters = makeFlipFilters(pixelsPerDegree);
  std::vector<glm::vec4> taps = filters.sensitivity;
  taps.insert(taps.end(), filters.features.begin(), filters.features.end());
  return taps;
}

}  // namespace

FlipGpu::FlipGpu(gl::Context& context, glm::ivec2 sizePx, double pixelsPerDegree)
    : context_(context),
      sizePx_(sizePx),
      pixelsPerDegree_(pixelsPerDegree),
      radius_(makeFlipFilters(pixelsPerDegree).radius),
      groups_((sizePx + kColumnGroup * glm::ivec2(1, kRun) - 1) / (kColumnGroup * glm::ivec2(1, kRun))),
      testSensitivity_(Format::RGBA32F, sizePx),
      referenceSensitivity_(Format::RGBA32F, sizePx),
      detectors_(Format::RGBA32F, sizePx),
      smoothed_(Format::RG32F, sizePx),
      map_(Format::R32F, sizePx),
      filters_(kernels(pixelsPerDegree)),
      groupSums_(int64_t{groups_.x} * groups_.y * int64_t{sizeof(float)}, nullptr),
      result_(sizeof(float), nullptr) {
  assert(pixelsPerDegree >= kLeastPixelsPerDegree && pixelsPerDegree <= kMostPixelsPerDegree);
}

void FlipGpu::run(const gl::Texture& test, const gl::Texture& reference) {
  assert(test.sizePx() == sizePx_ && reference.sizePx() == sizePx_ && test.format() == reference.format());
  const gl::ShaderDefines defines = {{"RADIUS", std::to_string(radius_)}, {"RUN", std::to_string(kRun)}};
  gl::ProgramCache& programs = context_.programs();
  const std::string folder = "perception/metrics/flip/";
  const gl::Program& rows = programs.compute(folder + "rows.comp.glsl", defines);
  const gl::Program& columns = programs.compute(folder + "columns.comp.glsl", defines);
  const gl::Program& mean = programs.compute(folder + "mean.comp.glsl");

  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  filters_.bindUniform(kFlipFiltersBlock);
  test.bindTexture(kFlipRowsTestImageUnit);
  reference.bindTexture(kFlipRowsReferenceImageUnit);
  testSensitivity_.bindImage(kFlipRowsTestSensitivityImage, Access::Write);
  referenceSensitivity_.bindImage(kFlipRowsReferenceSensitivityImage, Access::Write);
  detectors_.bindImage(kFlipRowsDetectorsImage, Access::Write);
  smoothed_.bindImage(kFlipRowsSmoothedImage, Access::Write);
  rows.set("grey", gl::channelCount(test.format()) == 1 ? 1 : 0);
  rows.dispatch(sizePx_, kRowGroup);

  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  testSensitivity_.bindTexture(kFlipColumnsTestSensitivityUnit);
  referenceSensitivity_.bindTexture(kFlipColumnsReferenceSensitivityUnit);
  detectors_.bindTexture(kFlipColumnsDetectorsUnit);
  smoothed_.bindTexture(kFlipColumnsSmoothedUnit);
  map_.bindImage(kFlipErrorMapImage, Access::Write);
  groupSums_.bindStorage(kFlipGroupSumsBuffer);
  columns.dispatch(groups_, {1, 1});

  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  result_.bindStorage(kFlipMeanResultBuffer);
  mean.set("groupCount", static_cast<uint32_t>(groups_.x * groups_.y));
  mean.set("pixelCount", static_cast<float>(sizePx_.x) * static_cast<float>(sizePx_.y));
  mean.dispatch({1, 1}, {1, 1});
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                  GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

float FlipGpu::mean() const { return result_.read<float>(0, 1).front(); }

int64_t FlipGpu::bytesHeld() const {
  return testSensitivity_.bytes() + referenceSensitivity_.bytes() + detectors_.bytes() + smoothed_.bytes() +
         map_.bytes() + filters_.bytes() + groupSums_.bytes() + result_.bytes();
}

}  // namespace limen::perception
