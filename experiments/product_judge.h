// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/image.h"
#include "experiments/executor.h"
#include "renderer/gl/texture.h"

namespace limen::experiments {

/// The images that one run is judged by.
struct JudgedProduct {
  const gl::Texture* texture = nullptr;           ///< what the technique made
  const gl::Texture* referenceTexture = nullptr;  ///< null: no reference
  const Image* image = nullptr;                   ///< `texture` read back
  const Image* reference = nullptr;
  const Image* mask = nullptr;     ///< 1 where the product means something
  const Image* shading = nullptr;  ///< 3 channels: the scene's unshadowed colour, for pictures
};

/// Absolute error that error pictures show as white: the same in all runs, so that pictures can be compared.
inline constexpr double kErrorScale = 0.25;

/// Applies the run's metrics. A map for pictures is kept in `maps` (name, image).
std::vector<store::Measurement> judge(const PlannedRun& run, const JudgedProduct& product,
                                      std::vector<std::pair<std::string, Image>>& maps);

/// Writes the run's pictures below `folder`/artefacts and returns them with their hashes; paths are relative
/// to `folder`.
std::vector<store::Artefact> writeArtefacts(const PlannedRun& run, const std::string& folder,
                                            const Image& product, const Image* reference,
                                            const Image& shading,
                                            const std::vector<std::pair<std::string, Image>>& maps);

}  // namespace limen::experiments
