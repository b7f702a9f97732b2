// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/prefiltered_settings.h"

#include "experiments/base/error.h"

namespace limen::techniques {
namespace {

constexpr const char* kScaleText = "Window of the blocker search as a share of the light's extents";

const FixedSums* fixedSums(const PrefilteredSettings& settings) {
  const auto* sums = std::get_if<SumsPrefilter>(&settings.prefilter);
  return sums ? std::get_if<FixedSums>(&sums->form) : nullptr;
}

}  // namespace

const SettingsTable<FixedWindow>& FixedWindow::table() {
  static const SettingsTable<FixedWindow> kTable = {
      Binding(&FixedWindow::radius, "radius", Range{0.5, 256}, "texel", "Half-width of the window")
          .formerly({"filter_radius"})};
  return kTable;
}

const SettingsTable<SearchedWindow>& SearchedWindow::table() {
  static const SettingsTable<SearchedWindow> kTable = {
      Binding(&SearchedWindow::scale, "scale", Range{0.01, 4}, "", kScaleText).formerly({"search_scale"}),
      Binding(&SearchedWindow::taps, "taps", Range{1, 32}, "", "Taps of the blocker search per side")
          .formerly({"search_taps"})};
  return kTable;
}

const SettingsTable<ConvolvedWindow>& ConvolvedWindow::table() {
  static const SettingsTable<ConvolvedWindow> kTable = {
      Binding(&ConvolvedWindow::scale, "scale", Range{0.01, 4}, "", kScaleText),
      Binding(&ConvolvedWindow::threshold, "threshold", Range{0.001, 0.5}, "",
              "Smallest blocking share of the search window that counts as a blocker")
          .formerly({"search_threshold"})};
  return kTable;
}

const SettingsTable<FixedSums>& FixedSums::table() {
  static const SettingsTable<FixedSums> kTable = {
      Binding(&FixedSums::bits, "bits", Range{0, 24}, "bit", "Bits of a value; 0: as many as cannot overflow")
          .formerly({"sum_bits"})};
  return kTable;
}

const SettingsTable<SumsPrefilter>& SumsPrefilter::table() {
  static const SettingsTable<SumsPrefilter> kTable = {
      Binding(&SumsPrefilter::form, "form", "How the sums are stored", "Schwarz 2009, section 3.2.1")
          .formerly({"sums"})};
  return kTable;
}

const SettingsTable<PrefilteredSettings>& PrefilteredSettings::table() {
  using S = PrefilteredSettings;
  static const SettingsTable<S> kTable = {
      included(&S::map),
      Binding(&S::bias, "bias", "Bias that keeps a surface from shadowing itself").shorthand("constant"),
      {&S::prefilter, "prefilter", "Structure for averages", "Schwarz 2009, section 3.2.1"}};
  return kTable;
}

void PrefilteredSettings::check() const {
  const FixedSums* fixed = fixedSums(*this);
  const int limit = frame::sumBits(map.resolution);
  if (!fixed || fixed->bits <= limit) return;
  throw Error("values of " + std::to_string(fixed->bits) + " bits over a map of " +
                  std::to_string(map.resolution) + " texels per side need sums of more than 32 bits",
              "prefilter.form.bits", "give at most " + std::to_string(limit) + ", or a smaller resolution");
}

frame::PrefilterSettings PrefilteredSettings::prefilterSettings() const {
  frame::PrefilterSettings settings;
  settings.map = {map.resolution, map.raster};
  const auto* sums = std::get_if<SumsPrefilter>(&prefilter);
  settings.prefilter = sums ? frame::Prefilter::Sums : frame::Prefilter::Mips;
  if (const FixedSums* fixed = fixedSums(*this)) {
    settings.form = frame::SumForm::Fixed;
    settings.bits = fixed->bits;
  } else if (sums && std::holds_alternative<FloatMeanSums>(sums->form)) {
    settings.form = frame::SumForm::FloatMean;
  }
  return settings;
}

}  // namespace limen::techniques
