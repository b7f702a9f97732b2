// SPDX-License-Identifier: BSD-3-Clause
#include "vision_vectors.h"

#include <numbers>

#include "perception/multiscale/band_peaks.h"
#include "perception/popping/regions.h"
#include "perception/vision/adaptation.h"
#include "perception/vision/colour.h"
#include "perception/vision/csf.h"
#include "perception/vision/csf_models.h"
#include "perception/vision/display.h"
#include "perception/vision/eye_movement.h"
#include "perception/vision/masking.h"
#include "perception/vision/tvi.h"

namespace limen::perception {
namespace {

using Arguments = std::vector<double>;

DisplayProfile screen(double black, double white) {
  DisplayProfile out;
  out.blackCdM2 = black, out.peakCdM2 = white;
  return out;
}

DisplayProfile screenOfPitch(double distance, double pitch) {
  DisplayProfile out;
  out.distanceM = distance, out.widthM = pitch * out.resolutionPx.x;
  return out;
}

CsfPoint at(double rho, double l, double area = 187.0) {
  CsfPoint out;
  out.frequencyCpd = rho, out.luminanceCdM2 = l, out.areaDeg2 = area;
  return out;
}

Csf::Peak peakOf(const char* model, double l, double area = 187.0) {
  return makeCsf(model)->peak(at(1.0, l, area));
}

}  // namespace

const std::map<std::string, VectorFunction>& vectorFunctions() {
  static const std::map<std::string, VectorFunction> kFunctions = {
      {"srgb_eotf", [](const Arguments& x) { return screen(0.5, 250.0).decode(x[0]); }},
      {"grey_luminance",
       [](const Arguments& x) {
         const DisplayProfile display = screen(x[1], x[2]);
         const double grey = display.decode(x[0]);
         return display.luminanceCdM2({grey, grey, grey});
       }},
      {"ppd_center", [](const Arguments& x) { return screenOfPitch(x[0], x[1]).pixelsPerDegree(); }},
      {"eye_velocity", [](const Arguments& x) { return retinalVelocityDegS(x[0], EyeMovement::Literal); }},
      {"csf_B89", [](const Arguments& x) { return csfBarten89(x[0], x[1]); }},
      {"csf_B89_size", [](const Arguments& x) { return csfBarten89Size(x[0], x[1], x[2]); }},
      {"csf_B03", [](const Arguments& x) { return csfBarten03(x[0], x[1], x[2]); }},
      {"csf_M92_L", [](const Arguments& x) { return csfMartin92Luminance(x[0], x[1]); }},
      {"csf_M92_RG", [](const Arguments& x) { return csfMartin92RedGreen(x[0], x[1]); }},
      {"csf_M92_BY", [](const Arguments& x) { return csfMartin92BlueYellow(x[0], x[1]); }},
      {"csf_Daly93", [](const Arguments& x) { return csfDaly93(x[0], x[1], x[2], x[3], x[4], x[5]); }},
      {"csf_K79", [](const Arguments& x) { return csfKelly79(x[0], x[1]); }},
      {"csf_D98", [](const Arguments& x) { return csfDaly98(x[0], x[1], x[2], x[3], x[4]); }},
      {"peak_rho_D98", [](const Arguments& x) { return daly98PeakFrequencyCpd(x[0], x[1], x[2]); }},
      {"peak_val_D98", [](const Arguments& x) { return daly98PeakSensitivity(x[0], x[1], x[2], x[3]); }},
      {"BK_E", [](const Arguments& x) { return burbeckKellyExcitation(x[0], x[1]); }},
      {"BK_I", [](const Arguments& x) { return burbeckKellyInhibition(x[0], x[1]); }},
      {"csf_BK80", [](const Arguments& x) { return csfBurbeckKelly80(x[0], x[1]); }},
      {"csf_K83", [](const Arguments& x) { return csfKelly83(x[0], x[1]); }},
      {"peak_rho_B89", [](const Arguments& x) { return peakOf("barten89", x[0]).frequencyCpd; }},
      {"peak_val_B89", [](const Arguments& x) { return peakOf("barten89", x[0]).sensitivity; }},
      {"tvi_B89", [](const Arguments& x) { return tviFromCsf(*makeCsf("barten89"), at(1.0, x[0])); }},
      {"peak_rho_B03", [](const Arguments& x) { return peakOf("barten03", x[0], x[1]).frequencyCpd; }},
      {"peak_val_B03", [](const Arguments& x) { return peakOf("barten03", x[0], x[1]).sensitivity; }},
      {"c0", [](const Arguments& x) { return daly98C0(x[0], x[1]); }},
      {"c1", [](const Arguments& x) { return daly98C1(x[0], x[1]); }},
      {"pupil_diameter_mm", [](const Arguments& x) { return pupilDiameterMm(x[0]); }},
      {"retinal_illuminance_td", [](const Arguments& x) { return retinalIlluminanceTd(x[0]); }},
      {"chroma_scale", [](const Arguments& x) { return chromaticScale(x[0], x[1]); }},
      {"tvi_W", [](const Arguments& x) { return tviWard(x[0]); }},
      {"cvi_W", [](const Arguments& x) { return cvi(tviWard(x[0]), x[0]); }},
      {"T_D", [](const Arguments& x) { return elevationDaly(x[0], x[1], x[2], x[3], x[4]); }},
      {"transducer_D", [](const Arguments& x) { return transducerDaly(x[0], x[1], x[2], x[3], x[4]); }},
      {"T_L", [](const Arguments& x) { return transducerLubin(x[0], x[1], x[2]); }},
      {"T_popping", [](const Arguments& x) { return transducerSchwarz(x[0]); }},
      {"elevation_popping", [](const Arguments& x) { return elevationSchwarz(x[0]); }},
      {"self_mask", [](const Arguments& x) { return selfMask(x[0], x[1]); }},
      {"pw_ext_mask", [](const Arguments& x) { return pointwiseExtendedMask(x[0], x[1], x[2], x[3]); }},
      {"F_orig", [](const Arguments& x) { return frequencyFactorOriginal(x[0]); }},
      {"F_actualL", [](const Arguments& x) { return frequencyFactorActual(x[0], x[1]); }},
      {"hpe_L",
       [](const Arguments& x) {
         return lmsFromXyz({x[0], x[1], x[2]}).x;
       }},
      {"hpe_M",
       [](const Arguments& x) {
         return lmsFromXyz({x[0], x[1], x[2]}).y;
       }},
      {"hpe_S",
       [](const Arguments& x) {
         return lmsFromXyz({x[0], x[1], x[2]}).z;
       }},
      {"hunt_A",
       [](const Arguments& x) {
         return opponentFromLms({x[0], x[1], x[2]}).x;
       }},
      {"hunt_a",
       [](const Arguments& x) {
         return opponentFromLms({x[0], x[1], x[2]}).y;
       }},
      {"hunt_b",
       [](const Arguments& x) {
         return opponentFromLms({x[0], x[1], x[2]}).z;
       }},
      {"rating_R", [](const Arguments& x) { return poppingRating(x[0], PoppingSettings()); }},
      {"band_gain",
       [](const Arguments& x) {
         return bandTransfer(x[0] == 4.0 ? Kernel::binomial5() : Kernel::fused6(), Upsampler::Successive,
                             PeakModel::NoUpsample, static_cast<int>(x[1]), 2.0 * std::numbers::pi * x[2]);
       }},
      {"dE94",
       [](const Arguments& x) {
         return differenceCie94({x[0], x[1], x[2]}, {x[3], x[4], x[5]});
       }},
  };
  return kFunctions;
}

}  // namespace limen::perception
