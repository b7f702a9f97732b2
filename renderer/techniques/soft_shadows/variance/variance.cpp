// SPDX-License-Identifier: BSD-3-Clause
// Variance shadow map (SS-03): the first two moments of depth, averaged over a window, bound the share of its
// texels that lie beyond the receiver. Exact where a window holds two depths of which the receiver's is the
// farther; an upper bound otherwise, so that light bleeds through where a second occluder lies below a first.
// Source: Schwarz 2009, section 3.2.1 (after Donnelly and Lauritzen 2006; the formula is not given there).
#include "renderer/techniques/soft_shadows/prefiltered_technique.h"

namespace limen::techniques {
namespace {

class Variance : public PrefilteredTechnique {
 public:
  explicit Variance(const ParameterValues& values)
      : PrefilteredTechnique(values, "variance", settingsOf(values)),
        minVariance_(values.real("min_variance")),
        bleedClamp_(values.real("bleed_clamp")) {}

 protected:
  void configure(const gl::Program& program) const override {
    PrefilteredTechnique::configure(program);
    program.set("minVariance", static_cast<float>(minVariance_));
    program.set("bleedClamp", static_cast<float>(bleedClamp_));
  }

 private:
  double minVariance_, bleedClamp_;
};

std::vector<Parameter> varianceParameters() {
  std::vector<Parameter> all =
      PrefilteredTechnique::prefilterParameters({"searched", "fixed"}, {"sums", "mips"});
  all.push_back(realParameter("min_variance", 1e-6, 1e-12, 0.01, "",
                              "Least variance of depth, with depths from 0 to 1 over the map's range",
                              "Schwarz 2009, section 3.2.1 (value not given there)"));
  all.push_back(realParameter(
      "bleed_clamp", 0.0, 0.0, 0.99, "",
      "Visibility that becomes 0, the rest being stretched to 0..1: less light bleeding, darker "
      "penumbrae",
      "Schwarz 2009, section 3.2.1 (reconstructed)"));
  return all;
}

const Registered<TechniqueInfo> kVarianceRegistered{PrefilteredTechnique::declare(
    "soft_shadows/variance", 1, "Variance shadow map: Chebyshev's bound from averaged moments of depth",
    varianceParameters(), [](const ParameterValues& values) { return std::make_unique<Variance>(values); })};

}  // namespace
}  // namespace limen::techniques
