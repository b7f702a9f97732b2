// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace limen::study {

/// A wire to a recorder (EEG, eye tracker, oscilloscope) that takes a byte at a time.
class MarkerPort {
 public:
  virtual ~MarkerPort() = default;
  /// Returns once the system has taken the byte, without waiting for it to be sent. Throws Error naming the
  /// port.
  virtual void send(uint8_t code) = 0;
  virtual const std::string& name() const = 0;  ///< as it was asked for
};

/// Opens "serial:DEVICE", "serial:DEVICE:BAUD" (8 data bits, no parity, 1 stop bit; 115200 if left out), such
/// as serial:/dev/ttyUSB0:9600, or "parallel:DEVICE", such as parallel:/dev/parport0, whose data lines return
/// to 0 after 10 ms. Throws Error: another form, no such device, no permission, not a port of that kind, a
/// rate that it does not have.
std::unique_ptr<MarkerPort> openMarkerPort(const std::string& text);

}  // namespace limen::study
