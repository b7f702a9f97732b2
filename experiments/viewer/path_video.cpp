// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/path_video.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "experiments/base/error.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/video.h"
#include "experiments/product.h"
#include "experiments/scene_rendering.h"
#include "experiments/viewer/viewed_scene.h"
#include "renderer/gl/context.h"
#include "renderer/scene/placement.h"

namespace limen::viewer {
namespace {

/// The scene at another time on its path.
experiments::Configuration atTime(const experiments::Configuration& scene, double timeS) {
  scene::CameraChoice camera = scene::PlacementSettings::table().read(scene.values).camera;
  if (auto* path = std::get_if<scene::RecordedPath>(&camera)) path->timeS = timeS;
  if (auto* builtIn = std::get_if<scene::BuiltInCamera>(&camera)) builtIn->timeS = timeS;
  std::map<std::string, ParameterValue> values = scene.values.all();
  scene::setCamera(values, camera);
  experiments::Configuration moved = scene;
  moved.values = {scene::SceneRegistry::instance().get(scene.name).allParameters(), values};
  return moved;
}

/// Pictures of one height from left to right; the last row or column is repeated where sides must be even.
Image joined(const std::vector<Image>& pictures, bool evenSize) {
  int width = 0;
  for (const Image& picture : pictures) width += picture.width;
  const int height = pictures.front().height;
  Image out(width + (evenSize ? width % 2 : 0), height + (evenSize ? height % 2 : 0), 3);
  for (int y = 0; y < out.height; ++y) {
    int left = 0;
    for (const Image& picture : pictures) {
      const int last = &picture == &pictures.back() ? out.width - left : picture.width;
      for (int x = 0; x < last; ++x)
        for (int c = 0; c < 3; ++c)
          out.at(left + x, y, c) =
              picture.at(std::min(x, picture.width - 1), std::min(y, picture.height - 1), c);
      left += picture.width;
    }
  }
  return out;
}

/// Seconds to show. The path counts from its own time 0, the frames from the chosen one.
double lengthS(const PathVideoOptions& options, const scene::CameraPath& path, double startS) {
  if (options.seconds > 0.0) return options.seconds;
  const double endS = path.keys.empty() ? 0.0 : path.keys.back().timeS;
  if (path.keys.size() < 2 || !(endS > startS))
    throw Error("the camera rests, so that the video has no length of its own", "--video",
                "give --seconds, or a scene or path that moves");
  return endS - startS;
}

}  // namespace

std::string writePathVideo(const ViewSetup& setup, const PathVideoOptions& options) {
  const VideoFormat& format = videoFormatOf(options.file, "--video");
  const std::unique_ptr<gl::Context> context = gl::createHeadlessContext();
  const experiments::Configuration chosen = completeScene(setup.scene);
  std::vector<experiments::Configuration> techniques = {completeTechnique(setup.technique)};
  if (setup.second) techniques.push_back(completeTechnique(*setup.second));
  const double startS = scene::timeOf(scene::PlacementSettings::table().read(chosen.values).camera);
  ViewedScene scene;
  scene.show(chosen);
  const double length = lengthS(options, scene.path(), startS);
  constexpr double kMostFrames = 1e6;
  if (length * options.framesPerSecond >= kMostFrames)
    throw Error("the video would have a million frames or more", "--video", "give less --seconds or --fps");
  const int frames = std::max(1, static_cast<int>(std::lround(length * options.framesPerSecond)));

  std::optional<VideoWriter> writer;
  for (int k = 0; k < frames; ++k) {
    throwIfInterrupted();
    scene.show(atTime(chosen, startS + k / options.framesPerSecond));
    const experiments::ViewImages view = experiments::viewImages(*context, scene.get(), setup.sizePx);
    std::vector<Image> pictures;
    for (const experiments::Configuration& technique : techniques) {
      const auto kind = techniques::TechniqueRegistry::instance().get(technique.name).product;
      pictures.push_back(experiments::productPicture(
          kind, experiments::renderOnce(*context, scene.get(), setup.sizePx, technique), view.shading));
    }
    const Image picture = joined(pictures, format.evenSize);
    if (!writer) writer.emplace(options.file, picture.width, picture.height, options.framesPerSecond);
    writer->add(picture);
  }
  writer->finish();
  return writer->description();
}

}  // namespace limen::viewer
