// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "experiments/base/image.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/technique.h"

namespace limen::references {

using Given = std::map<std::string, ParameterValue>;

inline scene::Scene builtScene(const std::string& name, const Given& given = {}) {
  const scene::SceneInfo& info = scene::SceneRegistry::instance().get(name);
  return scene::buildScene(name, ParameterValues(info.allParameters(), given));
}

/// What a reference made of a scene, and the points it evaluated.
struct Rendered {
  Image visibility;
  Image receivers;  ///< frame::Receivers
  double errorBound = 0.0;
  std::map<std::string, double> counters;

  bool isReceiver(size_t pixel) const { return receivers.data[4 * pixel + 3] >= 0.0F; }
  /// Light space.
  glm::dvec3 point(size_t pixel) const {
    return {receivers.data[4 * pixel], receivers.data[4 * pixel + 1], receivers.data[4 * pixel + 2]};
  }
  size_t receiverCount() const {
    size_t count = 0;
    for (size_t i = 0; i < receivers.pixels(); ++i) count += isReceiver(i);
    return count;
  }
};

inline Rendered renderReference(gl::Context& context, const scene::Scene& scene, const std::string& name,
                                const Given& given, glm::ivec2 sizePx) {
  const techniques::TechniqueInfo& info = techniques::TechniqueRegistry::instance().get(name);
  const ParameterValues values(info.parameters, given);
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context, scene, gpuScene, sizePx);
  const auto technique = info.make(values);
  technique->prepare(frame);
  frame.begin();
  technique->render(frame);
  Rendered out;
  out.visibility = technique->product().read();
  out.receivers = frame.get<frame::Receivers>().texture().read();
  for (const techniques::Counter& counter : technique->count(frame))
    out.counters[counter.name] = counter.value;
  frame.end();
  if (info.errorBound) out.errorBound = info.errorBound(values);
  return out;
}

}  // namespace limen::references
