// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "analysis/groups/sensitivity.h"
#include "analysis/output/text_table.h"

namespace limen::analysis {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string nameOf(const SensitivityRow& row) { return row.observer.empty() ? "all together" : row.observer; }

/// An interval whose sides may be open.
std::string rangeText(const MAfcSensitivity& s) {
  const auto side = [](const std::optional<double>& bound, const char* open) {
    return bound ? fixedText(bound) : std::string(open);
  };
  return side(s.low, "-inf") + " to " + side(s.high, "inf");
}

std::string yesNoLines(const PartSensitivity& part) {
  const char* rows = part.subjects ? "observer" : "rows";
  Rows table = {{rows, "hits", "false alarms", "d'", "95 %", "c", "95 %", "A'", "95 %"}},
       bias = {{rows, "ln beta", "95 %", "beta", "95 %"}};
  for (const SensitivityRow& row : part.rows) {
    std::vector<std::string> line = {nameOf(row),
                                     fmt::format("{}/{}", row.counts.hits, row.counts.signalTrials),
                                     fmt::format("{}/{}", row.counts.falseAlarms, row.counts.noiseTrials)};
    if (!row.yesNo) {
      line.resize(table[0].size(), "-");
      table.push_back(line);
      continue;
    }
    const YesNoSensitivity& s = *row.yesNo;
    for (const std::string& text :
         {fixedText(s.dPrime), intervalText(s.dPrimeInterval), fixedText(s.criterion),
          intervalText(s.criterionInterval), fixedText(s.aPrime), intervalText(s.aPrimeInterval)})
      line.push_back(text);
    table.push_back(line);
    bias.push_back({nameOf(row), fixedText(s.lnBeta), intervalText(s.lnBetaInterval), fixedText(s.beta),
                    intervalText(s.betaInterval)});
  }
  return alignedText(table, {0}) + (bias.size() > 1 ? "\n" + alignedText(bias, {0}) : std::string());
}

std::string mAfcLines(const PartSensitivity& part) {
  Rows table = {{part.subjects ? "observer" : "rows", "right", "share", "d'", "95 %"}};
  for (const SensitivityRow& row : part.rows) {
    const double share = static_cast<double>(row.correct) / static_cast<double>(row.trials);
    table.push_back({nameOf(row), fmt::format("{}/{}", row.correct, row.trials), percentText(share),
                     row.mAfc ? fixedText(row.mAfc->dPrime) : "-", row.mAfc ? rangeText(*row.mAfc) : "-"});
  }
  return alignedText(table, {0});
}

std::string meanLines(const PartSensitivity& part) {
  if (!part.dPrime) return {};
  Rows table = {{fmt::format("mean over {} {}", part.dPrime->subjects, part.subjects ? "observers" : "rows"),
                 "mean", "sd", "95 %"}};
  const auto line = [&](const char* name, const std::optional<MeanOverSubjects>& mean) {
    if (mean)
      table.push_back(
          {name, fixedText(mean->mean), fixedText(mean->standardDeviation), intervalText(mean->interval)});
  };
  line("d'", part.dPrime);
  line("c", part.criterion);
  line("ln beta", part.lnBeta);
  line("A'", part.aPrime);
  return "\n" + alignedText(table, {0});
}

std::string methodLines(const PartSensitivity& part) {
  std::string out = "\n  ";
  out += part.yesNo ? "yes/no, equal-variance Gaussian model; c above 0: reluctant to say yes"
                    : fmt::format("{} alternatives, unbiased observer", part.alternatives);
  out += "; rates ";
  out += part.correction == RateCorrection::kLogLinear ? "k of n as (k + 1/2) / (n + 1)" : "as they are";
  if (part.rows.size() > 1)
    out += "\n  all together: answers pooled; d' comes out too small where rows differ, report the mean";
  return out + "\n";
}

}  // namespace

std::string toText(const std::vector<PartSensitivity>& parts) {
  std::string out;
  for (const PartSensitivity& part : parts) {
    out += "\n" + part.title + "\n";
    if (!part.rows.empty())
      out += (part.yesNo ? yesNoLines(part) : mAfcLines(part)) + meanLines(part) + methodLines(part);
    if (!part.note.empty()) out += "  " + part.note + "\n";
  }
  return out;
}

}  // namespace limen::analysis
