// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "perception/vision/csf.h"

namespace limen::perception {

/// A measured contrast threshold. Temporal frequency becomes a velocity, that of a grating which drifts by as
/// many cycles a second; a patch's angular width is the root of its area.
struct CsfMeasurement {
  std::string dataset;
  CsfPoint point;  ///< velocityDegS as measured: 0 for static stimuli
  double sensitivity = 0.0;
  int line = 0;
};

/// Reads comma-separated values with a head: luminance [cd/m2], s_frequency [cpd], sensitivity, and if they
/// are there t_frequency [Hz], area [deg2] or ge_sigma [deg] (area = pi sigma^2), orientation, eccentricity
/// [deg], dataset. Other columns and lines that begin with # are passed over; the dataset is the file's name
/// if there is no such column. Throws Error with the line.
std::vector<CsfMeasurement> readCsfData(const std::string& path);

/// How far a model is from measurements, in dB = 20 lg of sensitivity, after one gain for all of them.
struct CsfError {
  size_t count = 0;
  size_t unpredicted = 0;  ///< where the model says 0 and at 0 cpd; left out
  size_t outside = 0;      ///< outside the model's valid range, least velocity applied; counted in
  double gainDb = 0.0;     ///< mean of measured less predicted
  double rmsDb = 0.0;      ///< of what remains; 0 for fewer than two
  double largestDb = 0.0;
};
/// Slower stimuli count as `leastVelocityDegS`, which is what the eye's drift makes of static ones.
CsfError csfError(const CsfInfo& info, const Csf& csf, const std::vector<CsfMeasurement>& data,
                  double leastVelocityDegS = 0.15);

}  // namespace limen::perception
