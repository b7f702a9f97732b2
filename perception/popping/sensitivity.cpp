// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "perception/vision/adaptation.h"
#include "perception/vision/csf_models.h"

namespace limen::perception {
namespace {

constexpr double kLowLuminance = 1e-4, kHighLuminance = 1e4;
constexpr double kLowVelocity = 1e-3, kHighVelocity = 1e3;
constexpr double kTolerance = 1e-8;

bool reads(const std::string& model, const std::string& argument) {
  const std::vector<CsfArgument>& arguments = CsfRegistry::instance().get(model).arguments;
  return std::any_of(arguments.begin(), arguments.end(),
                     [&](const CsfArgument& one) { return one.name == argument; });
}

bool sameModel(const ChosenEntry& a, const ChosenEntry& b) {
  return a.name == b.name && Kelly83Scale::of(a).referenceCdM2 == Kelly83Scale::of(b).referenceCdM2;
}

/// Mechanisms of a castleCSF that add up; none if `name` is another model.
std::vector<CastleMechanism> castleMechanisms(const std::string& name) {
  using enum CastleMechanism;
  if (name == "castlecsf") return {Sustained, Transient};
  if (name == "castlecsf_sustained") return {Sustained};
  if (name == "castlecsf_transient") return {Transient};
  if (name == "castlecsf_rg") return {RedGreen};
  if (name == "castlecsf_yv") return {YellowViolet};
  return {};
}

/// daly98C0() and daly98C1() over luminance, with the peak at the reference luminance found once. Kept for
/// the next comparison at the same size: they take longer to make than a small picture to compare.
std::pair<FineTable, FineTable> dalyTables(double area) {
  constexpr size_t kKept = 64;
  static std::mutex guard;
  static std::map<double, std::pair<FineTable, FineTable>> kept;
  const std::scoped_lock lock(guard);
  if (const auto found = kept.find(area); found != kept.end()) return found->second;
  if (kept.size() >= kKept) kept.clear();
  constexpr double kReferenceCdM2 = 100.0;
  const Csf::Peak peak = barten03Peak(kReferenceCdM2, area);
  const double c0 = daly98C0(kReferenceCdM2, area) / peak.sensitivity;
  const double c1 = daly98C1(kReferenceCdM2, area) * peak.frequencyCpd;
  const auto table = [](std::function<double(double)> of) {
    return FineTable(std::move(of), kLowLuminance, kHighLuminance, 256);
  };
  return kept[area] = {table([=](double l) { return c0 * barten03Peak(l, area).sensitivity; }),
                       table([=](double l) { return c1 / barten03Peak(l, area).frequencyCpd; })};
}

double finiteOrZero(double value) { return std::isfinite(value) && value > 0.0 ? value : 0.0; }

}  // namespace

FineTable::FineTable(std::function<double(double)> function, double low, double high, int cells)
    : function_(std::move(function)),
      lnLow_(std::log(low)),
      perLn_(cells / (std::log(high) - std::log(low))),
      cells_(cells),
      direct_(static_cast<size_t>(cells), 0) {
  const auto at = [&](double cell) { return function_(std::exp(lnLow_ + cell / perLn_)); };
  for (int i = -1; i <= cells + 1; ++i) values_.push_back(at(i));
  for (int cell = 0; cell < cells; ++cell)
    for (const double t : {0.25, 0.5, 0.75}) {
      const double exact = at(cell + t);
      if (!(std::abs(interpolated(cell, t) - exact) <= kTolerance * exact)) direct_[cell] = 1;
    }
}

double FineTable::interpolated(int cell, double t) const {
  // Lagrange's polynomial through the four nodes at -1, 0, 1, 2.
  const double* v = values_.data() + cell;
  const double a = t + 1.0, b = t - 1.0, c = t - 2.0;
  return -t * b * c / 6.0 * v[0] + a * b * c / 2.0 * v[1] - a * t * c / 2.0 * v[2] + a * t * b / 6.0 * v[3];
}

double FineTable::operator()(double x) const {
  if (!(x > 0.0)) return function_(x);
  const double place = (std::log(x) - lnLow_) * perLn_;
  if (!(place >= 0.0 && place < cells_)) return function_(x);
  const int cell = static_cast<int>(place);
  return direct_[static_cast<size_t>(cell)] ? function_(x) : interpolated(cell, place - cell);
}

CsfPoint viewingPoint(double areaDeg2, double widthDeg, const DisplayProfile& display) {
  CsfPoint point;
  point.areaDeg2 = areaDeg2;
  point.widthDeg = widthDeg;
  point.distanceM = display.distanceM;
  return point;
}

std::array<double, 3> calibration(const PoppingSettings& settings, const CsfPoint& viewing) {
  const auto scale = [&](const auto& channel) {
    if (std::holds_alternative<AbsoluteScale>(channel.scale)) return 1.0;
    const auto& reference = std::get<1>(channel.scale);
    const std::string& model = channel.csf.name;
    CsfPoint point = viewing;
    point.velocityDegS = reference.velocityDegS;
    point.luminanceCdM2 = reference.luminanceCdM2;
    const double peak = makeCsf(model, "popping")->peak(point).sensitivity;
    if (!(peak > 0.0) || !std::isfinite(peak))
      throw Error("sensitivity '" + model + "' has no peak at the calibration's velocity and luminance",
                  "popping", "choose another velocity_deg_s or luminance_cd_m2 of its scale");
    return 1.0 / (reference.threshold * peak);
  };
  return {scale(settings.sensitivity.achromatic), scale(settings.sensitivity.redGreen),
          scale(settings.sensitivity.blueYellow)};
}

Sensitivity::Sensitivity(const PoppingModel& model, const DisplayProfile& display,
                         const PoppingSettings& settings, bool tables)
    : peakCpd_(model.peakCpd),
      viewing_(viewingPoint(model.areaDeg2, model.widthDeg, display)),
      oneChromatic_(sameModel(settings.sensitivity.redGreen.csf, settings.sensitivity.blueYellow.csf)) {
  if (tables) std::tie(c0_, c1_) = dalyTables(viewing_.areaDeg2);
  channels_ = {makeChannel(settings.sensitivity.achromatic.csf, model.scaleA, tables),
               makeChannel(settings.sensitivity.redGreen.csf, model.scaleRg, tables),
               makeChannel(settings.sensitivity.blueYellow.csf, model.scaleBy, tables)};
  if (settings.bands.isFitted()) fitWeights(model, display, settings);
}

void Sensitivity::fitWeights(const PoppingModel& model, const DisplayProfile& display,
                             const PoppingSettings& settings) {
  constexpr double kSlowest = 0.1, kFastest = 64.0, kDarkest = 0.01;
  BandWeights::Setup setup;
  setup.bands = settings.bands;
  setup.minkowskiExponent = settings.minkowskiExponent;
  setup.pixelsPerDegree = model.pixelsPerDegree;
  setup.peakCpd = model.peakCpd;
  setup.velocityDegS = {kSlowest, kFastest};
  const auto* fixed = std::get_if<FixedAdaptation>(&settings.adaptation);
  const double darkest = std::max(kDarkest, fixed ? fixed->luminanceCdM2 : display.blackLevelCdM2());
  setup.luminanceCdM2 = {darkest, fixed ? 1.01 * darkest : std::max(display.peakCdM2, 2.0 * darkest)};
  const SensitivitySettings& s = settings.sensitivity;
  const ChosenEntry* const entries[] = {&s.achromatic.csf, &s.redGreen.csf, &s.blueYellow.csf};
  for (size_t c = 0; c < 3; ++c) {
    std::string key = entries[c]->name;
    for (const double value : {channels_[c].scale, viewing_.areaDeg2, viewing_.widthDeg, viewing_.distanceM,
                               Kelly83Scale::of(*entries[c]).referenceCdM2})
      key += "|" + shortestNumber(value);
    weights_[c] = bandWeights(setup, key, [&](double cpd, double velocity, double luminance) {
      CsfPoint point = viewing_;
      point.frequencyCpd = cpd;
      point.velocityDegS = velocity;
      point.luminanceCdM2 = luminance;
      return channels_[c].scale * finiteOrZero(channels_[c].csf->sensitivity(point));
    });
  }
}

Sensitivity::PartWeights Sensitivity::weights(int level, double velocityDegS, double luminanceCdM2) const {
  PartWeights out;
  out.peak = at(level, velocityDegS, luminanceCdM2);
  for (size_t c = 0; c < 3; ++c) {
    out.peak[c] = std::max(out.peak[c], BandWeights::kLeastSensitivity);
    const auto relative = weights_[c]->at(level, velocityDegS, luminanceCdM2);
    for (size_t k = 0; k < kBandParts; ++k) out.relative[k][c] = relative[k];
  }
  return out;
}

Sensitivity::Channel Sensitivity::makeChannel(const ChosenEntry& entry, double scale, bool tables) const {
  Channel channel;
  const std::string& name = entry.name;
  const double reference = Kelly83Scale::of(entry).referenceCdM2;
  const CsfInfo& info = CsfRegistry::instance().get(name, "popping");
  std::map<std::string, ParameterValue> given;
  if (name == "kelly83") given["reference_luminance"] = reference;
  channel.csf = info.make(ParameterValues(info.parameters, given, "popping"));
  channel.scale = scale;
  if (!tables) return channel;
  const bool velocity = reads(name, "velocity_deg_s"), luminance = reads(name, "luminance_cd_m2");
  if (name == "daly98") {
    channel.kind = Channel::Kind::Daly98;
    return channel;
  }
  if (name == "kelly83") {
    channel.kind = Channel::Kind::Kelly83;
    channel.luminanceScale = FineTable([reference](double l) { return chromaticScale(l, reference); },
                                       kLowLuminance, kHighLuminance, 1024);
  } else if (const std::vector<CastleMechanism> mechanisms = castleMechanisms(name); !mechanisms.empty()) {
    channel.kind = Channel::Kind::Castle;
    const double area = viewing_.areaDeg2;
    for (const CastleMechanism mechanism : mechanisms) {
      Channel::Product product{mechanism, {}, {}};
      for (const double cpd : peakCpd_) {
        product.luminance.emplace_back([=](double l) { return castleSpatial(mechanism, cpd, l, area); },
                                       kLowLuminance, kHighLuminance, 1024);
        if (mechanism != CastleMechanism::Transient)
          product.velocity.emplace_back([=](double v) { return castleTemporal(mechanism, cpd * v, 1.0); },
                                        kLowVelocity, kHighVelocity, 2048);
      }
      channel.products.push_back(std::move(product));
    }
    return channel;
  } else if (velocity && luminance) {
    return channel;
  } else {
    channel.kind = velocity ? Channel::Kind::Velocity : Channel::Kind::Luminance;
  }
  for (const double cpd : peakCpd_) {
    if (channel.kind == Channel::Kind::Kelly83) {
      channel.byLevel.emplace_back([cpd](double v) { return csfKelly83(cpd, v); }, kLowVelocity,
                                   kHighVelocity, 4096);
      continue;
    }
    CsfPoint point = viewing_;
    point.frequencyCpd = cpd;
    const std::shared_ptr<const Csf> csf = channel.csf;
    if (channel.kind == Channel::Kind::Velocity)
      channel.byLevel.emplace_back(
          [csf, point](double v) {
            CsfPoint at = point;
            at.velocityDegS = v;
            return csf->sensitivity(at);
          },
          kLowVelocity, kHighVelocity, 4096);
    else
      channel.byLevel.emplace_back(
          [csf, point](double l) {
            CsfPoint at = point;
            at.luminanceCdM2 = l;
            return csf->sensitivity(at);
          },
          kLowLuminance, kHighLuminance, 2048);
  }
  return channel;
}

double Sensitivity::evaluate(const Channel& channel, int level, double velocityDegS,
                             double luminanceCdM2) const {
  const auto i = static_cast<size_t>(level);
  switch (channel.kind) {
    case Channel::Kind::Daly98: {
      const double l = std::clamp(luminanceCdM2, kLowLuminance, kHighLuminance);
      return csfDaly98(peakCpd_[i], velocityDegS, c0_(l), c1_(l));
    }
    case Channel::Kind::Kelly83:
      return channel.luminanceScale(luminanceCdM2) * channel.byLevel[i](velocityDegS);
    case Channel::Kind::Velocity:
      return channel.byLevel[i](velocityDegS);
    case Channel::Kind::Luminance:
      return channel.byLevel[i](luminanceCdM2);
    case Channel::Kind::Castle: {
      double sum = 0.0;
      for (const Channel::Product& product : channel.products)
        sum += product.luminance[i](luminanceCdM2) *
               (product.velocity.empty()
                    ? castleTemporal(product.mechanism, peakCpd_[i] * velocityDegS, luminanceCdM2)
                    : product.velocity[i](velocityDegS));
      return sum;
    }
    case Channel::Kind::Direct:
      break;
  }
  CsfPoint point = viewing_;
  point.frequencyCpd = peakCpd_[i];
  point.velocityDegS = velocityDegS;
  point.luminanceCdM2 = luminanceCdM2;
  return channel.csf->sensitivity(point);
}

std::array<double, 3> Sensitivity::at(int level, double velocityDegS, double luminanceCdM2) const {
  std::array<double, 3> out{};
  for (size_t c = 0; c < 3; ++c)
    out[c] = c == 2 && oneChromatic_
                 ? out[1]
                 : finiteOrZero(evaluate(channels_[c], level, velocityDegS, luminanceCdM2));
  for (size_t c = 0; c < 3; ++c) out[c] *= channels_[c].scale;
  return out;
}

}  // namespace limen::perception
