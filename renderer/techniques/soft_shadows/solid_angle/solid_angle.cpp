// SPDX-License-Identifier: BSD-3-Clause
// Soft shadows by cone culling (SS-07): a ball replaces the light and balls replace the micropatches; those
// within the cone to the light add their solid angles, relative to the light's. Source: Schwarz 2009,
// section 3.2.1 (after Bavoil and Silva 2006); all formulas reconstructed.
//
// The thesis names regular and Gaussian Poisson subsampling of the search area. Here a tap represents the
// part of the area nearest to it, so that its ball grows as taps become fewer.
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

#include "renderer/gl/buffer.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"
#include "renderer/techniques/soft_shadows/solid_angle/gaussian_taps.h"
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

enum class Ball { Bounding, EqualArea };
constexpr EnumNames<Ball, 2> enumNames(Ball) {
  return {{{{Ball::Bounding, "bounding"}, {Ball::EqualArea, "equal_area"}}}};
}

/// Which texels of the search area are read, with the shader's names.
enum class Sampling { All, Regular, GaussianPoisson };
constexpr EnumNames<Sampling, 3> enumNames(Sampling) {
  return {{{{Sampling::All, "all"},
            {Sampling::Regular, "regular"},
            {Sampling::GaussianPoisson, "gaussian_poisson"}}}};
}

constexpr const char* kTapsText = "Square root of the number of taps in the search area";

struct AllTexels {
  static constexpr const char *kKind = limen::toText(Sampling::All),
                              *kSummary = "every texel of the search area";
};

struct RegularTaps {
  static constexpr const char *kKind = limen::toText(Sampling::Regular),
                              *kSummary = "texels on a regular grid";
  int taps = 16;
  static const SettingsTable<RegularTaps>& table() {
    static const SettingsTable<RegularTaps> kTable = {
        Binding(&RegularTaps::taps, "taps", Range{1, 64}, "", kTapsText).formerly({"taps"})};
    return kTable;
  }
};

struct GaussianTaps {
  static constexpr const char *kKind = limen::toText(Sampling::GaussianPoisson),
                              *kSummary = "texels at random positions, denser towards the centre";
  int taps = 16;
  double sigma = 0.3;
  int64_t seed = 1;
  static const SettingsTable<GaussianTaps>& table() {
    using S = GaussianTaps;
    static const SettingsTable<S> kTable = {
        {&S::taps, "taps", {1, 64}, "", kTapsText},
        Binding(&S::sigma, "sigma", Range{0.1, 10}, "",
                "Standard deviation of tap positions as a share of the search area's side")
            .formerly({"sigma"}),
        Binding(&S::seed, "seed", Range{0, 1000000}, "", "Seed of the tap positions").formerly({"tap_seed"})};
    return kTable;
  }
};

struct SolidAngleSettings {
  MapSettings map;
  SlopeBias bias{.slope = 2.0};
  int refinements = 2;
  std::variant<RegularTaps, AllTexels, GaussianTaps> sampling;
  Ball ball = Ball::Bounding;
  static const SettingsTable<SolidAngleSettings>& table() {
    using S = SolidAngleSettings;
    static const SettingsTable<S> kTable = {
        included(&S::map),
        Binding(&S::bias, "bias", "Bias that keeps a surface from shadowing itself").shorthand("constant"),
        {&S::refinements,
         "refinements",
         {0, 3},
         "",
         "Number of times that the search area is narrowed by its depth range",
         "Schwarz 2009, section 4.1"},
        Binding(&S::sampling, "sampling", "Texels of the search area that are read",
                "Schwarz 2009, section 3.2.1")
            .shorthand("taps"),
        {&S::ball, "ball", "Ball that replaces a micropatch: around it, or with a disc of the same area",
         "Schwarz 2009, section 3.2.1 (bounding)"}};
    return kTable;
  }
};

Sampling samplingOf(const SolidAngleSettings& settings) {
  return std::visit([](const auto& chosen) { return fromText<Sampling>(chosen.kKind); }, settings.sampling);
}

gl::ShaderDefines solidAngleDefines(const SolidAngleSettings& settings) {
  gl::ShaderDefines defines;
  defineEnum(defines, "SAMPLING", samplingOf(settings));
  defineEnum(defines, "BALL", settings.ball);
  return defines;
}

class SolidAngle : public VisibilityTechnique {
 public:
  using Settings = SolidAngleSettings;
  explicit SolidAngle(const SolidAngleSettings& settings)
      : VisibilityTechnique(settings.map, settings.bias,
                            "renderer/techniques/soft_shadows/solid_angle/solid_angle.comp.glsl",
                            "soft_shadows/solid_angle", solidAngleDefines(settings)),
        settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    VisibilityTechnique::prepare(frame);
    // The same area as the light.
    lightRadius_ = std::sqrt(frame.scene().lights.at(0).area() * std::numbers::inv_pi);
    if (const auto* taps = std::get_if<GaussianTaps>(&settings_.sampling)) {
      tapBuffer_.emplace(gaussianTaps(taps->taps * taps->taps, taps->sigma, taps->seed));
      frame.passes().setBytesHeld("soft_shadows/solid_angle_taps", tapBuffer_->bytes());
    }
  }

 protected:
  const frame::LightFrustum& bindMap(frame::Frame& frame) override {
    maxIterations_ = maxIterations(frame);
    return bindPyramid(frame);
  }

  void configure(const gl::Program& program) const override {
    program.set("levels", pyramidLevels());
    program.set("refinements", settings_.refinements);
    program.set("maxIterations", maxIterations_);
    program.set("lightRadius", static_cast<float>(lightRadius_));
    if (const auto* regular = std::get_if<RegularTaps>(&settings_.sampling))
      program.set("taps", regular->taps);
    if (const auto* random = std::get_if<GaussianTaps>(&settings_.sampling))
      program.set("taps", random->taps);
    if (tapBuffer_) tapBuffer_->bindStorage(kSolidAngleTapsBuffer);
  }

 private:
  SolidAngleSettings settings_;
  int maxIterations_ = 0;
  double lightRadius_ = 0.0;
  std::optional<gl::Buffer> tapBuffer_;
};

const RegisteredTechnique<SolidAngle> kSolidAngleRegistered{
    {.name = "soft_shadows/solid_angle",
     .version = 1,
     .summary = "Solid angles of balls around micropatches, summed within the cone to a ball-shaped light",
     .source = "Schwarz 2009, section 3.2.1 (SS-07)",
     .product = ProductKind::Visibility,
     .needs = {"area_light"},
     .counters = VisibilityTechnique::quantities()}};

}  // namespace
}  // namespace limen::techniques
