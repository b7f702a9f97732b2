// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/executor.h"

namespace limen::experiments {

const SettingsTable<Timing>& Timing::table() {
  static const SettingsTable<Timing> kTable = {
      {&Timing::warmup, "warmup", {0, 10000}, "frames", "Frames discarded before each round"},
      {&Timing::frames, "frames", {1, 100000}, "frames", "Timed frames in all"},
      {&Timing::rounds, "rounds", {1, 1000}, "", "Interleaved rounds"},
      {&Timing::batch, "batch", {1, 256}, "runs", "Runs whose rounds are interleaved"},
      {&Timing::firstPicture, "first_picture",
       "Also time the way from an empty context to the first picture, once a run"}};
  return kTable;
}

const SettingsTable<Artefacts>& Artefacts::table() {
  static const SettingsTable<Artefacts> kTable = {
      {&Artefacts::pictures, "pictures", "PNG of the product, the reference and the errors"},
      {&Artefacts::exr, "exr", "The same as 32-bit float EXR"}};
  return kTable;
}

const SettingsTable<ImageSize>& ImageSize::table() {
  static const SettingsTable<ImageSize> kTable = {
      {&ImageSize::width, "width", {1, 16384}, "px", "Image width"},
      {&ImageSize::height, "height", {1, 16384}, "px", "Image height"}};
  return kTable;
}

}  // namespace limen::experiments
