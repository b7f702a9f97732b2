// SPDX-License-Identifier: BSD-3-Clause
// Soft shadows by cone culling (SS-07): a ball in place of the light, balls around the micropatches, of which
// those within the cone to the light add their solid angles, relative to the light's. Source: Schwarz 2009,
// section 3.2.1 (after Bavoil and Silva 2006); all formulas reconstructed.
//
// The thesis names regular and Gaussian Poisson subsampling of the search area. A tap stands here for the
// part of the area that is nearest to it, so that its ball grows as taps become fewer.
#include <cmath>
#include <numbers>
#include <optional>

#include "experiments/base/error.h"
#include "renderer/gl/buffer.h"
#include "renderer/techniques/soft_shadows/solid_angle/gaussian_taps.h"
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

constexpr int64_t kDefaultAreaTaps = 16, kDefaultTapSeed = 1;
constexpr double kDefaultSigma = 0.3;

gl::ShaderDefines solidAngleDefines(const ParameterValues& values) {
  const std::string& sampling = values.text("sampling");
  gl::ShaderDefines defines = {{"SAMPLING", sampling == "all" ? "0" : sampling == "regular" ? "1" : "2"}};
  if (values.text("ball") == "equal_area") defines["EQUAL_AREA"] = "1";
  return defines;
}

void checkSolidAngle(const ParameterValues& values) {
  const std::string& sampling = values.text("sampling");
  if (sampling == "all" && values.integer("taps") != kDefaultAreaTaps)
    throw Error("'taps' is about subsampling, and all texels are taken", "taps",
                "leave it out, or give sampling: regular or gaussian_poisson");
  if (sampling != "gaussian_poisson" &&
      (values.real("sigma") != kDefaultSigma || values.integer("tap_seed") != kDefaultTapSeed))
    throw Error("'sigma' and 'tap_seed' are about Gaussian Poisson taps, and there are none", "sigma",
                "leave them out, or give sampling: gaussian_poisson");
}

class SolidAngle : public VisibilityTechnique {
 public:
  explicit SolidAngle(const ParameterValues& values)
      : VisibilityTechnique(values, "renderer/techniques/soft_shadows/solid_angle/solid_angle.comp.glsl",
                            "soft_shadows/solid_angle", solidAngleDefines(values)),
        gaussian_(values.text("sampling") == "gaussian_poisson"),
        taps_(static_cast<int>(values.integer("taps"))),
        refinements_(static_cast<int>(values.integer("refinements"))),
        sigma_(values.real("sigma")),
        seed_(values.integer("tap_seed")) {
    checkSolidAngle(values);
  }

  void prepare(frame::Frame& frame) override {
    VisibilityTechnique::prepare(frame);
    // As much area as the light has.
    lightRadius_ = std::sqrt(frame.scene().lights.at(0).area() * std::numbers::inv_pi);
    if (gaussian_) {
      tapBuffer_.emplace(gaussianTaps(taps_ * taps_, sigma_, seed_));
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
    program.set("refinements", refinements_);
    program.set("taps", taps_);
    program.set("maxIterations", maxIterations_);
    program.set("lightRadius", static_cast<float>(lightRadius_));
    if (tapBuffer_) tapBuffer_->bindStorage(0);
  }

 private:
  bool gaussian_;
  int taps_, refinements_, maxIterations_ = 0;
  double sigma_, lightRadius_ = 0.0;
  int64_t seed_;
  std::optional<gl::Buffer> tapBuffer_;
};

std::vector<Parameter> solidAngleParameters() {
  std::vector<Parameter> all = VisibilityTechnique::commonParameters(2.0);
  all.push_back(integerParameter("refinements", 2, 0, 3, "",
                                 "Times that the search area is narrowed by its depth range",
                                 "Schwarz 2009, section 4.1"));
  all.push_back(choiceParameter("sampling", "regular", {"all", "regular", "gaussian_poisson"},
                                "Texels of the search area that are read: all, those on a regular grid, or "
                                "those at random places, denser towards the middle",
                                "Schwarz 2009, section 3.2.1"));
  all.push_back(
      integerParameter("taps", kDefaultAreaTaps, 1, 64, "", "Root of the number of taps in the search area"));
  all.push_back(choiceParameter("ball", "bounding", {"bounding", "equal_area"},
                                "Ball in place of a micropatch: around it, or with a disc of its area",
                                "Schwarz 2009, section 3.2.1 (bounding)"));
  all.push_back(realParameter("sigma", kDefaultSigma, 0.1, 10.0, "",
                              "Deviation of Gaussian Poisson taps as a share of the search area's side"));
  all.push_back(
      integerParameter("tap_seed", kDefaultTapSeed, 0, 1000000, "", "Seed of Gaussian Poisson taps"));
  return all;
}

const Registered<TechniqueInfo> kSolidAngleRegistered{
    {.name = "soft_shadows/solid_angle",
     .version = 1,
     .summary = "Solid angles of balls around micropatches, summed within the cone to a ball-shaped light",
     .source = "Schwarz 2009, section 3.2.1 (SS-07)",
     .product = ProductKind::Visibility,
     .parameters = solidAngleParameters(),
     .needs = {"area_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<SolidAngle>(values); },
     .errorBound = {},
     .counters = VisibilityTechnique::counterNames(),
     .check = checkSolidAngle}};

}  // namespace
}  // namespace limen::techniques
