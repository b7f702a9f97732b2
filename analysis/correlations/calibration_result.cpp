// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/correlations/calibration_result.h"

namespace limen::analysis {

void addCalibration(Section& out, const Calibration& calibration, const std::string& x,
                    const std::string& level) {
  const std::vector<Calibration> whole = {calibration};
  out.add(
      TableOf(
          "calibration",
          "calibration of " + x +
              ": Brier score = reliability - resolution + uncertainty + within bins (variance - covariance)",
          whole)
          .add(text("x"), [&](const Calibration&) { return x; })
          .add(number("brier", "Brier", 4), &Calibration::brier)
          .add(number("reliability", "", 4), &Calibration::reliability)
          .add(number("resolution", "", 4), &Calibration::resolution)
          .add(number("uncertainty", "", 4), &Calibration::uncertainty)
          .add(number("within_variance", "", 4), &Calibration::withinVariance)
          .add(number("within_covariance", "", 4), &Calibration::withinCovariance));
  const auto ifShown = [](double CalibrationBin::*member) {
    return [member](const CalibrationBin& bin) {
      return bin.trials > 0 ? ResultCell(bin.*member) : ResultCell();
    };
  };
  const Column predicted = interval("bin", "predicted", 2);
  out.add(TableOf("bins", "what was observed where " + x + " was predicted", calibration.bins)
              .add(forData(text("x")), [&](const CalibrationBin&) { return x; })
              .add(predicted,
                   [](const CalibrationBin& bin) {
                     return Interval{bin.low, bin.high};
                   })
              .add(count("positives", "trials", "1 of"),
                   [](const CalibrationBin& bin) {
                     return CountOf{bin.positives, bin.trials};
                   })
              .add(number("mean_prediction", "mean"), ifShown(&CalibrationBin::meanPrediction))
              .add(number("estimate", "observed"), ifShown(&CalibrationBin::observed))
              .add(interval("", level + " (Wilson)"), &CalibrationBin::wilson));
}

}  // namespace limen::analysis
