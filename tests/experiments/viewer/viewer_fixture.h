// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "experiments/base/error.h"
#include "experiments/viewer/screenshot.h"
#include "experiments/viewer/viewer.h"
#include "renderer/window/offscreen_ui.h"

namespace limen::viewer {

/// A viewer on a surface in memory, with functions that move its mouse and press its keys.
class ViewerTest : public testing::Test {
 protected:
  ViewerTest() {
    // Each test has a folder of its own: a process never writes over what it has read.
    static int made = 0;
    folder_ = std::filesystem::temp_directory_path() /
              ("limen_viewer_" + std::to_string(getpid()) + "_" + std::to_string(++made));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~ViewerTest() override {
    viewer_.reset();
    ui_.reset();
    std::filesystem::remove_all(folder_);
  }

  /// Small pictures: a software renderer makes them.
  static ViewSetup smallSetup(const std::string& technique = "soft_shadows/pcss",
                              const std::string& scene = "sphere_grid") {
    ViewSetup setup;
    setup.scene.name = scene;
    setup.technique.name = technique;
    setup.sizePx = {40, 30};
    return setup;
  }

  /// Small letters on a high surface: all controls are in sight, and a software renderer draws few pixels.
  void open(const ViewSetup& setup, const std::string& shaderRoot = {}, glm::ivec2 windowPx = {800, 1900}) {
    ViewerOptions options;
    options.setup = setup;
    options.resultsFolder = (folder_ / "exported").string();
    options.shaderRoot = shaderRoot;
    options.display = perception::displayPreset("schwarz_2009");
    ui_ = std::make_unique<window::OffscreenUi>(windowPx, 0.6F);
    viewer_ = std::make_unique<Viewer>(*ui_, options, [] {});
  }
  void rest() { runToRest(*ui_, *viewer_, 1, 120.0); }
  void draw() {
    ui_->draw({0, 0, 0}, [&] { viewer_->build(1.0 / 60.0); });
    ui_->finish();
  }

  /// Frames until the condition holds; false if it does not within a minute.
  bool drawUntil(const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (std::chrono::steady_clock::now() < end) {
      if (holds()) return true;
      viewer_->takeResults();
      draw();
      // A window waits for the display between frames; without that a software renderer is kept busy by them.
      std::this_thread::sleep_for(std::chrono::milliseconds(16));
    }
    return false;
  }

  glm::vec2 centreOf(const std::string& control) {
    const ControlMap::Place* place = viewer_->controls().find(control);
    EXPECT_TRUE(place) << "no control '" << control << "'";
    return place ? place->centre() : glm::vec2(-1.0F);
  }
  /// At a share of a control's width.
  glm::vec2 along(const std::string& control, float share) {
    const ControlMap::Place* place = viewer_->controls().find(control);
    EXPECT_TRUE(place) << "no control '" << control << "'";
    if (!place) return glm::vec2(-1.0F);
    return {glm::mix(place->leastPx.x + 3.0F, place->mostPx.x - 3.0F, share), place->centre().y};
  }
  void click(glm::vec2 at) {
    ui_->moveMouse(at);
    draw();
    ui_->press(0, true);
    draw();
    ui_->press(0, false);
    draw();
    draw();
  }
  void click(const std::string& control) { click(centreOf(control)); }
  void drag(glm::vec2 from, glm::vec2 to, int button = 0) {
    ui_->moveMouse(from);
    draw();
    ui_->press(button, true);
    draw();
    ui_->moveMouse(glm::mix(from, to, 0.5F));
    draw();
    ui_->moveMouse(to);
    draw();
    ui_->press(button, false);
    draw();
    draw();
  }
  void key(int number) {
    ui_->key(number, true);
    draw();
    ui_->key(number, false);
    draw();
  }

  std::filesystem::path folder_;
  std::unique_ptr<window::OffscreenUi> ui_;
  std::unique_ptr<Viewer> viewer_;
};

}  // namespace limen::viewer
