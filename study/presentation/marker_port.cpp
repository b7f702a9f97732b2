// SPDX-License-Identifier: BSD-3-Clause
#include "study/presentation/marker_port.h"

#include <fcntl.h>
#include <linux/ppdev.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::study {
namespace {

constexpr const char* kForms =
    "write serial:/dev/ttyUSB0, serial:/dev/ttyUSB0:BAUD or parallel:/dev/parport0";
constexpr std::array<std::pair<int, speed_t>, 9> kRates = {{{1200, B1200},
                                                            {2400, B2400},
                                                            {4800, B4800},
                                                            {9600, B9600},
                                                            {19200, B19200},
                                                            {38400, B38400},
                                                            {57600, B57600},
                                                            {115200, B115200},
                                                            {230400, B230400}}};
constexpr auto kPulse = std::chrono::milliseconds(10);

std::string hintFor(int error, const std::string& group) {
  if (error == EACCES || error == EPERM)
    return "let the user into the group '" + group + "' and log in again: sudo adduser $USER " + group;
  if (error == ENOENT) return "is it plugged in? ls /dev/tty* /dev/parport*";
  if (error == EBUSY) return "another program uses it";
  return kForms;
}

/// A file descriptor that closes itself.
class Device {
 public:
  Device(const std::string& path, const std::string& group) : path_(path) {
    // A port without a listener must not stop the session.
    file_ = open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (file_ < 0) {
      const int error = errno;
      throw Error(std::string("the port for markers cannot be opened: ") + std::strerror(error), path,
                  hintFor(error, group));
    }
  }
  ~Device() { close(file_); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  int file() const { return file_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int file_ = -1;
};

class SerialPort : public MarkerPort {
 public:
  SerialPort(std::string name, const std::string& path, int baud)
      : name_(std::move(name)), device_(path, "dialout") {
    speed_t rate = 0;
    std::vector<std::string> known;
    for (const auto& [value, constant] : kRates) {
      known.push_back(std::to_string(value));
      if (value == baud) rate = constant;
    }
    if (rate == 0) throw Error("no rate of " + std::to_string(baud) + " baud", path, "known: " + join(known));
    termios line{};
    if (tcgetattr(device_.file(), &line) != 0)
      throw Error(std::string("is not a serial port: ") + std::strerror(errno), path, kForms);
    cfmakeraw(&line);
    line.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
    line.c_cflag |= CLOCAL | CREAD;  // no modem needs to answer
    cfsetispeed(&line, rate);
    cfsetospeed(&line, rate);
    if (tcsetattr(device_.file(), TCSANOW, &line) != 0)
      throw Error(std::string("the serial port refuses its settings: ") + std::strerror(errno), path);
  }

  void send(uint8_t code) override {
    ssize_t written = 0;
    do written = write(device_.file(), &code, 1);
    while (written < 0 && errno == EINTR);
    if (written != 1)
      throw Error(std::string("the marker was not sent: ") + std::strerror(written < 0 ? errno : EIO),
                  device_.path(), "check the cable and resume the session");
  }
  const std::string& name() const override { return name_; }

 private:
  std::string name_;
  Device device_;
};

/// Data lines of a parallel port, by the kernel's ppdev.
class ParallelPort : public MarkerPort {
 public:
  ParallelPort(std::string name, const std::string& path) : name_(std::move(name)), device_(path, "lp") {
    if (ioctl(device_.file(), PPCLAIM) != 0) {
      const int error = errno;
      throw Error(std::string("is not a parallel port that can be claimed: ") + std::strerror(error), path,
                  hintFor(error, "lp"));
    }
    put(0);
    reset_ = std::thread([this] { resetLines(); });
  }
  ~ParallelPort() override {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    wake_.notify_one();
    reset_.join();
    unsigned char none = 0;
    ioctl(device_.file(), PPWDATA, &none);
    ioctl(device_.file(), PPRELEASE);
  }

  void send(uint8_t code) override {
    {
      const std::lock_guard lock(mutex_);
      put(code);
      due_ = std::chrono::steady_clock::now() + kPulse;
      raised_ = true;
    }
    wake_.notify_one();
  }
  const std::string& name() const override { return name_; }

 private:
  void put(unsigned char code) {
    if (ioctl(device_.file(), PPWDATA, &code) != 0)
      throw Error(std::string("the marker was not sent: ") + std::strerror(errno), device_.path());
  }

  void resetLines() {
    std::unique_lock lock(mutex_);
    while (!ends_) {
      if (!raised_) {
        wake_.wait(lock);
      } else if (wake_.wait_until(lock, due_) == std::cv_status::timeout &&
                 std::chrono::steady_clock::now() >= due_) {
        unsigned char none = 0;
        ioctl(device_.file(), PPWDATA, &none);  // a port that is gone shows at the next marker
        raised_ = false;
      }
    }
  }

  std::string name_;
  Device device_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::chrono::steady_clock::time_point due_;
  bool raised_ = false, ends_ = false;
  std::thread reset_;
};

}  // namespace

std::unique_ptr<MarkerPort> openMarkerPort(const std::string& text) {
  const size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  std::string path = colon == std::string::npos ? "" : text.substr(colon + 1);
  if (path.empty() || (kind != "serial" && kind != "parallel"))
    throw Error("'" + text + "' is not a port for markers", "--markers", kForms);
  if (kind == "parallel") return std::make_unique<ParallelPort>(text, path);
  int baud = 115200;
  if (const size_t second = path.find(':'); second != std::string::npos) {
    const std::string rate = path.substr(second + 1);
    if (rate.empty() || rate.size() > 7 || rate.find_first_not_of("0123456789") != std::string::npos)
      throw Error("'" + rate + "' is not a rate in baud", "--markers", kForms);
    baud = std::stoi(rate);
    path.resize(second);
  }
  return std::make_unique<SerialPort>(text, path, baud);
}

}  // namespace limen::study
