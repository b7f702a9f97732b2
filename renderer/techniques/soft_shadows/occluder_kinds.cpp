// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/occluder_kinds.h"

#include <algorithm>
#include <cmath>

namespace limen::techniques {
namespace {

constexpr const char *kGapText = "Neighbours to which a rectangle is stretched to close gaps",
                     *kGapSource = "Schwarz 2009, section 4.1 (after Guennebaud 2006; diagonal: Bavoil 2008)";

}  // namespace

const SettingsTable<LimitedFill>& LimitedFill::table() {
  static const SettingsTable<LimitedFill> kTable = {
      {&LimitedFill::width,
       "width",
       {0.0, 4.0},
       "light",
       "Gaps up to this share of the light's width are filled, wider ones stay open",
       "own form"}};
  return kTable;
}

const SettingsTable<SearchCells>& SearchCells::table() {
  static const SettingsTable<SearchCells> kTable = {
      {&SearchCells::middle,
       "middle",
       {0.1, 1.0},
       "",
       "Width of the cells in the middle of the search area as a share of their mean width; 1: all are as "
       "wide. All depths that can block matter in the middle, only those nearest to the light at the rim",
       "own form"},
      {&SearchCells::leastWidth,
       "least_width",
       {0.0, 4.0},
       "texel",
       "Least width of the search area and of the light as projected onto the map; so narrower penumbrae "
       "are smooth over so many texels instead of jagged",
       "own form, as for windows of percentage-closer soft shadows"},
      {&SearchCells::spread,
       "spread",
       {0.0, 1.0},
       "",
       "Spread of the texels that stand for cells about their middles, in widths of a cell. 1: over the "
       "whole cell, so that edges hide as much as they should on average; 0: in the middle, where a leaning "
       "surface has its mean depth",
       "own form"},
      {&SearchCells::share,
       "share",
       {0.01, 1.0},
       "",
       "Share of the budget that cells use. Levels use about half on average, cells all that they may: by "
       "default 12 x 12 of a budget of 256",
       "own form"}};
  return kTable;
}

void SearchCells::configure(const gl::Program& program) const {
  program.set("middleWidth", static_cast<float>(middle));
  program.set("shareRoot", static_cast<float>(std::sqrt(share)));
  program.set("texelsSpread", static_cast<uint32_t>(std::lround(spread * double{1 << 16})));
  program.set("leastWidth", static_cast<float>(leastWidth));
}

int allowedPerAxis(int64_t budget) {
  return budget == 0 ? 1 << 14 : std::max(1, static_cast<int>(std::floor(std::sqrt(double(budget)))));
}

const SettingsTable<Micropatches>& Micropatches::table() {
  static const SettingsTable<Micropatches> kTable = {
      coarseDepthsBinding<Micropatches>(),
      {&Micropatches::division, "division",
       "Division of the search area into micro-occluders: into texels of one level of the pyramid or into "
       "cells of any size",
       "Schwarz 2009, section 4.1 (levels); cells: own form"},
      Binding(&Micropatches::gapFill, "gap_fill", kGapText, kGapSource).formerly({"gap_fill"})};
  return kTable;
}

const SettingsTable<Microrects>& Microrects::table() {
  static const SettingsTable<Microrects> kTable = {
      {&Microrects::gapFill, "gap_fill", kGapText, kGapSource},
      Binding(&Microrects::mergeMetric, "merge_metric",
              "Depth difference that decides which of two neighbours a microrect is merged with: absolute, "
              "or as a share of the nearer one's depth",
              "Schwarz 2009, section 4.5.2 (absolute)")
          .formerly({"merge_metric"}),
      Binding(&Microrects::diagonalMerge, "diagonal_merge",
              "Neighbour that absorbs a microrect dropped on both axes: the lower left one if it spans it "
              "already, otherwise the upper right one; or the closest in depth of the four",
              "Schwarz 2009, section 4.5.2 (contained)")
          .formerly({"diagonal_merge"})};
  return kTable;
}

}  // namespace limen::techniques
