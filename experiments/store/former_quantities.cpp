// SPDX-License-Identifier: BSD-3-Clause
// What stores of schema 2 measured, listed here because such a store does not describe it. The list is
// closed: whatever is measured today is described in table `quantity`.
#include <algorithm>
#include <array>

#include "experiments/base/text.h"
#include "experiments/store/descriptions.h"

namespace limen::store {
namespace {

struct Former {
  const char *name, *title;
  Direction direction;
  const char* pass = "";
};

constexpr Direction kLower = Direction::LowerIsBetter, kHigher = Direction::HigherIsBetter,
                    kNeither = Direction::Neither;

constexpr std::array kFormer = {
    Former{"gpu_ms", "GPU time", kLower, "frame"},
    Former{"gpu_ms_p95", "Frame time, 95th percentile", kLower},
    Former{"technique_ms", "Frame time without the G-buffer", kLower},
    Former{"wall_ms", "Wall time", kLower, "wall"},
    Former{"cpu_ms", "CPU time", kLower, "cpu"},
    Former{"prepare_ms", "Preparation time", kLower},
    Former{"timed_frames", "Timed frames", kNeither},
    Former{"bytes_held", "Memory used", kLower},
    Former{"non_finite_count", "Non-finite values", kLower},
    Former{"gpu_clock_mhz", "GPU clock", kNeither},
    Former{"rmse", "RMSE", kLower},
    Former{"rmse_penumbra", "RMSE, penumbra", kLower},
    Former{"psnr", "PSNR", kHigher},
    Former{"ssim", "SSIM", kHigher},
    Former{"mae", "Mean absolute error", kLower},
    Former{"flip", "FLIP", kLower},
    Former{"de94", "CIE94 colour difference", kLower},
    Former{"largest_error", "Largest error", kLower},
    Former{"p99_error", "99th percentile of the error", kLower},
    Former{"relative_error", "Largest relative error", kLower},
    Former{"mean_relative_error", "Mean relative error", kLower},
    Former{"p99_relative_error", "99th percentile of the relative error", kLower},
    Former{"non_finite", "Non-finite values", kLower},
    Former{"signed_error", "Mean signed error", kNeither},
    Former{"acne", "Acne", kLower},
    Former{"leaks", "Light leaks", kLower},
    Former{"contact_gap", "Contact gap", kLower},
    Former{"band_step", "Band step", kLower},
    Former{"band_step_penumbra", "Band step, penumbra", kLower},
    Former{"seam_step", "Level discontinuity", kLower},
    Former{"seam_step_0.99", "Level discontinuity, 99th percentile", kLower},
    Former{"seam_step_0.999", "Level discontinuity, 99.9th percentile", kLower},
    Former{"block_artifacts", "Block artefacts", kLower},
    Former{"decision_flips", "Decision flips", kLower},
    Former{"detection_probability", "Probability of detection", kNeither},
    Former{"micro_occluders_per_px", "Micro-occluders per pixel", kLower},
    Former{"fetches_per_px", "Fetches per pixel", kLower},
    Former{"fetches_per_receiver", "Fetches per receiver", kLower},
    Former{"nodes_per_px", "Nodes per pixel", kLower},
    Former{"triangles_drawn", "Triangles drawn", kLower},
    Former{"examined_per_px", "Texels examined per pixel", kLower},
};

// Kinds of measurements that imply a direction: a counter is work done, a fact is not a figure of merit. For
// an error nothing is known: PSNR grows with quality, others fall.
std::optional<Direction> directionOfKind(const std::string& kind) {
  if (kind == "time" || kind == "counter") return kLower;
  return kind == "fact" ? std::optional(kNeither) : std::nullopt;
}

}  // namespace

QuantityRow formerQuantity(const std::string& name, const std::string& unit, const std::string& kind) {
  QuantityRow out{name, titleFromName(name, unit), unit, directionOfKind(kind), kind, "", ""};
  const auto found =
      std::find_if(kFormer.begin(), kFormer.end(), [&](const Former& one) { return name == one.name; });
  if (found == kFormer.end()) return out;
  out.title = found->title;
  out.direction = found->direction;
  out.pass = found->pass;
  return out;
}

}  // namespace limen::store
