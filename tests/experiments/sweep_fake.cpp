// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>

#include "experiments/base/error.h"
#include "experiments/sweep.h"
#include "tests/experiments/fake_bench.h"

// limen-sweep without a GPU. FAKE_DEVICE names the device; FAKE_DEVICE= (empty) stands for a machine without
// one.
int main(int argc, char** argv) {
  using namespace limen::experiments;
  const auto makeExecutor = [](const std::string&) -> std::unique_ptr<Executor> {
    const char* const device = std::getenv("FAKE_DEVICE");
    if (device && *device == '\0') throw limen::Error("no device", "EGL", "install a driver");
    return std::make_unique<FakeExecutor>(device ? device : "fake device");
  };
  return sweepMain(argc, argv, {"limen-sweep", fakeCatalogue, makeExecutor});
}
