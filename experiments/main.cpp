// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/cores.h"
#include "experiments/gl_devices.h"
#include "experiments/gl_executor.h"
#include "experiments/sweep.h"
#include "renderer/catalogue.h"

int main(int argc, char** argv) {
  using namespace limen::experiments;
  limen::keepFreedMemory();
  return sweepMain(argc, argv,
                   {"limen-sweep", [] { return *limen::catalogueFromRegistries(); }, makeGlExecutor,
                    listDevices, listUnopenedDevices, openDevice});
}
