// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/image.h"
#include "experiments/executor.h"
#include "perception/metrics/metric.h"

namespace limen::experiments {

/// Absolute or relative error, or change, that pictures of errors and changes show as white: the same in all
/// runs, so that pictures can be compared.
inline constexpr double kErrorScale = 0.25;

/// Difference that pictures of a JND map show as white, in all runs alike.
inline constexpr double kJndPictureWhite = 10.0;

/// Applies the run's metrics. A map for pictures is kept in `maps` (name, image).
std::vector<store::Measurement> judge(const PlannedRun& run, const perception::ComparisonInput& input,
                                      std::vector<std::pair<std::string, Image>>& maps);

/// Writes the run's pictures below `folder`/artefacts and returns them with their hashes; paths are relative
/// to `folder`. `views` (Technique::pictures()) become artefacts of kind "view_NAME_png".
std::vector<store::Artefact> writeArtefacts(const PlannedRun& run, const std::string& folder,
                                            const Image& product, const Image* reference,
                                            const Image& shading,
                                            const std::vector<std::pair<std::string, Image>>& maps,
                                            const std::map<std::string, Image>& views);

}  // namespace limen::experiments
