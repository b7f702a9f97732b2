// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "perception/threshold_maps/threshold_map_gpu.h"
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
  /// One frame: takes the results that are due, draws layers and composite, tests the next objects. `wait`:
  /// wait for results that are due.
  void render(double timeS, bool wait);

  const gl::Texture& picture() const { return images_.composite(); }
  const TestedLevels& control() const { return control_; }
  /// Levels of the last frame's picture.
  const scene::LodSelection& shown() const { return images_.shown(); }
  const std::vector<int>& layerOf() const { return layerOf_; }  ///< 1.., of the last frame
  LayerImages& images() { return images_; }
  /// All tests whose results the last frame used.
  const std::vector<LevelTest>& taken() const { return taken_; }
  int mapsMade() const { return mapsMade_; }                    ///< in the last frame
  int64_t trianglesTested() const { return trianglesTested_; }  ///< drawn for tests in the last frame
  /// "layer_i", "shadow_mask_i", "context_i", "threshold_map_i" (cd/m2), layers counted from 1; "background",
  /// "visible_pixels".
  std::map<std::string, const gl::Texture*> debugViews();

 private:
  /// Views needed by one test of a frame.
  struct TestViews {
    TestViews(frame::Frame& parent, int number, bool shadows, bool withNext);
    LevelView finest;
    std::unique_ptr<LevelView> next, finestCasters, nextCasters;
  };
  void takeResults(bool wait);
  std::vector<char> testable() const;
  void makeMap(int layer);
  void test(int number, int object, bool priming);
  frame::Frame& versionOf(LevelView& view, LevelView* casters, int object, int level);

  frame::Frame& parent_;
  const PerceptualLodSettings settings_;
  const SeenOn seenOn_;
  LayerImages images_;
  TestedLevels control_;
  perception::ThresholdMapGpu thresholdMap_;
  std::vector<gl::Texture> maps_;  ///< TM_i, of layers of objects
  gl::Texture visible_;
  std::vector<std::unique_ptr<TestViews>> testViews_;
  TestCounts counts_;
  int64_t frameNumber_ = 0;
  double timeS_ = 0.0;
  std::vector<int> layerOf_;
  std::vector<PixelRect> pixels_;
  std::vector<LevelTest> taken_;
  int mapsMade_ = 0;
  int64_t trianglesTested_ = 0;
};

}  // namespace limen::techniques
