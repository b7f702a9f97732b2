// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "study/presentation/marker_port.h"
#include "study/protocol/protocol.h"
#include "study/session/front_end.h"

namespace limen::study {

/// Sends the codes that a protocol declares when things happen on screen, and remembers when it did.
class Markers {
 public:
  Markers(std::unique_ptr<MarkerPort> port, MarkerCodes codes) : port_(std::move(port)), codes_(codes) {}

  /// `whenNs`: when it happened, steady clock. After a failure nothing is sent any more: see failure().
  void send(MarkerKind kind, int64_t whenNs);
  /// Those sent since the last call.
  std::vector<SentMarker> take();
  /// Why a marker could not be sent; "" if all were.
  const std::string& failure() const { return failure_; }
  const std::string& port() const { return port_->name(); }
  const MarkerCodes& codes() const { return codes_; }

 private:
  std::unique_ptr<MarkerPort> port_;
  MarkerCodes codes_;
  std::vector<SentMarker> sent_;
  std::string failure_;
};

}  // namespace limen::study
