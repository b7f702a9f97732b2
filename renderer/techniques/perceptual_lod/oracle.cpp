// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/perceptual_lod/oracle.h"

#include <algorithm>
#include <cmath>

#include "perception/threshold_maps/reference.h"
#include "perception/thresholds/thresholds.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/perceptual_lod/level_view.h"

namespace limen::techniques {
namespace {

struct Picture {
  perception::Plane luminanceCdM2;
  std::vector<uint32_t> ids;
};

Picture pictureOf(frame::Frame& frame, const scene::LodSelection& selection,
                  const frame::ShadedSetting& shading, const perception::DisplayProfile& display) {
  frame.setLevels(selection);
  frame.begin();
  Picture out{perception::luminancePlane(frame.get<frame::Shaded>(shading).texture().read(), display),
              frame.get<frame::TriangleIds>().texture().readUint()};
  frame.end();
  return out;
}

}  // namespace

bool OracleVerdict::isVisible(const LevelRule& rule, int level) const {
  const auto at = static_cast<size_t>(level);
  return rule.measure(visiblePx.at(at), coveredPx.at(at)) > rule.upper();
}

int OracleVerdict::coarsestInvisible(const LevelRule& rule) const {
  int level = static_cast<int>(visiblePx.size()) - 1;
  while (level > 0 && isVisible(rule, level)) --level;
  return level;
}

bool OracleVerdict::seen() const {
  return std::any_of(coveredPx.begin(), coveredPx.end(), [](uint32_t count) { return count > 0; });
}

std::vector<OracleVerdict> searchLevels(frame::Frame& like, double timeS, const frame::ShadedSetting& shading,
                                        const SeenOn& seenOn) {
  const scene::Scene& scene = like.scene();
  frame::Frame frame(like.context(), scene, like.gpuScene(), like.sizePx(), timeS, like.raster());
  const scene::LodSelection finest = scene::finestLevels(scene);
  const Picture wanted = pictureOf(frame, finest, shading, seenOn.display);
  const perception::Plane threshold =
      perception::computeThresholds(wanted.luminanceCdM2, seenOn.display, seenOn.thresholds).thresholdCdM2;
  std::vector<OracleVerdict> out;
  for (size_t i = 0; i < scene.lodObjects.size(); ++i) {
    const scene::LodObject& object = scene.lodObjects[i];
    OracleVerdict verdict;
    verdict.coveredPx.assign(object.levels.size(), 0);
    verdict.visiblePx.assign(object.levels.size(), 0);
    const bool onScreen = !pixelsOf(object.bounds, frame).empty();
    const auto isOf = [&](uint32_t id, int level) {
      const scene::TriangleRange range = scene.triangles(object, level);
      return id >= range.first && id - range.first < range.count;
    };
    for (int level = 0; onScreen && level < static_cast<int>(object.levels.size()); ++level) {
      scene::LodSelection selection = finest;
      selection.levels[i] = level;
      const Picture offered = level == 0 ? wanted : pictureOf(frame, selection, shading, seenOn.display);
      for (size_t p = 0; p < wanted.ids.size(); ++p) {
        if (!isOf(wanted.ids[p], 0) && !isOf(offered.ids[p], level)) continue;
        ++verdict.coveredPx[static_cast<size_t>(level)];
        if (std::abs(offered.luminanceCdM2.data[p] - wanted.luminanceCdM2.data[p]) > threshold.data[p])
          ++verdict.visiblePx[static_cast<size_t>(level)];
      }
    }
    out.push_back(std::move(verdict));
  }
  return out;
}

OracleComparison compareWithOracle(const std::vector<OracleVerdict>& verdicts, const LevelRule& rule,
                                   const std::vector<int>& levels) {
  OracleComparison out;
  for (size_t i = 0; i < verdicts.size(); ++i) {
    if (!verdicts[i].seen()) continue;
    ++out.objectsSeen;
    const int difference = levels.at(i) - verdicts[i].coarsestInvisible(rule);
    out.levelsAbove += std::max(difference, 0);
    out.levelsBelow += std::max(-difference, 0);
    out.wrongInvisibleShare += verdicts[i].isVisible(rule, levels[i]) ? 1.0 : 0.0;
  }
  const double count = std::max(out.objectsSeen, 1);
  out.levelsAbove /= count;
  out.levelsBelow /= count;
  out.wrongInvisibleShare /= count;
  return out;
}

std::vector<Counter> countLevels(const scene::Scene& scene, const std::vector<int>& levels) {
  double sum = 0.0;
  for (const int level : levels) sum += level;
  return {{"triangles_drawn", static_cast<double>(scene::triangleCount(scene, {levels, true}))},
          {"mean_level", levels.empty() ? 0.0 : sum / static_cast<double>(levels.size())}};
}

void countOracle(frame::Frame& frame, double timeS, const frame::ShadedSetting& shading, const SeenOn& seenOn,
                 const LevelRule& rule, const std::vector<int>& levels, std::vector<Counter>& out) {
  const OracleComparison compared =
      compareWithOracle(searchLevels(frame, timeS, shading, seenOn), rule, levels);
  out.push_back({"wrong_invisible_share", compared.wrongInvisibleShare});
  out.push_back({"levels_above_oracle", compared.levelsAbove});
  out.push_back({"levels_below_oracle", compared.levelsBelow});
  out.push_back({"objects_seen", static_cast<double>(compared.objectsSeen)});
}

std::vector<Quantity> levelQuantities() {
  return {{"triangles_drawn", "Triangles drawn", "triangles", Direction::LowerIsBetter},
          {"mean_level", "Mean level", "levels", Direction::Neither},
          {"wrong_invisible_share", "Share of objects shown too coarsely", "", Direction::Neither},
          {"levels_above_oracle", "Levels coarser than the search's", "levels", Direction::Neither},
          {"levels_below_oracle", "Levels finer than the search's", "levels", Direction::Neither},
          {"objects_seen", "Objects seen", "objects", Direction::Neither}};
}

}  // namespace limen::techniques
