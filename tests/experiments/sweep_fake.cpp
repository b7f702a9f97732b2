// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstdlib>
#include <thread>

#include "experiments/base/error.h"
#include "experiments/sweep.h"
#include "tests/experiments/fake_bench.h"

// limen-sweep without a GPU. FAKE_DEVICE names the device; FAKE_DEVICE= (empty) stands for a machine without
// one. FAKE_GPUS=3 stands for a machine with a software renderer and then three GPUs of one kind, of which
// FAKE_GIVEN=2 alone was given to this job of Slurm, and with FAKE_GIVEN=? nobody knows which. FAKE_BROKEN=2
// cannot be opened; opening another takes FAKE_OPEN_S seconds.
int main(int argc, char** argv) {
  using namespace limen::experiments;
  const auto devices = []() -> std::vector<SweepDevice> {
    const char* const count = std::getenv("FAKE_GPUS");
    if (!count) return {};
    std::vector<SweepDevice> out = {{"fake renderer", true}};
    out.resize(1 + static_cast<size_t>(std::atoi(count)), {"fake GPU", false});
    if (const char* const given = std::getenv("FAKE_GIVEN"))
      for (size_t i = 1; i < out.size(); ++i) {
        out[i].assigned = std::to_string(i) == given;
        if (*given == '?') out[i].assigned.reset();
      }
    return out;
  };
  const auto makeExecutor = [&](const std::string&, const std::string&) -> std::unique_ptr<Executor> {
    const char* const chosen = std::getenv("LIMEN_EGL_DEVICE");
    if (chosen && *chosen != '\0' && std::getenv("FAKE_GPUS"))
      return std::make_unique<FakeExecutor>(devices().at(std::stoul(chosen)).name);
    const char* const device = std::getenv("FAKE_DEVICE");
    if (device && *device == '\0') throw limen::Error("no device", "EGL", "install a driver");
    return std::make_unique<FakeExecutor>(device ? device : "fake device");
  };
  const auto unopened = [&] {
    std::vector<SweepDevice> out = devices();
    for (SweepDevice& device : out) device.name.clear();
    return out;
  };
  const auto open = [&] {
    const SweepDevice device = devices().at(std::stoul(std::getenv("LIMEN_EGL_DEVICE")));
    const char* const seconds = std::getenv("FAKE_OPEN_S");
    if (seconds) std::this_thread::sleep_for(std::chrono::duration<double>(std::atof(seconds)));
    const char* const broken = std::getenv("FAKE_BROKEN");
    if (broken && std::string(broken) == std::getenv("LIMEN_EGL_DEVICE")) throw limen::Error("no OpenGL 4.5");
    return device;
  };
  return sweepMain(argc, argv, {"limen-sweep", fakeCatalogue, makeExecutor, devices, unopened, open});
}
