// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "perception/vision/csf.h"

namespace limen::perception {

/// A measured contrast threshold. Temporal frequency becomes a velocity, that of a grating which drifts by
/// this many cycles per second; a patch's angular width is the root of its area.
struct CsfMeasurement {
  std::string dataset;
  CsfPoint point;  ///< velocityDegS as measured: 0 for static stimuli
  double sensitivity = 0.0;
  int line = 0;
};

/// Reads comma-separated values with a header: luminance [cd/m2], s_frequency [cpd], sensitivity, and if
/// present t_frequency [Hz], area [deg2] or ge_sigma [deg] (area = pi sigma^2), orientation, eccentricity
/// [deg], dataset. Other columns and lines that begin with # are ignored; the dataset is the file's name
/// if there is no such column. Throws Error with the line.
std::vector<CsfMeasurement> readCsfData(const std::string& path);

/// Error of a model against measurements, in dB = 20 lg of sensitivity, after one gain for all of them.
struct CsfError {
  size_t count = 0;
  size_t unpredicted = 0;  ///< where the model gives 0 and at 0 cpd; left out
  size_t outside = 0;      ///< outside the model's valid range, with the smallest velocity applied; included
  double gainDb = 0.0;     ///< mean of measured minus predicted
  double rmsDb = 0.0;      ///< of what remains; 0 for fewer than two
  double largestDb = 0.0;
};
/// Slower stimuli are treated as moving at `leastVelocityDegS`, the effect of the eye's drift on static ones.
CsfError csfError(const CsfInfo& info, const Csf& csf, const std::vector<CsfMeasurement>& data,
                  double leastVelocityDegS = 0.15);

}  // namespace limen::perception
