// SPDX-License-Identifier: BSD-3-Clause
// ColorVideoVDP as a metric of rendered products: each is a still image on a display. Videos are compared by
// limen perceive compare.
#include <optional>

#include "experiments/base/error.h"
#include "perception/metrics/color_video_vdp/color_video_vdp_gpu.h"
#include "perception/metrics/comparison.h"
#include "perception/metrics/metric_gpu.h"

namespace limen::perception {
namespace {

/// Displays on which light relative to white has a meaning.
std::vector<std::string> displayChoices() {
  std::vector<std::string> out;
  for (const std::string& name : cvvdp::displayNames())
    if (cvvdp::readDisplay(name).showsRelativeLight()) out.push_back(name);
  for (const std::string& name : displayPresets()) out.push_back(name);
  return out;
}

struct CvvdpSettings {
  std::string display = "standard_4k";
  bool referenceBorders = true;
  static const SettingsTable<CvvdpSettings>& table() {
    static const SettingsTable<CvvdpSettings> kTable = {
        {&CvvdpSettings::display, "display", Names{displayChoices()},
         "display, room and viewing distance: one of ColorVideoVDP's or of Limen's; light is relative to its "
         "white",
         "Mantiuk et al. 2024"},
        {&CvvdpSettings::referenceBorders, "reference_borders",
         "borders of the pyramid as in the authors' program, which is off where one side is odd and the "
         "other even"}};
    return kTable;
  }
};

/// Objects of the last call.
struct KeptCvvdp {
  CvvdpSettings settings;
  cvvdp::ColorVideoVdpGpu metric;
};

MetricResult measureCvvdp(const ComparisonInput& input, const CvvdpSettings& settings) {
  const Comparison pair(input, "color_video_vdp", Region::All);
  if (!input.gpu)
    throw Error("metric 'color_video_vdp' needs an OpenGL context", {},
                "run it on a machine with OpenGL 4.5, or use ssim or de94");
  const glm::ivec2 sizePx(pair.width(), pair.height());
  std::shared_ptr<void>& kept = input.gpu->kept("color_video_vdp");
  auto* found = static_cast<KeptCvvdp*>(kept.get());
  if (!found || found->metric.sizePx() != sizePx || found->settings.display != settings.display ||
      found->settings.referenceBorders != settings.referenceBorders) {
    kept.reset();  // frees the memory before the next one allocates
    cvvdp::Options options;
    options.display = cvvdp::readDisplay(settings.display);
    options.values = cvvdp::Values::Relative;
    options.referenceBorders = settings.referenceBorders;
    options.map = true;
    const auto made = std::make_shared<KeptCvvdp>(
        settings, cvvdp::ColorVideoVdpGpu(input.gpu->context(), sizePx, options, false));
    found = made.get();
    kept = made;
  }
  std::optional<gl::Texture> test, reference;
  if (!input.testTexture) test.emplace(cvvdp::uploadFrame(*input.test));
  if (!input.referenceTexture) reference.emplace(cvvdp::uploadFrame(*input.reference));
  found->metric.begin();
  found->metric.add(test ? *test : *input.testTexture, reference ? *reference : *input.referenceTexture);

  MetricResult result;
  result.value = found->metric.finish().jod;
  result.evaluatedPixels = pair.evaluatedPixels();
  result.map = found->metric.readMap();
  result.mapName = "color_video_vdp";
  return result;
}

const RegisteredMetric<CvvdpSettings> kCvvdpRegistered{
    {.name = "color_video_vdp",
     .summary = "ColorVideoVDP of the product as a still image: 10 JOD for no visible difference, one less "
                "where 75 % "
                "of viewers prefer the reference; even changes of brightness are not seen",
     .source = "Mantiuk et al. 2024",
     .title = "ColorVideoVDP",
     .unit = "JOD",
     .direction = Direction::HigherIsBetter,
     .needsGl = true},
    &measureCvvdp};

}  // namespace
}  // namespace limen::perception
