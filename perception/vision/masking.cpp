// SPDX-License-Identifier: BSD-3-Clause
#include "perception/vision/masking.h"

#include <algorithm>
#include <cmath>

namespace limen::perception {
namespace {

// Below this contrast an elevation derived from a transducer is held constant: that of Lubin, whose slope is
// 0 at 0, would grow without bound.
constexpr double kLeastContrast = 1e-6;

// (1 + x^b)^(1/b) for x >= 0 where x^b may overflow.
double softMaximum(double x, double b) {
  return x > 1.0 ? x * std::pow(1.0 + std::pow(x, -b), 1.0 / b) : std::pow(1.0 + std::pow(x, b), 1.0 / b);
}

double withSign(double magnitude, double sign) { return std::copysign(magnitude, sign); }

bool refused(double c) { return !std::isfinite(c); }

}  // namespace

double elevationDaly(double c, double k1, double k2, double b, double s) {
  if (refused(c)) return 0.0;
  // (k2 c)^s apart, for a product that overflows.
  return softMaximum(k1 * std::pow(k2, s) * std::pow(std::abs(c), s), b);
}

double transducerDaly(double c, double k1, double k2, double b, double s) {
  return refused(c) ? 0.0 : c / elevationDaly(c, k1, k2, b, s);
}

double transducerLubin(double c, double n, double w) {
  if (refused(c) || c == 0.0) return 0.0;
  const double x = std::abs(c);
  return withSign(x > 1.0 ? 2.0 * std::pow(x, w) / (1.0 + std::pow(x, w - n))
                          : 2.0 * std::pow(x, n) / (std::pow(x, n - w) + 1.0),
                  c);
}

double selfMask(double c, double alpha) {
  if (refused(c) || c == 0.0) return 0.0;
  return withSign(std::pow(std::abs(c), alpha), c);
}

double pointwiseExtendedMask(double x, double neighbourMean, double alpha, double a) {
  // An infinite neighbour masks everything, and so does NaN: better masked than propagated.
  if (refused(neighbourMean)) return 0.0;
  return selfMask(x, alpha) / (1.0 + a * std::max(neighbourMean, 0.0));
}

double elevationSchwarz(double c) { return refused(c) ? 0.0 : softMaximum(std::pow(std::abs(c), 0.3), 10.0); }

double transducerSchwarz(double c) { return refused(c) ? 0.0 : c / elevationSchwarz(c); }

Masking makeMasking(const ChosenEntry& chosen, const std::string& where) {
  return MaskingRegistry::instance().get(chosen.name, where).make(completeValues<MaskingInfo>(chosen, where));
}

Masking makeMasking(const std::string& name, const std::string& where) {
  return makeMasking(ChosenEntry{name, {}}, where);
}

bool isCubic(const ChosenEntry& masking) {
  if (masking.name != "schwarz") return false;
  const auto constants = SchwarzMasking::table().read(completeValues<MaskingInfo>(masking));
  return constants.b == 10.0 && constants.s == 0.3;
}

namespace {

const char* const kThesis = "Schwarz 2009, section 9.1.2";

}  // namespace

const SettingsTable<NoMasking>& NoMasking::table() {
  static const SettingsTable<NoMasking> kTable = {};
  return kTable;
}

const SettingsTable<DalyMasking>& DalyMasking::table() {
  using S = DalyMasking;
  static const SettingsTable<S> kTable = {
      {&S::k1, "k1", {1e-6, 1e3}, "", "with k2, the contrast at which masking sets in", kThesis},
      {&S::k2, "k2", {1e-6, 1e6}, "", "with k1, the contrast at which masking sets in", kThesis},
      {&S::b, "b", {0.1, 100.0}, "", "sharpness of the onset of masking", kThesis},
      {&S::s, "s", {0.0, 1.0}, "", "slope of lg elevation over lg contrast; 0.65 to 1 in use", kThesis}};
  return kTable;
}

const SettingsTable<LubinMasking>& LubinMasking::table() {
  using S = LubinMasking;
  static const SettingsTable<S> kTable = {
      {&S::n, "n", {1.0, 4.0}, "", "exponent at low contrast; 2 to 2.5 published", kThesis},
      {&S::w, "w", {0.0, 0.99}, "", "exponent at high contrast", kThesis}};
  return kTable;
}

const SettingsTable<SelfMasking>& SelfMasking::table() {
  static const SettingsTable<SelfMasking> kTable = {
      {&SelfMasking::alpha, "alpha", {0.05, 1.0}, "", "exponent; 0.7 in the thesis, 0.3 elsewhere", kThesis}};
  return kTable;
}

const SettingsTable<SchwarzMasking>& SchwarzMasking::table() {
  using S = SchwarzMasking;
  static const SettingsTable<S> kTable = {
      {&S::b, "b", {0.1, 100.0}, "", "sharpness of the onset of masking", kThesis},
      {&S::s, "s", {0.0, 1.0}, "", "slope of lg elevation over lg contrast", kThesis}};
  return kTable;
}

namespace {

const RegisteredMasking<NoMasking> kNone{
    {.name = "none", .summary = "No masking: the response is the contrast.", .source = ""},
    [](const NoMasking&) {
      return Masking{[](double c) { return refused(c) ? 0.0 : 1.0; },
                     [](double c) { return refused(c) ? 0.0 : c; }};
    }};

const RegisteredMasking<DalyMasking> kDaly{
    {.name = "daly",
     .summary = "Threshold elevation (1 + (k1 (k2 c)^s)^b)^(1/b); 1 at low contrast, c^s at high.",
     .source = "Daly 1993; Schwarz 2009, (9.7)"},
    [](const DalyMasking& k) {
      return Masking{[k](double c) { return elevationDaly(c, k.k1, k.k2, k.b, k.s); },
                     [k](double c) { return transducerDaly(c, k.k1, k.k2, k.b, k.s); }};
    }};

const RegisteredMasking<LubinMasking> kLubin{
    {.name = "lubin",
     .summary =
         "Transducer 2 c^n / (c^(n-w) + 1): facilitates near threshold. The elevation c / transducer, which "
         "grows without bound towards c = 0, is held below 1e-6.",
     .source = "Lubin 1995; Schwarz 2009, (9.8)"},
    [](const LubinMasking& k) {
      return Masking{[k](double c) {
                       if (refused(c)) return 0.0;
                       const double x = std::max(std::abs(c), kLeastContrast);
                       return x / transducerLubin(x, k.n, k.w);
                     },
                     [k](double c) { return transducerLubin(c, k.n, k.w); }};
    }};

const RegisteredMasking<SelfMasking> kSelf{
    {.name = "self",
     .summary =
         "Self-masking of JPEG 2000: sign(c) |c|^alpha. Its elevation |c|^(1 - alpha) is below 1 for c < 1.",
     .source = "Zeng, Daly and Lei 2002; Schwarz 2009, section 9.1.2"},
    [](const SelfMasking& k) {
      return Masking{[k](double c) { return refused(c) ? 0.0 : std::pow(std::abs(c), 1.0 - k.alpha); },
                     [k](double c) { return selfMask(c, k.alpha); }};
    }};

const RegisteredMasking<SchwarzMasking> kSchwarz{
    {.name = "schwarz",
     .summary = "Transducer c / (1 + |c|^(s b))^(1/b): the identity at low contrast, |c|^(1 - s) at high.",
     .source = "Schwarz 2009, (9.9)"},
    [](const SchwarzMasking& k) {
      // (9.9) is (9.7) with k1 = k2 = 1.
      return Masking{[k](double c) { return elevationDaly(c, 1.0, 1.0, k.b, k.s); },
                     [k](double c) { return transducerDaly(c, 1.0, 1.0, k.b, k.s); }};
    }};

}  // namespace
}  // namespace limen::perception
