// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/color_video_vdp/parameters.h"

#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

namespace limen::embedded {
extern const char* const kCvvdpParameters;
}

namespace limen::perception::cvvdp {
namespace {

Parameters readParameters() {
  const nlohmann::json file = nlohmann::json::parse(embedded::kCvvdpParameters);
  assert(file.at("masking_model") == "mult-mutual" && file.at("contrast") == "weber_g1" &&
         file.at("csf") == "weber_fixed_size" && file.at("dclamp_type") == "soft");
  const auto number = [&](const char* key) { return file.at(key).get<double>(); };
  const auto channels = [&](const char* key) { return file.at(key).get<Channels>(); };
  Parameters out{};
  out.maskExponent = number("mask_p");
  out.maskerExponent = channels("mask_q");
  out.maskScale = std::pow(10.0, number("mask_c"));
  const auto weights = file.at("xcm_weights").get<std::array<double, kChannels * kChannels>>();
  for (size_t masker = 0; masker < kChannels; ++masker)
    for (size_t masked = 0; masked < kChannels; ++masked)
      out.crossMasking[masker][masked] = std::exp2(weights[kChannels * masker + masked]);
  out.largestDifference = std::pow(10.0, number("d_max"));
  out.sensitivityFactor = std::pow(10.0, number("sensitivity_correction") / 20.0);
  out.pixelExponent = number("beta");
  out.bandExponent = number("beta_sch");
  out.channelExponent = number("beta_tch");
  out.frameExponent = number("beta_t");
  out.channelWeight = {1.0, number("ch_chrom_w"), number("ch_chrom_w"), number("ch_trans_w")};
  out.baseBandWeight = channels("baseband_weight");
  out.imageFactor = number("image_int");
  out.jodFactor = number("jod_a");
  out.jodExponent = number("jod_exp");
  out.temporalSigma = channels("sigma_tf");
  out.temporalBeta = channels("beta_tf");
  out.blurSigma = number("pu_dilate");
  return out;
}

}  // namespace

const Parameters& parameters() {
  static const Parameters kParameters = readParameters();
  return kParameters;
}

double offsetPower(double x, double exponent) {
  const double offset = parameters().powerOffset;
  return std::pow(x + offset, exponent) - std::pow(offset, exponent);
}

}  // namespace limen::perception::cvvdp
