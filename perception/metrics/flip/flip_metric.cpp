// SPDX-License-Identifier: BSD-3-Clause
#include <optional>

#include "experiments/base/error.h"
#include "perception/metrics/comparison.h"
#include "perception/metrics/flip/flip_gpu.h"
#include "perception/metrics/metric_gpu.h"
#include "perception/metrics/metric_texture.h"

namespace limen::perception {
namespace {

struct FlipMetricSettings {
  double pixelsPerDegree = FlipGpu::kDefaultPixelsPerDegree;
  static const SettingsTable<FlipMetricSettings>& table() {
    static const SettingsTable<FlipMetricSettings> kTable = {
        {&FlipMetricSettings::pixelsPerDegree,
         "pixels_per_degree",
         {FlipGpu::kLeastPixelsPerDegree, FlipGpu::kMostPixelsPerDegree},
         "px/deg",
         "pixels per degree of visual angle at the viewer's eye",
         "Andersson et al. 2020"}};
    return kTable;
  }
};

MetricResult measure(const ComparisonInput& input, const FlipMetricSettings& settings) {
  const Comparison pair(input, "flip", Region::All);
  if (!input.gpu)
    throw Error("metric 'flip' needs an OpenGL context", {},
                "run it on a machine with OpenGL 4.5, or use ssim or de94");
  const glm::ivec2 sizePx(pair.width(), pair.height());
  const double pixelsPerDegree = settings.pixelsPerDegree;
  std::shared_ptr<void>& kept = input.gpu->kept("flip");
  auto* flip = static_cast<FlipGpu*>(kept.get());
  if (!flip || flip->sizePx() != sizePx || flip->pixelsPerDegree() != pixelsPerDegree) {
    kept.reset();  // frees the memory before the next one allocates
    const auto made = std::make_shared<FlipGpu>(input.gpu->context(), sizePx, pixelsPerDegree);
    flip = made.get();
    kept = made;
  }
  std::optional<gl::Texture> test, reference;
  if (!input.testTexture) test.emplace(metricTexture(*input.test));
  if (!input.referenceTexture) reference.emplace(metricTexture(*input.reference));

  MetricResult result;
  result.value =
      flip->compute(test ? *test : *input.testTexture, reference ? *reference : *input.referenceTexture);
  result.evaluatedPixels = pair.evaluatedPixels();
  if (input.wantsMap) {
    result.map = flip->map().read();
    result.mapName = "flip";
  }
  return result;
}

const RegisteredMetric<FlipMetricSettings> kRegistered{
    {.name = "flip",
     .summary = "mean LDR-FLIP error: how much a viewer notices when the images are shown in turn",
     .source = "Andersson et al. 2020",
     .title = "Mean FLIP error",
     .needsGl = true},
    &measure};

}  // namespace
}  // namespace limen::perception
