// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "perception/threshold_maps/threshold_maker.h"
#include "renderer/techniques/perceptual_lod/layer_images.h"
#include "renderer/techniques/perceptual_lod/test_counts.h"
#include "renderer/techniques/perceptual_lod/tested_levels.h"

namespace limen::techniques {

/// The interactive perceptual pipeline: picture and level control, frame by frame. See
/// perceptual_lod.cpp for what the thesis leaves open.
class PerceptualPipeline {
 public:
  PerceptualPipeline(frame::Frame& parent, const PerceptualLodSettings& settings);

  /// Runs every pass once without changing a level.
  void prime(double timeS);
  /// One frame: takes the results that are due, draws layers and tests, composes the picture, tests the next
  /// objects. `wait`: wait for results that are due.
  void render(double timeS, bool wait);

  const gl::Texture& picture() const { return images_.picture(); }
  const TestedLevels& control() const { return control_; }
  /// Levels of the last frame's picture.
  const scene::LodSelection& shown() const { return images_.shown(); }
  const std::vector<int>& layerOf() const { return layerOf_; }  ///< 1.., of the last frame
  LayerImages& images() { return images_; }
  /// All tests whose results the last frame used.
  const std::vector<LevelTest>& taken() const { return taken_; }
  /// What the last frame drew to test.
  const std::vector<ObjectTest>& planned() const { return tests_; }
  int mapsMade() const { return mapsMade_; }  ///< in the last frame
  /// Drawn for tests in the last frame.
  int64_t trianglesTested() const { return static_cast<int64_t>(images_.trianglesTested()); }
  /// C_i [cd/m2] and its threshold map [cd/m2] for a layer of the last frame. Slow.
  struct Surroundings {
    const gl::Texture *context, *thresholds;
  };
  Surroundings surroundings(int layer);
  /// "layer_i", "shadow_mask_i", "context_i", "threshold_map_i" (cd/m2), layers counted from 1; "background",
  /// "visible_pixels". All are made on demand, of the last frame.
  std::map<std::string, const gl::Texture*> debugViews();

 private:
  void takeResults(bool wait);
  std::vector<ObjectTest> nextTests();
  const gl::Texture& makeMap(int layer, bool timed, const std::optional<perception::MapArea>& only = {});
  void bindTests(const gl::Program& program, const gl::Texture& thresholds);
  void runTests(int layer, const gl::Texture& thresholds);
  void markVisible(int layer, const gl::Texture& thresholds, const gl::Texture& marks);

  frame::Frame& parent_;
  const PerceptualLodSettings settings_;
  const SeenOn seenOn_;
  LayerImages images_;
  TestedLevels control_;
  std::unique_ptr<perception::ThresholdMaker> thresholds_;
  TestCounts counts_;
  int64_t frameNumber_ = 0;
  std::vector<int> layerOf_;
  std::vector<PixelRect> pixels_;
  std::vector<ObjectTest> tests_;
  std::vector<LevelTest> taken_;
  int mapsMade_ = 0;
  std::map<std::string, gl::Texture> views_;
};

}  // namespace limen::techniques
