// SPDX-License-Identifier: BSD-3-Clause
// Backprojection with depth peeling (SS-07): of the layers that a texel has, the farthest that is still
// nearer to the light than the receiver becomes its micropatch, which closes leaks where a near blocker hides
// the rest of the surface before the receiver. Source: Schwarz 2009, section 3.2.1 (after Bavoil et al.
// 2008).
//
// Areas are summed, one micropatch a texel, however many layers there are; micropatches are not stretched to
// their neighbours, so that the remedies can be compared.
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

class Peeled : public VisibilityTechnique {
 public:
  explicit Peeled(const ParameterValues& values)
      : VisibilityTechnique(values, "renderer/techniques/soft_shadows/peeled/peeled.comp.glsl",
                            "soft_shadows/peeled", {{"LAYERS", std::to_string(values.integer("layers"))}}),
        layers_(static_cast<int>(values.integer("layers"))),
        refinements_(static_cast<int>(values.integer("refinements"))),
        peelBias_(values.real("peel_bias")) {}

 protected:
  const frame::LightFrustum& bindMap(frame::Frame& frame) override {
    constexpr uint32_t kSecondLayerUnit = 4;
    // Before any is bound, since making the inputs binds textures too.
    for (int layer = 1; layer < layers_; ++layer) frame.get<frame::ShadowMap>(settings(layer));
    frame.get<frame::MinMaxPyramid>(mapSettings());
    for (int layer = 1; layer < layers_; ++layer)
      frame.get<frame::ShadowMap>(settings(layer))
          .texture()
          .bindTexture(kSecondLayerUnit + static_cast<uint32_t>(layer) - 1);
    maxIterations_ = maxIterations(frame);
    return bindPyramid(frame);
  }

  void configure(const gl::Program& program) const override {
    program.set("levels", pyramidLevels());
    program.set("refinements", refinements_);
    program.set("maxIterations", maxIterations_);
  }

 private:
  frame::ShadowMapSettings settings(int layer) const {
    frame::ShadowMapSettings all = mapSettings();
    all.layer = layer;
    all.peelBias = peelBias_;
    return all;
  }

  int layers_, refinements_, maxIterations_ = 0;
  double peelBias_;
};

std::vector<Parameter> peeledParameters() {
  std::vector<Parameter> all = VisibilityTechnique::commonParameters(2.0);
  all.push_back(integerParameter("layers", 2, 1, 4, "", "Surfaces behind one another that a texel knows",
                                 "Schwarz 2009, section 3.2.1 (after Bavoil et al. 2008)"));
  all.push_back(realParameter("peel_bias", 1e-5, 0.0, 0.1, "",
                              "A surface lies behind another if it is farther by more than this share"));
  all.push_back(integerParameter("refinements", 2, 0, 3, "",
                                 "Times that the search area is narrowed by its depth range",
                                 "Schwarz 2009, section 4.1"));
  return all;
}

const Registered<TechniqueInfo> kPeeledRegistered{
    {.name = "soft_shadows/peeled",
     .version = 1,
     .summary = "Backprojection of each texel's farthest layer that is nearer than the receiver",
     .source = "Schwarz 2009, section 3.2.1 (SS-07)",
     .product = ProductKind::Visibility,
     .parameters = peeledParameters(),
     .needs = {"rectangular_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<Peeled>(values); },
     .errorBound = {},
     .counters = VisibilityTechnique::counterNames()}};

}  // namespace
}  // namespace limen::techniques
