// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "experiments/base/image.h"
#include "experiments/base/image_file.h"
#include "tests/experiments/cli_fixture.h"

namespace limen::perception {

/// How a test wants a file written.
struct FileForm {
  OIIO::TypeDesc type = OIIO::TypeDesc::UINT8;
  std::vector<std::pair<std::string, std::string>> text;  ///< attributes
  std::vector<std::pair<std::string, int>> whole;
};

/// Calls limen-perceive as a user does, in a folder that goes with the test, on images made here.
class PerceiveCli : public experiments::SweepCli {
 protected:
  PerceiveCli() { program_ = std::string(LIMEN_BIN_DIR) + "/limen-perceive"; }

  experiments::CallResult call(const std::vector<std::string>& arguments) const {
    return wait(start(arguments));
  }

  /// Values in [0, 1] (integer types) or as they are, through OpenImageIO alone.
  void save(const std::string& name, const Image& image, const FileForm& form = {}) const {
    OIIO::ImageSpec spec(image.width, image.height, image.channels, form.type);
    for (const auto& [key, value] : form.text) spec.attribute(key, value);
    for (const auto& [key, value] : form.whole) spec.attribute(key, value);
    const auto out = OIIO::ImageOutput::create(path(name));
    ASSERT_TRUE(out) << OIIO::geterror();
    ASSERT_TRUE(out->open(path(name), spec)) << out->geterror();
    ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, image.data.data())) << out->geterror();
    ASSERT_TRUE(out->close());
  }

  static Image flat(int width, int height, std::initializer_list<float> colour) {
    Image image(width, height, static_cast<int>(colour.size()));
    for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = *(colour.begin() + i % colour.size());
    return image;
  }
  /// Multiples of 1/255 around the middle, the same for a seed.
  static Image noise(int width, int height, int channels, unsigned seed) {
    Image image(width, height, channels);
    std::mt19937 random(seed);
    for (float& value : image.data) value = static_cast<float>(40 + random() % 160) / 255.0F;
    return image;
  }
  /// IEC 61966-2-1, written out here so that the tests have their own.
  static double light(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  }
  static double code(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
  }
  static Image mapped(Image image, double (*function)(double)) {
    for (float& value : image.data) value = static_cast<float>(function(value));
    return image;
  }

  /// The one JSON object of a successful call.
  nlohmann::json result(std::vector<std::string> arguments) const {
    arguments.emplace_back("--json");
    const experiments::CallResult answer = call(arguments);
    EXPECT_EQ(answer.exitCode, 0) << answer.err;
    const std::vector<nlohmann::json> lines = jsonLines(answer.out);
    EXPECT_EQ(lines.size(), 1U) << answer.out;
    return lines.empty() ? nlohmann::json() : lines.front();
  }
  double figure(const nlohmann::json& result, const std::string& name) const {
    return result.at("figures").at(name).get<double>();
  }
  static void expectFinite(const nlohmann::json& result) {
    for (const auto& [name, value] : result.at("figures").items()) {
      EXPECT_TRUE(value.is_null() || std::isfinite(value.get<double>())) << name;
    }
  }
  /// A refusal: code 2 and one line on stderr that has all the words.
  void expectRefused(const std::vector<std::string>& arguments, const std::vector<std::string>& words) const {
    const experiments::CallResult answer = call(arguments);
    EXPECT_EQ(answer.exitCode, 2) << testing::PrintToString(arguments) << answer.out << answer.err;
    // Image libraries may print lines of their own.
    std::string refusal;
    std::istringstream lines(answer.err);
    for (std::string line; std::getline(lines, line);)
      if (line.rfind("limen-perceive: ", 0) == 0) refusal += line + "\n";
    EXPECT_EQ(std::count(refusal.begin(), refusal.end(), '\n'), 1) << answer.err;
    for (const std::string& word : words) EXPECT_THAT(refusal, testing::HasSubstr(word));
  }
};

}  // namespace limen::perception
