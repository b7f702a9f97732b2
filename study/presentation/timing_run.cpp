// SPDX-License-Identifier: BSD-3-Clause
#include "study/presentation/timing_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace limen::study {
namespace {

constexpr double kEdges[] = {0.0, 0.25, 0.75, 0.95, 1.05, 1.25, 1.75, 2.5, 3.5};
constexpr double kUnknownHz = 60.0;  ///< initial value if the system does not report one
constexpr size_t kListed = 20;       ///< missed frames listed in the text

std::string frames(int count, const char* what) {
  return fmt::format("{} frame{} {}", count, count == 1 ? "" : "s", what);
}

void object(TimingReport& report) {
  std::vector<std::string>& out = report.objections;
  if (!(report.nominalHz > 0.0))
    out.push_back("the system reports no refresh rate: this may not be a real display");
  if (!report.classified.waits) {
    out.push_back("swaps do not wait for the vertical blank");
    return;
  }
  if (report.nominalHz > 0.0 && std::abs(report.measuredHz / report.nominalHz - 1.0) > 0.01)
    out.push_back(fmt::format("the display runs at {:.2f} Hz but the system reports {:.2f}",
                              report.measuredHz, report.nominalHz));
  if (report.classified.missedBlanks > 0) out.push_back(frames(report.classified.missedBlanks, "missed"));
  if (report.classified.earlySwaps > 0)
    out.push_back(frames(report.classified.earlySwaps, "shown too briefly: swaps did not wait"));
}

}  // namespace

TimingReport reportTiming(const std::vector<int64_t>& returnedNs, double nominalHz) {
  TimingReport out;
  out.nominalHz = nominalHz;
  out.swaps = static_cast<int>(returnedNs.size());
  out.classified = classifySwaps(returnedNs, {.nominalHz = nominalHz > 0.0 ? nominalHz : kUnknownHz});
  out.measuredHz = out.classified.waits ? out.classified.refreshHz() : 0.0;
  for (size_t i = 0; i < std::size(kEdges); ++i)
    out.histogram.push_back({kEdges[i], i + 1 < std::size(kEdges) ? kEdges[i + 1] : INFINITY, 0});
  std::vector<double> intervals;
  for (size_t i = 1; i < returnedNs.size(); ++i)
    intervals.push_back(1e-6 * static_cast<double>(returnedNs[i] - returnedNs[i - 1]));
  if (!intervals.empty()) {
    const auto n = static_cast<double>(intervals.size());
    for (const double interval : intervals) {
      out.meanMs += interval / n;
      const auto bin = std::find_if(
          out.histogram.begin(), out.histogram.end(),
          [&](const TimingReport::Bin& b) { return interval < b.toPeriods * out.classified.periodMs; });
      ++bin->count;
    }
    for (const double interval : intervals) out.sdMs += (interval - out.meanMs) * (interval - out.meanMs);
    out.sdMs = intervals.size() > 1 ? std::sqrt(out.sdMs / (n - 1.0)) : 0.0;
    const auto [least, most] = std::minmax_element(intervals.begin(), intervals.end());
    out.leastMs = *least;
    out.mostMs = *most;
  }
  object(out);
  return out;
}

int timingWarmUpSwaps(double refreshHz) { return static_cast<int>(std::ceil(0.5 * refreshHz)); }

TimingReport runTiming(ScreenDevice& screen, double seconds) {
  const double hz = screen.refreshHz() > 0.0 ? screen.refreshHz() : kUnknownHz;
  const int warmUp = timingWarmUpSwaps(hz);
  std::vector<int64_t> times;
  for (int i = 0; !screen.lost(); ++i) {
    screen.clear(i % 2 == 0 ? 0.2 : 0.25);
    const int64_t now = screen.swap();
    screen.poll();
    if (i >= warmUp) times.push_back(now);
    if (i > warmUp && 1e-9 * static_cast<double>(now - times.front()) >= seconds) break;
  }
  TimingReport out = reportTiming(times, screen.refreshHz());
  if (screen.lost()) out.objections.push_back("the window was lost");
  return out;
}

nlohmann::json toJson(const TimingReport& report) {
  nlohmann::json bins = nlohmann::json::array(), events = nlohmann::json::array();
  for (const TimingReport::Bin& bin : report.histogram)
    bins.push_back(
        {{"from_periods", bin.fromPeriods},
         {"to_periods", std::isinf(bin.toPeriods) ? nlohmann::json() : nlohmann::json(bin.toPeriods)},
         {"count", bin.count}});
  for (size_t i = 0; i < report.classified.swaps.size(); ++i)
    if (const Swap& swap = report.classified.swaps[i];
        swap.kind == SwapKind::Missed || swap.kind == SwapKind::Early)
      events.push_back({{"swap", i},
                        {"kind", swap.kind == SwapKind::Missed ? "missed" : "early"},
                        {"missed_blanks", swap.missed}});
  return {{"nominal_hz", report.nominalHz},
          {"measured_hz", report.measuredHz},
          {"waits", report.classified.waits},
          {"swaps", report.swaps},
          {"interval_mean_ms", report.meanMs},
          {"interval_sd_ms", report.sdMs},
          {"interval_min_ms", report.leastMs},
          {"interval_max_ms", report.mostMs},
          {"histogram", bins},
          {"missed_blanks", report.classified.missedBlanks},
          {"late_swaps", report.classified.lateSwaps},
          {"early_swaps", report.classified.earlySwaps},
          {"events", events},
          {"fit_for_lab", report.objections.empty()},
          {"objections", report.objections}};
}

std::string toText(const TimingReport& report) {
  std::string out =
      fmt::format("refresh rate: {} nominal, {} measured\n",
                  report.nominalHz > 0.0 ? fmt::format("{:.4g} Hz", report.nominalHz) : "none",
                  report.measuredHz > 0.0 ? fmt::format("{:.3f} Hz", report.measuredHz) : "none");
  out += fmt::format("intervals of {} swaps: mean {:.3f} ms, SD {:.3f} ms, {:.3f} to {:.3f} ms\n",
                     report.swaps, report.meanMs, report.sdMs, report.leastMs, report.mostMs);
  for (const TimingReport::Bin& bin : report.histogram)
    if (bin.count > 0)
      out += std::isinf(bin.toPeriods)
                 ? fmt::format("  from {:<4} periods on    {}\n", bin.fromPeriods, bin.count)
                 : fmt::format("  {:<4} to {:<4} periods    {}\n", bin.fromPeriods, bin.toPeriods, bin.count);
  out +=
      fmt::format("missed blanks: {}, frames late but shown in time: {}, swaps that did not wait: {}\n",
                  report.classified.missedBlanks, report.classified.lateSwaps, report.classified.earlySwaps);
  size_t listed = 0;
  for (size_t i = 0; i < report.classified.swaps.size(); ++i) {
    const Swap& swap = report.classified.swaps[i];
    if (swap.kind != SwapKind::Missed || ++listed > kListed) continue;
    out += fmt::format("  {} before swap {}\n", frames(swap.missed, "missed"), i);
  }
  if (listed > kListed) out += fmt::format("  and {} more places (--json lists all)\n", listed - kListed);
  if (report.objections.empty()) return out + "fit for a lab\n";
  out += "not fit for a lab:\n";
  for (const std::string& objection : report.objections) out += "  " + objection + "\n";
  return out;
}

}  // namespace limen::study
