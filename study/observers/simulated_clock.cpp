// SPDX-License-Identifier: BSD-3-Clause
#include "study/observers/simulated_clock.h"

#include <fmt/format.h>

#include <cassert>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "experiments/base/error.h"

namespace limen::study {

std::string SimulatedClock::utc() { return utcText(utcMs_ + (nowNs_ - startNs_) / 1000000); }

void SimulatedClock::advance(double seconds) {
  assert(seconds >= 0.0);
  nowNs_ += std::llround(seconds * 1e9);
}

std::string utcText(int64_t utcMs) {
  using namespace std::chrono;
  const sys_time<milliseconds> time{milliseconds(utcMs)};
  const sys_days day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss clock(time - day);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     clock.hours().count(), clock.minutes().count(), clock.seconds().count(),
                     clock.subseconds().count());
}

int64_t utcMilliseconds(const std::string& text) {
  using namespace std::chrono;
  int y = 0, mo = 0, d = 0, h = 0, mi = 0, s = 0, ms = 0;
  const int read = std::sscanf(text.c_str(), "%d-%d-%dT%d:%d:%d.%d", &y, &mo, &d, &h, &mi, &s, &ms);
  const year_month_day date(year(y), month(static_cast<unsigned>(mo)), day(static_cast<unsigned>(d)));
  if (read < 6 || !date.ok()) throw Error("'" + text + "' is not a time");
  return sys_days(date).time_since_epoch() / milliseconds(1) + ((h * 60 + mi) * 60 + s) * int64_t{1000} + ms;
}

}  // namespace limen::study
