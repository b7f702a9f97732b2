// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/product_evaluation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>

#include "experiments/base/hash.h"
#include "experiments/measured_quantities.h"
#include "experiments/measurement_name.h"
#include "perception/metrics/error_map.h"
#include "renderer/references/sampling_noise.h"
#include "renderer/techniques/technique.h"

namespace limen::experiments {

std::vector<store::Measurement> evaluate(const PlannedRun& run, const perception::ComparisonInput& input,
                                         std::vector<std::pair<std::string, Image>>& maps) {
  const references::SamplingNoise* noise =
      run.reference.name.empty() ? nullptr
                                 : references::SamplingNoiseRegistry::instance().find(run.reference.name);
  std::vector<store::Measurement> out;
  for (const Configuration& metric : run.metrics) {
    const perception::MetricInfo& info = perception::MetricRegistry::instance().get(metric.name);
    perception::MetricResult result = info.compare(input, metric.values);
    const std::string name = measurementName(metric, run.metrics, info.parameters);
    out.push_back(
        {name, std::isfinite(result.value) ? std::optional(result.value) : std::nullopt, info.unit, "error"});
    if (info.averagesPixels && noise != nullptr && result.evaluatedPixels > 0)
      out.push_back({name + kNoiseSuffix,
                     noiseOfDifference(noise->deviation(run.reference.values), result.evaluatedPixels),
                     info.unit, "fact"});
    const bool known =
        std::any_of(maps.begin(), maps.end(), [&](const auto& map) { return map.first == result.mapName; });
    if (result.map && !known) maps.emplace_back(result.mapName, std::move(*result.map));
  }
  return out;
}

std::vector<store::Artefact> writeArtefacts(const PlannedRun& run, const std::string& folder,
                                            const Image& product, const Image* reference,
                                            const Image& shading,
                                            const std::vector<std::pair<std::string, Image>>& maps,
                                            const std::map<std::string, techniques::PictureMaker>& views) {
  const std::string base = "artefacts/" + run.key.substr(0, 16) + "/";
  // In parallel: compressing one picture takes as long as many frames of a fast technique.
  std::vector<std::future<store::Artefact>> files;
  const auto picture = [&](const std::string& kind, std::function<Image()> make) {
    files.push_back(std::async(std::launch::async, [kind, make = std::move(make), base, folder] {
      const std::string file = base + kind + ".png";
      writePng(folder + "/" + file, make());
      return store::Artefact{kind + "_png", file, sha256File(folder + "/" + file)};
    }));
  };
  const auto exr = [&](const std::string& kind, const Image& image) {
    files.push_back(std::async(std::launch::async, [kind, &image, base, folder] {
      const std::string file = base + kind + ".exr";
      writeExr(folder + "/" + file, image);
      return store::Artefact{kind + "_exr", file, sha256File(folder + "/" + file)};
    }));
  };
  if (run.artefacts.pictures) {
    const techniques::ProductKind kind =
        techniques::TechniqueRegistry::instance().get(run.technique.name).product;
    picture("product", [kind, &product, &shading] { return productPicture(kind, product, shading); });
    if (reference)
      picture("reference", [kind, reference, &shading] { return productPicture(kind, *reference, shading); });
    for (const auto& [name, view] : views) picture("view_" + name, [&view = view] { return view(); });
  }
  if (run.artefacts.exr) {
    exr("product", product);
    if (reference) exr("reference", *reference);
  }
  for (const auto& [name, map] : maps) {
    const std::string kind = name == "absolute_error" ? "error" : name;
    if (run.artefacts.pictures)
      picture(kind, [&name = name, &map = map] { return perception::errorPicture(map, mapWhite(name)); });
    if (run.artefacts.exr) exr(kind, map);
  }
  std::vector<store::Artefact> out;
  for (std::future<store::Artefact>& file : files) out.push_back(file.get());
  return out;
}

}  // namespace limen::experiments
