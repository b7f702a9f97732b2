// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/input.h"

#include <cmath>
#include <string>

#include "experiments/base/error.h"

namespace limen::perception {
namespace {

std::string sizeOf(const Image& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height);
}

void checkImage(const Image& image, const Image& reference, const char* name, int leastChannels) {
  if (image.data.empty() && leastChannels != 0 && &image != &reference) return;
  if (image.width < 1 || image.height < 1 || image.channels < 1 || image.data.empty())
    throw Error(std::string("the ") + name + " has no pixels", "popping", "give images of 1 x 1 or more");
  if (image.width != reference.width || image.height != reference.height)
    throw Error(
        std::string("the ") + name + " is " + sizeOf(image) + ", the actual image " + sizeOf(reference),
        "popping", "give images of one size");
  if (image.channels < leastChannels)
    throw Error(std::string("the ") + name + " has " + std::to_string(image.channels) + " channel(s)",
                "popping", "it needs " + std::to_string(leastChannels));
}

}  // namespace

void checkPoppingInput(const PoppingInput& input) {
  checkImage(input.actual, input.actual, "actual image", 0);
  checkImage(input.predicted, input.actual, "predicted image", 0);
  checkImage(input.actualDisplacement, input.actual, "actual displacement", 2);
  checkImage(input.predictedDisplacement, input.actual, "predicted displacement", 2);
  checkImage(input.disocclusion, input.actual, "disocclusion weight", 1);
  checkImage(input.flicker, input.actual, "flicker weight", 1);
}

std::array<double, 3> pixelValues(const Image& image, int x, int y) {
  std::array<double, 3> out{};
  for (int c = 0; c < 3; ++c) {
    const double value = image.at(x, y, image.channels < 3 ? 0 : c);
    out[static_cast<size_t>(c)] = std::isfinite(value) ? value : 0.0;
  }
  return out;
}

std::array<double, 3> pixelLight(const PoppingInput& input, const Image& image, const DisplayProfile& display,
                                 int x, int y) {
  std::array<double, 3> light = pixelValues(image, x, y);
  for (double& value : light) value = input.linear ? std::max(value, 0.0) : display.decode(value);
  return light;
}

}  // namespace limen::perception
