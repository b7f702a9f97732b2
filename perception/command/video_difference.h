// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "perception/command/figures.h"
#include "perception/command/image_input.h"
#include "perception/command/image_metrics.h"
#include "perception/command/settings_text.h"

namespace limen::perception {

/// ColorVideoVDP in `compare`: of single images, and of sequences as videos.
class VideoDifference {
 public:
  static constexpr const char* kName = "color_video_vdp";
  /// Of a whole video.
  static constexpr const char* kVideoName = "color_video_vdp_video";

  /// Its settings, for --set; the display is that of the call unless set.
  static SettingsGroup settings(const std::string& displayName);

  /// `frames` pairs follow, at `framesPerSecond`; 0: each is an image of its own. Throws Error on bad
  /// settings.
  VideoDifference(const ParameterValues& settings, const std::string& displayName, size_t frames,
                  double framesPerSecond);
  ~VideoDifference();
  VideoDifference(const VideoDifference&) = delete;
  VideoDifference& operator=(const VideoDifference&) = delete;

  /// What add() and finish() return, without values.
  static Figures declared(bool video);
  /// The next frame: its score alone. Coded pictures are shown as coded, light relative to white. `maps` (may
  /// be null) receives the frame's map. Throws Error.
  Figures add(const InputImage& test, const InputImage& reference, std::vector<MetricMap>* maps);
  /// Of a video: the score of all frames.
  Figures finish();
  bool isVideo() const { return framesPerSecond_ > 0.0 && frames_ > 1; }
  /// "8.548 JOD ..." as a sentence about a video.
  std::string sentence(const Figures& overall) const;
  /// Display, device and the differences by channel and band, for the result.
  const nlohmann::json& facts() const { return facts_; }

 private:
  struct Settings;
  struct Gpu;

  std::unique_ptr<Settings> settings_;
  size_t frames_;
  double framesPerSecond_;
  std::unique_ptr<Gpu> gpu_;
  std::string noGpu_;
  nlohmann::json facts_;
};

}  // namespace limen::perception
