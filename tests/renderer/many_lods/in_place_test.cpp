// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/in_place_cuts.h"

#include <epoxy/gl.h>

#include "experiments/base/error.h"
#include "renderer/compute/scan.h"
#include "renderer/many_lods/gpu_tree.h"
#include "tests/renderer/many_lods/flag_scan_test_bindings.h"
#include "tests/renderer/many_lods/many_lods_fixture.h"

namespace limen::many_lods {
namespace {

class FlagScans : public gl::GlTest {};

TEST_F(FlagScans, CountFlagsBeforeEachInvocation) {
  constexpr uint32_t kGroup = 256, kGroups = 40;
  std::mt19937 random(3);
  std::vector<uint32_t> flags(kGroup * kGroups);
  for (uint32_t i = 0; i < flags.size(); ++i) {
    const uint32_t group = i / kGroup;
    flags[i] = group == 0 ? 0U : group == 1 ? 1U : uint32_t(random() % 8 < group % 8);
  }
  for (const FlagScan scan : {FlagScan::Sweep, FlagScan::Ballot}) {
    const gl::Buffer in(flags), out(int64_t{8} * int64_t(flags.size()), nullptr);
    const gl::Program& program =
        context().programs().compute("tests/renderer/many_lods/flag_scan_test.comp.glsl",
                                     {{"FLAG_SCAN", std::to_string(flagScanForm(scan))}});
    in.bindStorage(kTestFlagsBuffer);
    out.bindStorage(kTestCountsBuffer);
    program.use();
    glDispatchCompute(kGroups, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    const std::vector<glm::uvec2> found = out.read<glm::uvec2>();
    for (uint32_t group = 0; group < kGroups; ++group) {
      uint32_t before = 0;
      for (uint32_t i = 0; i < kGroup; ++i) {
        ASSERT_EQ(found[group * kGroup + i].x, before) << toText(scan) << ", group " << group << ", " << i;
        before += flags[group * kGroup + i];
      }
      for (uint32_t i = 0; i < kGroup; ++i) ASSERT_EQ(found[group * kGroup + i].y, before);
    }
  }
}

// Holländer 2013, section 3.7.1.
TEST_F(FlagScans, ScanOfTheThesis) {
  const std::vector<uint32_t> values = {2, 3, 1, 0, 4, 2, 1, 2};
  const gl::Buffer in(values), out(int64_t{32}, nullptr);
  for (const compute::ScanAlgorithm algorithm :
       {compute::ScanAlgorithm::Blelloch, compute::ScanAlgorithm::HillisSteele}) {
    compute::ScanSettings settings{.algorithm = algorithm};
    settings.range = compute::ScanRange::Exclusive;
    compute::Scan(context(), 8, settings).run(in, out, 8);
    EXPECT_EQ(out.read<uint32_t>(), (std::vector<uint32_t>{0, 2, 5, 6, 6, 10, 12, 13}));
    settings.range = compute::ScanRange::Inclusive;
    compute::Scan(context(), 8, settings).run(in, out, 8);
    EXPECT_EQ(out.read<uint32_t>(), (std::vector<uint32_t>{2, 5, 6, 6, 10, 12, 13, 15}));
  }
}

class InPlace : public gl::GlTest {};

// The least depth of a pixel does not depend on the order of drawing, so that the tiles of the same cuts are
// the same to the last bit.
TEST_F(InPlace, TilesEqualThoseOfListedCuts) {
  constexpr int kDepth = 11;
  const SphereTree tree = treeOf(bumpyBalls(), kDepth);
  const GpuTree onGpu(context(), tree);
  std::mt19937 random(21);
  std::vector<CutView> views;
  for (int i = 0; i < 150; ++i) views.push_back(anyView(random, tree, 1.5));
  const gl::Buffer onGpuViews(views);
  const auto count = uint32_t(views.size());
  MultiCut cut(context(), count, kDepth, 1U << 19, BasicCuts{});
  cut.update(onGpu.nodes(), onGpuViews);
  const ViewAtlas listed(context(), count, glm::ivec2(16), AtlasForm::Depth);
  const ViewAtlas::Settings settings{.nearest = 0.01F};
  listed.draw(cut, onGpu.nodes(), onGpuViews, settings);
  const std::vector<uint32_t> expected = listed.depths().read<uint32_t>();
  uint32_t drawn = 0;
  for (const glm::uvec2 entry : cut.list())
    drawn += isCulled(tree.spheres[entry.x], entry.x, tree.leafCount(), views[entry.y]) ? 0 : 1;
  for (const FlagScan scan : {FlagScan::Sweep, FlagScan::Ballot})
    for (const int finders : {32, 64, 128})
      for (const int perGroup : {1, 7, 16}) {
        const InPlaceCuts cuts(context(), count, kDepth,
                               {.finders = finders, .viewsPerGroup = perGroup, .scan = scan});
        const ViewAtlas atlas(context(), count, glm::ivec2(16), AtlasForm::Depth);
        cuts.draw(onGpu.nodes(), onGpuViews, atlas, settings);
        ASSERT_EQ(cuts.counts().unfinished, 0U);
        ASSERT_EQ(atlas.depths().read<uint32_t>(), expected)
            << finders << " finders, " << perGroup << " views";
        const InPlaceCounts counts = cuts.counts();
        EXPECT_EQ(counts.refused, 0U);
        EXPECT_EQ(counts.drawn, drawn);
        EXPECT_LE(counts.deepest, cuts.stackBound());
        // Not a bound that nothing comes near to: a finder for each level is reached by half of them.
        EXPECT_GT(counts.deepest, uint32_t(finders));
      }
}

TEST_F(InPlace, RefusesStacksThatDoNotFit) {
  EXPECT_THROW((InPlaceSettings{.finders = 128, .finished = 8}.check()), Error);
  EXPECT_THROW((InPlaceSettings{.finders = 32, .viewsPerGroup = 33}.check()), Error);
  EXPECT_NO_THROW(InPlaceSettings{}.check());
}

}  // namespace
}  // namespace limen::many_lods
