// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/perceive.h"

int main(int argc, char** argv) { return limen::perception::perceiveMain(argc, argv); }
