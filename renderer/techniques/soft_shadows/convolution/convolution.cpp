// SPDX-License-Identifier: BSD-3-Clause
// Convolution shadow map (SS-03): a truncated Fourier series of the comparison's step, whose terms split into
// factors of the texel and of the receiver, so that averages of the former are enough. The same series, times
// the depth, gives the blockers' average without a search. Source: Schwarz 2009, section 3.2.1 (after Annen
// et al. 2007 and 2008; the formulas are not given there).
//
// The step is blurred over 1 / M of the depths that the series spans, and rings: occluders so close are lost,
// and light leaks by up to 9 % of what is blocked.
#include "experiments/base/error.h"
#include "renderer/techniques/soft_shadows/prefiltered_technique.h"

namespace limen::techniques {
namespace {

constexpr double kDefaultThreshold = 0.05;

frame::PrefilterSettings fourierSettings(const ParameterValues& values) {
  frame::PrefilterSettings settings = PrefilteredTechnique::settingsOf(values);
  settings.basis = frame::DepthBasis::Fourier;
  settings.terms = static_cast<int>(values.integer("terms"));
  settings.periodShare = values.real("period_share");
  settings.withDepths = values.text("window") == "convolved";
  return settings;
}

void checkConvolution(const ParameterValues& values) {
  PrefilteredTechnique::checkPrefilter(values);
  if (values.text("window") != "convolved" && values.real("search_threshold") != kDefaultThreshold)
    throw Error("'search_threshold' is about a convolved search, and there is none", "search_threshold",
                "leave it out, or give window: convolved");
}

class Convolution : public PrefilteredTechnique {
 public:
  explicit Convolution(const ParameterValues& values)
      : PrefilteredTechnique(values, "convolution", fourierSettings(values)),
        shift_(values.real("shift")),
        threshold_(values.real("search_threshold")) {
    checkConvolution(values);
  }

 protected:
  void configure(const gl::Program& program) const override {
    PrefilteredTechnique::configure(program);
    program.set("shift", static_cast<float>(shift_));
    program.set("searchThreshold", static_cast<float>(threshold_));
  }

 private:
  double shift_, threshold_;
};

std::vector<Parameter> convolutionParameters() {
  std::vector<Parameter> all =
      PrefilteredTechnique::prefilterParameters({"searched", "convolved", "fixed"}, {"sums", "mips"});
  // A texture a term: 64 MiB for eight of them at 1024 x 1024.
  for (Parameter& parameter : all)
    if (parameter.name == "resolution") parameter.defaultValue = std::string("256");
  all.push_back(integerParameter("terms", 8, 4, 16, "", "Terms of the series (M), a texture each",
                                 "Schwarz 2009, section 3.2.1 (value not given there)"));
  all.push_back(realParameter(
      "period_share", 0.875, 0.5, 1.0, "",
      "Share of half the series' period that depths from 0 to 1 span; near 1 the step at its end "
      "lets through what is far before the receiver"));
  all.push_back(
      realParameter("shift", 1.0, 0.0, 4.0, "",
                    "How far the receiver is moved towards the light, in units of 1 / 2M of half the period, "
                    "where the series peaks"));
  all.push_back(
      realParameter("search_threshold", kDefaultThreshold, 0.001, 0.5, "",
                    "Share of a convolved search's window that must block before there is a blocker"));
  return all;
}

const Registered<TechniqueInfo> kConvolutionRegistered{PrefilteredTechnique::declare(
    "soft_shadows/convolution", 1,
    "Convolution shadow map: averaged terms of a Fourier series of the comparison", convolutionParameters(),
    [](const ParameterValues& values) { return std::make_unique<Convolution>(values); }, checkConvolution)};

}  // namespace
}  // namespace limen::techniques
