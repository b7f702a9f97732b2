// SPDX-License-Identifier: BSD-3-Clause
// Convolution shadow map (SS-03): a truncated Fourier series of the comparison's step, whose terms split into
// factors of the texel and of the receiver, so that averages of the former are enough. The same series, times
// the depth, gives the blockers' average without a search. Source: Schwarz 2009, section 3.2.1 (after Annen
// et al. 2007 and 2008; the formulas are not given there).
//
// The step is blurred over 1 / M of the depths that the series spans, and rings: occluders that close are
// lost, and light leaks by up to 9 % of what is blocked.
#include "renderer/techniques/soft_shadows/prefiltered_technique.h"

namespace limen::techniques {
namespace {

struct ConvolutionSettings {
  // One texture per term: 64 MiB for eight of them at 1024 x 1024.
  PrefilteredSettings common{.map = {.resolution = 256}};
  AnyWindow window;
  int terms = 8;
  double periodShare = 0.875, shift = 1.0;
  static const SettingsTable<ConvolutionSettings>& table() {
    using S = ConvolutionSettings;
    static const SettingsTable<S> kTable = {
        included(&S::common),
        windowBinding(&S::window),
        {&S::terms,
         "terms",
         {4, 16},
         "",
         "Terms of the series (M), one texture each",
         "Schwarz 2009, section 3.2.1 (value not given there)"},
        {&S::periodShare,
         "period_share",
         {0.5, 1},
         "",
         "Share of half the series' period that depths from 0 to 1 span; near 1 the step at its end lets "
         "through occluders far in front of the receiver"},
        {&S::shift,
         "shift",
         {0, 4},
         "",
         "Distance that the receiver is moved towards the light, in units of 1 / 2M of half the period, "
         "where the "
         "series peaks"}};
    return kTable;
  }

  frame::PrefilterSettings prefilterSettings() const {
    frame::PrefilterSettings settings = common.prefilterSettings();
    settings.basis = frame::DepthBasis::Fourier;
    settings.terms = terms;
    settings.periodShare = periodShare;
    settings.withDepths = std::holds_alternative<ConvolvedWindow>(window);
    return settings;
  }
};

class Convolution : public PrefilteredTechnique {
 public:
  using Settings = ConvolutionSettings;
  explicit Convolution(const ConvolutionSettings& settings)
      : PrefilteredTechnique("convolution", settings.common, settings.window, settings.prefilterSettings()),
        shift_(settings.shift) {}

 protected:
  void configure(const gl::Program& program) const override {
    PrefilteredTechnique::configure(program);
    program.set("shift", static_cast<float>(shift_));
  }

 private:
  double shift_;
};

const RegisteredTechnique<Convolution> kConvolutionRegistered{PrefilteredTechnique::info(
    "soft_shadows/convolution",
    "Convolution shadow map: averaged terms of a Fourier series of the comparison")};

}  // namespace
}  // namespace limen::techniques
