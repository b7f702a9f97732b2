// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/catalogue.h"
#include "experiments/gl_executor.h"
#include "experiments/sweep.h"

int main(int argc, char** argv) {
  using namespace limen::experiments;
  return sweepMain(argc, argv, {"limen-sweep", catalogueFromRegistries, makeGlExecutor});
}
