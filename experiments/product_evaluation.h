// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/base/image.h"
#include "experiments/executor.h"
#include "experiments/product.h"
#include "perception/metrics/metric.h"

namespace limen::experiments {

/// What metrics show, for artefacts.
struct MetricPictures {
  std::vector<std::pair<std::string, Image>> maps;  ///< name, image
  std::vector<perception::MetricPicture> pictures;
};

/// Applies the run's metrics; those that average pixels get a fact NAME_noise if the reference is sampled.
/// Maps and pictures are added to `shown`, each name once.
std::vector<store::Measurement> evaluate(const PlannedRun& run, const perception::ComparisonInput& input,
                                         MetricPictures& shown);

/// Writes the run's pictures below `folder`/artefacts and returns them with their hashes; paths are relative
/// to `folder`. `views` (Technique::pictures()) become artefacts of kind "view_NAME_png".
std::vector<store::Artefact> writeArtefacts(const PlannedRun& run, const std::string& folder,
                                            const Image& product, const Image* reference,
                                            const Image& shading, const MetricPictures& shown,
                                            const std::map<std::string, techniques::PictureMaker>& views);

}  // namespace limen::experiments
