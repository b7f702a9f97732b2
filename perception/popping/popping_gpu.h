// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "perception/popping/gpu/regions_gpu.h"
#include "perception/popping/predictor.h"
#include "perception/popping/temporal_gpu.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/pass_list.h"
#include "renderer/gl/texture.h"

namespace limen::perception {

/// Like PoppingInput, on the GPU. Textures have the predictor's size and must live until run() has returned;
/// for debugImage() until that has.
struct PoppingGpuInput {
  const gl::Texture* actual = nullptr;  ///< any colour format; one channel is grey
  const gl::Texture* predicted = nullptr;
  bool linear = true;                               ///< as PoppingInput::linear; what techniques render is
  const gl::Texture* actualDisplacement = nullptr;  ///< two or more channels, pixels per frame
  const gl::Texture* predictedDisplacement = nullptr;
  const gl::Texture* disocclusion = nullptr;  ///< weights, one channel
  const gl::Texture* flicker = nullptr;
};

/// The popping predictor on the GPU: predictPopping() in single precision, sensitivities from a table.
/// Allocates everything once, for one image size; run() neither allocates nor reads back. Equal frames give a
/// difference of exactly 0, and the same input the same bytes. Source: Schwarz 2009, section 10.3.
class PoppingPredictorGpu {
 public:
  /// Throws Error like poppingModel(), and on a masking model or decomposition without a GPU version.
  /// `isSwitch`: as PoppingInput::isSwitch.
  PoppingPredictorGpu(gl::Context& context, glm::ivec2 sizePx, const DisplayProfile& display,
                      const PoppingSettings& settings = {}, bool isSwitch = false);

  /// With `passes`, stages are opened as passes "popping/...".
  void run(const PoppingGpuInput& input, gl::PassList* passes = nullptr);

  /// Difference map of the last run [JND], R32F, weighted.
  const gl::Texture& jnd() const { return jnd_; }
  /// R32UI; 0: in no region.
  const gl::Texture& labels() const { return regions_.labels(); }
  /// Count and records of the regions (gpu/region_table.glsl), for use on the GPU.
  const gl::Buffer& regionTable() const { return regions_.table(); }
  /// Regions of the last run; waits for the GPU, as do all members below.
  RegionMap readRegions() const { return regions_.read(); }
  struct Counts {
    uint32_t flushedInputs = 0, guardedContrasts = 0;  ///< as in PoppingResult
  };
  Counts readCounts() const;
  /// A stage of the last run by its name in poppingStages(); allocates, not for timed frames. `input` as it
  /// was given to run(). Throws Error on an unknown name.
  Image debugImage(const std::string& name, const PoppingGpuInput& input);

  const PoppingModel& model() const { return model_; }
  glm::ivec2 sizePx() const { return sizePx_; }
  int64_t bytesHeld() const;

 private:
  const gl::Program& program(const char* name);
  void decompose(const PoppingGpuInput& input);
  void bindResponse(const gl::Program& program, int level);
  /// For masking by neighbours: contrasts of a level over their thresholds.
  void normalise(int level, const gl::ShaderDefines& defines);
  void collapse(const PoppingGpuInput& input, const gl::Texture& target, int shown);
  glm::ivec2 levelSize(int level) const { return glm::max(sizePx_ >> level, glm::ivec2(1)); }

  gl::Context& context_;
  glm::ivec2 sizePx_;
  DisplayProfile display_;
  PoppingSettings settings_;
  PoppingModel model_;
  gl::ShaderDefines defines_, stageDefines_;
  glm::vec3 luminanceOfCones_;
  ResponseTableGrid grid_;
  glm::mat3 conesOfLight_;
  glm::vec3 conesOfBlack_;
  gl::Texture cones_;  ///< Gaussian pyramids of cone responses and speed; layers: actual, predicted
  gl::Texture differences_, sensitivities_, jnd_, seeds_;
  std::shared_ptr<const PartWeightTable> partTable_;  ///< with fitted weights, as partWeights_
  std::optional<gl::Texture> partWeights_;
  std::optional<gl::Texture> normalised_;  ///< layers: as cones_, or after and before a switch
  std::optional<TemporalTablesGpu> temporal_;
  gl::Buffer counters_, mean_;
  RegionsGpu regions_;
};

}  // namespace limen::perception
