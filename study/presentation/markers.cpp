// SPDX-License-Identifier: BSD-3-Clause
#include "study/presentation/markers.h"

#include <chrono>
#include <utility>

#include "experiments/base/error.h"

namespace limen::study {

void Markers::send(MarkerKind kind, int64_t whenNs) {
  const int code = codes_[static_cast<size_t>(kind)];
  if (code == 0 || !failure_.empty()) return;
  try {
    port_->send(static_cast<uint8_t>(code));
  } catch (const Error& error) {
    failure_ = error.what();
    return;
  }
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  sent_.push_back({kind, code, whenNs, std::chrono::duration_cast<std::chrono::nanoseconds>(now).count()});
}

std::vector<SentMarker> Markers::take() { return std::exchange(sent_, {}); }

}  // namespace limen::study
