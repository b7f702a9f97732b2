// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/clock.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <ctime>

namespace limen {

std::string utcNow() {
  const auto now = std::chrono::system_clock::now();
  const auto milliseconds =
      std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch()).count() % 1000;
  const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &utc);
  return fmt::format("{}.{:03}Z", text.data(), milliseconds);
}

}  // namespace limen
