// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/color_video_vdp/sensitivity.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

namespace limen::embedded {
extern const char* const kCvvdpSensitivity;
}

namespace limen::perception::cvvdp {
namespace {

struct Table {
  std::vector<double> logBackgrounds, logFrequencies;
  /// [channel][background][frequency], log10.
  std::array<std::vector<std::vector<double>>, kChannels> logs;
};

const Table& table() {
  static const Table kTable = [] {
    const nlohmann::json file = nlohmann::json::parse(embedded::kCvvdpSensitivity);
    Table out;
    for (const auto& [key, target] : {std::pair{"L_bkg", &out.logBackgrounds}, {"rho", &out.logFrequencies}})
      for (const double value : file.at(key).get<std::vector<double>>()) target->push_back(std::log10(value));
    constexpr std::array<const char*, kChannels> kKeys = {"o0_c1", "o0_c2", "o0_c3", "o5_c1"};
    for (size_t c = 0; c < kChannels; ++c)
      out.logs[c] = file.at(kKeys[c]).get<std::vector<std::vector<double>>>();
    assert(out.logBackgrounds.size() == kSensitivityLevels);
    return out;
  }();
  return kTable;
}

}  // namespace

double Sensitivity::firstLogBackground() { return table().logBackgrounds.front(); }
double Sensitivity::lastLogBackground() { return table().logBackgrounds.back(); }

Sensitivity::Sensitivity(int channel, double frequencyCpd) {
  const std::vector<double>& nodes = table().logFrequencies;
  const double logFrequency = std::log10(frequencyCpd);
  const auto above = std::lower_bound(nodes.begin(), nodes.end(), logFrequency) - nodes.begin();
  const auto i = static_cast<size_t>(
      std::clamp<std::ptrdiff_t>(above - 1, 0, static_cast<std::ptrdiff_t>(nodes.size()) - 2));
  const double share = (logFrequency - nodes[i]) / (nodes[i + 1] - nodes[i]);
  const double correction = std::log10(parameters().sensitivityFactor);
  for (size_t level = 0; level < kSensitivityLevels; ++level) {
    const std::vector<double>& row = table().logs[static_cast<size_t>(channel)][level];
    logs_[level] = row[i] + share * (row[i + 1] - row[i]) + correction;
  }
}

double Sensitivity::at(double logBackground) const {
  constexpr double kLast = kSensitivityLevels - 1;
  const double first = firstLogBackground(), last = lastLogBackground();
  const double position = std::clamp(kLast * (logBackground - first) / (last - first), 0.0, kLast);
  const auto i = static_cast<size_t>(std::min(position, kLast - 1.0));
  const double share = position - static_cast<double>(i);
  return std::pow(10.0, logs_[i] + share * (logs_[i + 1] - logs_[i]));
}

}  // namespace limen::perception::cvvdp
