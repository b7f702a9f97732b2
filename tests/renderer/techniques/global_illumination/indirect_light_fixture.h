// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {

constexpr const char* kPropagation = "global_illumination/voxel_propagation";
constexpr const char* kPropagationVolumes = "global_illumination/light_propagation_volumes";

/// Pictures of indirect light and what they should be.
class IndirectLightTest : public TechniqueTest {
 protected:
  static Rendered indirect(const scene::Scene& scene, Given given, bool counting = false,
                           const char* technique = kPropagation) {
    given["light"] = std::string("indirect");
    if (std::string(technique) == kPropagation) given.emplace("resolution", int64_t{16});
    return render(scene, technique, given, {32, 24}, counting);
  }

  static Image truth(const scene::Scene& scene) {
    return render(scene, "global_illumination/path_reference",
                  {{"paths", int64_t{64}}, {"bounces", int64_t{8}}, {"light", std::string("indirect")}},
                  {32, 24})
        .product;
  }

  /// Root mean square over rows before `end`.
  static double error(const Image& a, const Image& b, int end = 24) {
    double sum = 0.0;
    for (int y = 0; y < end; ++y)
      for (int x = 0; x < a.width; ++x)
        for (int c = 0; c < 3; ++c) sum += std::pow(double(a.at(x, y, c)) - b.at(x, y, c), 2.0);
    return std::sqrt(sum / (3.0 * a.width * end));
  }

  /// Of the channels' means, over columns from `first` to before `end`.
  static double meanOf(const Image& picture, int first, int end) {
    double sum = 0.0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = first; x < end; ++x)
        for (int c = 0; c < 3; ++c) sum += picture.at(x, y, c) / 3.0;
    return sum / (double(picture.height) * (end - first));
  }

  static scene::Scene probeAboveFloor() {
    scene::Scene scene;
    scene::addPart(scene, "floor", scene::card({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}),
                   glm::vec3(0.8F));
    scene::addPart(scene, "probe", scene::card({0.0, 0.6, 0.0}, {0.05, 0.0, 0.0}, {0.0, 0.0, 0.05}),
                   glm::vec3(0.8F));
    scene.lights = {scene::lightTowards({0.4, 1.5, 0.0}, {0.0, 0.0, 0.0}, glm::dvec2(0.1))};
    scene::setStillCamera(scene, {{0.0, 0.1, 0.0}, {0.0, 0.6, 0.0}, {1.0, 0.0, 0.0}, 8.0});
    return scene;
  }

  /// Products of `frames` frames, one after another.
  static std::vector<Image> pictures(const scene::Scene& scene, Given given, int frames) {
    given["light"] = std::string("indirect");
    const TechniqueInfo& info = TechniqueRegistry::instance().get(kPropagation);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {32, 24});
    const auto made = info.make(ParameterValues(info.parameters, given));
    made->prepare(frame);
    std::vector<Image> out;
    for (int i = 0; i < frames; ++i) {
      frame.begin();
      made->render(frame);
      out.push_back(made->product().read());
      frame.end();
    }
    return out;
  }
};

}  // namespace limen::techniques
