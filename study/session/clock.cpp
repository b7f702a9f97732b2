// SPDX-License-Identifier: BSD-3-Clause
#include "study/session/clock.h"

#include <chrono>
#include <cstdio>
#include <fstream>

#include "experiments/base/clock.h"
#include "study/session/run.h"

namespace limen::study {
namespace {

class SystemClock final : public Clock {
 public:
  std::string utc() override { return utcNow(); }
  int64_t monotonicNs() override {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
  }
  std::string boot() override {
    std::string id;
    std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), id);
    return id;
  }
};

}  // namespace

Clock& systemClock() {
  static SystemClock clock;
  return clock;
}

std::optional<double> utcSeconds(const std::string& utc) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;
  double second = 0.0;
  char zone = 0;
  if (std::sscanf(utc.c_str(), "%4d-%2d-%2dT%2d:%2d:%lf%c", &year, &month, &day, &hour, &minute, &second,
                  &zone) != 7 ||
      zone != 'Z')
    return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  const double days = static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
  return days * 86400.0 + hour * 3600.0 + minute * 60.0 + second;
}

}  // namespace limen::study
