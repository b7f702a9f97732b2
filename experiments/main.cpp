// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/gl_executor.h"
#include "experiments/sweep.h"
#include "renderer/catalogue.h"

int main(int argc, char** argv) {
  using namespace limen::experiments;
  return sweepMain(
      argc, argv,
      {"limen-sweep", [] { return *limen::catalogueFromRegistries(); }, makeGlExecutor, listDevices});
}
