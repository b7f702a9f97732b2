// SPDX-License-Identifier: BSD-3-Clause
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class AdaptivePointPictures : public TechniqueTest {
 protected:
  static constexpr glm::ivec2 kSize{96, 72};
  static Rendered points(const scene::Scene& scene, Given given) {
    given.emplace("levels", int64_t{15});
    return render(scene, "many_lods/points", given, kSize, true);
  }
};

// All forms of cuts start from the root in the first frame, and all forms of pixels hold the nearest node;
// two words have 8 bits a channel, and the colours of nodes whose depths agree to 20 bits may mix.
TEST_F(AdaptivePointPictures, DoNotDependOnTheFormOfCutsAndPixels) {
  const scene::Scene scene = makeScene("sphere_grid");
  const Image first = points(scene, {{"pixels", std::string("two_passes")}}).product;
  for (const char* cuts : {"basic", "lazy"})
    EXPECT_EQ(
        points(scene, {{"pixels", std::string("two_passes")}, {"cuts", std::string(cuts)}}).product.data,
        first.data)
        << cuts;
  EXPECT_EQ(points(scene, {{"pixels", std::string("wide")}}).product.data, first.data);
  const Image words = points(scene, {{"pixels", std::string("two_words")}}).product;
  int different = 0;
  for (size_t i = 0; i < first.data.size(); ++i)
    different += std::abs(double(first.data[i]) - double(words.data[i])) > 0.5 / 255.0 + 1e-4 ? 1 : 0;
  EXPECT_LT(different, 0.01 * double(first.data.size()));
}

// Where points are larger than nodes may be, every tree's cut has all of them, and the picture does not
// depend on the tree.
TEST_F(AdaptivePointPictures, OfPointsAloneDoNotDependOnTheTree) {
  const scene::Scene scene = makeScene("sphere_grid");
  const Given all = {{"levels", int64_t{12}}, {"epsilon", 0.25}, {"pixels", std::string("two_passes")}};
  const Rendered complete = points(scene, all);
  Given given = all;
  given["balanced"] = false;
  EXPECT_EQ(points(scene, given).product.data, complete.product.data);
  for (const int64_t arity : {4, 8}) {
    given = all;
    given["cuts"] = std::string("incremental");
    given["cuts.arity"] = arity;
    EXPECT_EQ(points(scene, given).product.data, complete.product.data) << arity;
  }
}

// A coarser cut has a share of the nodes that falls with the square of their size, where points do not end
// it: by 16 from 4 to 16 pixels, 4 and more in practice as culled nodes stay.
TEST_F(AdaptivePointPictures, NodesFallWithTheirSize) {
  const scene::Scene scene = makeScene("sphere_grid");
  double before = 1e9;
  for (const double epsilon : {1.0, 4.0, 16.0}) {
    const double nodes = points(scene, {{"epsilon", epsilon}}).counter("cut_nodes");
    EXPECT_LT(nodes, epsilon > 4.0 ? 0.25 * before : before);
    before = nodes;
  }
}

// Within outlines the colour of the surface is met to a
// few percent, since light changes slowly there. Outlines of spheres, a pixel to either side, are less than a
// quarter of the picture's pixels.
TEST_F(AdaptivePointPictures, ShowWhatTheTrianglesShow) {
  const scene::Scene scene = makeScene("sphere_grid");
  const Image truth = render(scene, "antialiasing/one_sample", {}, kSize).product;
  const Image found = points(scene, {{"levels", int64_t{18}}}).product;
  int off = 0;
  for (int y = 0; y < truth.height; ++y)
    for (int x = 0; x < truth.width; ++x)
      off += std::abs(double(found.at(x, y)) - double(truth.at(x, y))) > 0.05 * double(truth.at(x, y)) + 0.01;
  EXPECT_LT(off, 0.25 * truth.width * truth.height);
}

}  // namespace
}  // namespace limen::techniques
