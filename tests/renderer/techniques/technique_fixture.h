// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <cmath>

#include <memory>
#include <optional>
#include <string>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/shadow_map.h"
#include "renderer/gl/context.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// A product with the points that it was made for.
struct Rendered {
  Image product, receivers;
  std::vector<Counter> counters;
  std::vector<Series> series;  ///< where counters are
  double counter(const std::string& name) const {
    for (const Counter& counter : counters)
      if (counter.name == name) return counter.value;
    ADD_FAILURE() << "no counter " << name;
    return 0.0;
  }
};

/// Renders with registered scenes and techniques in one context for the whole program. A driver message of
/// medium or high severity fails the test.
class TechniqueTest : public testing::Test {
 protected:
  /// Of two colours' pictures, over pixels and channels.
  static double meanDifference(const Image& a, const Image& b) {
    double sum = 0.0;
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x)
        for (int c = 0; c < 3; ++c) sum += std::abs(double(a.at(x, y, c)) - b.at(x, y, c));
    return sum / (3.0 * a.width * a.height);
  }

  static gl::Context& context() {
    static const std::unique_ptr<gl::Context> kContext = gl::createHeadlessContext();
    return *kContext;
  }

  void SetUp() override { context().makeCurrent(); }

  void TearDown() override {
    for (const gl::DebugMessage& message : context().takeDebugMessages())
      if (!message.performance || context().device().software) ADD_FAILURE() << message.text;
  }

  using Given = std::map<std::string, ParameterValue>;

  static scene::Scene makeScene(const std::string& name, const Given& given = {}) {
    return scene::buildScene(
        name, ParameterValues(scene::SceneRegistry::instance().get(name).allParameters(), given));
  }

  /// The Error with which a technique refuses values that do not go together; none where it takes them.
  static std::optional<Error> refusal(const std::string& technique, const Given& given) {
    const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
    try {
      if (info.check) info.check(ParameterValues(info.parameters, given));
      return std::nullopt;
    } catch (const Error& error) {
      return error;
    }
  }

  /// `given` for a search of micro-occluders (its names behind `prefix`), with what it leaves open as Schwarz
  /// 2009 has it, and not by default: bias by the receiver's slope, nearest depths, and so texels of
  /// levels, one invocation per pixel.
  static Given inThesisForm(Given given, const std::string& prefix = "") {
    const auto chosen = [&](const char* name, const char* otherwise) {
      const auto found = given.find(prefix + name);
      return found == given.end() ? std::string(otherwise) : std::get<std::string>(found->second);
    };
    if (chosen("bias", "receiver_slope") == "receiver_slope") {
      given[prefix + "bias"] = std::string("receiver_slope");
      given.emplace(prefix + "bias.slope", 2.0);
    }
    const std::string occluders = chosen("occluders", "micropatches");
    if (occluders == "micropatches" || occluders == "contours")
      given.emplace(prefix + "occluders.depths", std::string("nearest"));
    given[prefix + "passes"] = chosen("passes", "single");
    if (chosen("passes", "single") == "split") given.emplace(prefix + "passes.lanes", int64_t{1});
    return given;
  }

  /// `given`, with every map that the technique reads at `side` texels.
  static Given withMaps(const std::string& technique, int side, Given given = {}) {
    const ParameterValues values(TechniqueRegistry::instance().get(technique).parameters, given);
    for (const auto& [path, value] : values.all()) {
      if (!path.ends_with("resolution")) continue;
      given[path] = int64_t{side};
    }
    return given;
  }

  static Rendered render(const scene::Scene& scene, const std::string& technique, const Given& given,
                         glm::ivec2 sizePx, bool counting = false) {
    const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, sizePx);
    const auto made = info.make(ParameterValues(info.parameters, given));
    made->prepare(frame);
    frame.begin();
    made->render(frame);
    Rendered out{made->product().read(), frame.get<frame::Receivers>().texture().read(), {}, {}};
    frame.end();
    if (counting) {
      out.counters = made->count(frame);
      out.series = made->series();
    }
    return out;
  }
};

}  // namespace limen::techniques
