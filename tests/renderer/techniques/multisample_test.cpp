// SPDX-License-Identifier: BSD-3-Clause
// Visibility for one sample a pixel: what samples see against rays, the resolve against a twin on the CPU and
// known edges.
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "experiments/base/error.h"
#include "renderer/techniques/soft_shadows/multisample/multisample_bindings.h"
#include "renderer/techniques/soft_shadows/multisample/multisample_ids.h"
#include "tests/renderer/frame/brute_force.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr int kSamples = 4;  // what every driver has

/// Depths of all samples and of the chosen ones, and the visibility of these: what the resolve works on.
struct MultisampleView {
  glm::ivec2 sizePx;
  std::vector<std::array<float, kSamples>> samples;
  Image depths, visibility;
  explicit MultisampleView(glm::ivec2 size)
      : sizePx(size),
        samples(static_cast<size_t>(size.x * size.y)),
        depths(size.x, size.y, 1),
        visibility(size.x, size.y, 1) {}
};

struct ResolveSetting {
  int neighbours = 4;
  float tolerance = 0.01F;
  bool interpolate = true;
};

class MultisampleResolve : public TechniqueTest {
 protected:
  static Image resolve(const MultisampleView& view, const ResolveSetting& setting) {
    const gl::Texture sampleDepths(gl::Format::R32F, view.sizePx, 1, kSamples),
        depths(gl::Format::R32F, view.sizePx), visibility(gl::Format::R32F, view.sizePx),
        out(gl::Format::R32F, view.sizePx);
    std::vector<float> layer(view.samples.size());
    for (int k = 0; k < kSamples; ++k) {
      for (size_t i = 0; i < layer.size(); ++i) layer[i] = view.samples[i][static_cast<size_t>(k)];
      glTextureSubImage3D(sampleDepths.id(), 0, 0, 0, k, view.sizePx.x, view.sizePx.y, 1, GL_RED, GL_FLOAT,
                          layer.data());
    }
    depths.write(view.depths);
    visibility.write(view.visibility);
    const gl::Program& program =
        context().programs().compute("renderer/techniques/soft_shadows/multisample/resolve.comp.glsl");
    program.set("sizePx", view.sizePx);
    program.set("samples", kSamples);
    program.set("neighbours", setting.neighbours);
    program.set("tolerance", setting.tolerance);
    program.set("interpolate", setting.interpolate ? 1 : 0);
    sampleDepths.bindTexture(kSampleResolveSampleDepthsUnit);
    depths.bindTexture(kSampleResolveDepthsUnit);
    visibility.bindTexture(kSampleResolveVisibilityUnit);
    out.bindImage(kSampleResolveVisibilityImage, gl::Access::Write);
    program.dispatch(view.sizePx);
    return out.read();
  }

  /// The rule of Schwarz 2009, section 4.6, in words of its own: candidates in a list, sorted by how close
  /// they are.
  static double expected(const MultisampleView& view, const ResolveSetting& setting, int x, int y) {
    const auto at = [&](int u, int v) { return static_cast<size_t>(v * view.sizePx.x + u); };
    double sum = 0.0;
    for (const float z : view.samples[at(x, y)]) {
      if (!(z > 0.0F)) {
        sum += 1.0;
        continue;
      }
      struct Candidate {
        float apart;
        float visibility;
      };
      std::vector<Candidate> candidates;
      const auto add = [&](int u, int v) {
        if (u < 0 || v < 0 || u >= view.sizePx.x || v >= view.sizePx.y) return;
        const float depth = view.depths.data[at(u, v)];
        if (depth > 0.0F) candidates.push_back({std::abs(z - depth), view.visibility.data[at(u, v)]});
      };
      add(x, y);
      const bool own = !candidates.empty();
      if (own && (!setting.interpolate || candidates[0].apart <= setting.tolerance * z)) {
        sum += candidates[0].visibility;
        continue;
      }
      if (setting.interpolate) {
        add(x - 1, y), add(x + 1, y), add(x, y - 1), add(x, y + 1);
        if (setting.neighbours == 8)
          add(x - 1, y - 1), add(x + 1, y - 1), add(x - 1, y + 1), add(x + 1, y + 1);
      }
      const auto best =
          std::min_element(candidates.begin(), candidates.end(),
                           [](const Candidate& a, const Candidate& b) { return a.apart < b.apart; });
      sum += best == candidates.end() ? 1.0 : best->visibility;
    }
    return sum / kSamples;
  }
};

TEST_F(MultisampleResolve, IsTheRuleOnRandomDepthsAndVisibilities) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
  MultisampleView view({33, 18});
  for (size_t i = 0; i < view.samples.size(); ++i) {
    // Few depths, so that samples find partners; some surfaces turn away from the light, some samples see
    // none.
    const auto depth = [&] {
      const float z = 1.0F + std::floor(4.0F * uniform(engine)) + 0.02F * uniform(engine),
                  kind = uniform(engine);
      return kind < 0.1F ? 0.0F : kind < 0.2F ? -z : z;
    };
    for (float& sample : view.samples[i]) sample = depth();
    view.depths.data[i] = view.samples[i][0];
    view.visibility.data[i] = uniform(engine);
  }
  for (const int neighbours : {4, 8})
    for (const bool interpolate : {true, false})
      for (const float tolerance : {0.0F, 0.005F, 0.05F}) {
        const ResolveSetting setting{neighbours, tolerance, interpolate};
        const Image out = resolve(view, setting);
        for (int y = 0; y < view.sizePx.y; ++y)
          for (int x = 0; x < view.sizePx.x; ++x)
            // Four values added in float, each at most 1.
            ASSERT_NEAR(out.data[static_cast<size_t>(y * view.sizePx.x + x)], expected(view, setting, x, y),
                        4.0 * 0x1p-24)
                << neighbours << interpolate << tolerance << " " << x << " " << y;
      }
}

/// A dark near surface left of a straight edge, a lit far one right of it. Every pixel has a neighbour wholly
/// on either surface, so that the mean is the covered share itself; without interpolation it is 0 or 1.
TEST_F(MultisampleResolve, GivesAnEdgeTheShareOfSamplesOnEitherSide) {
  constexpr std::array<glm::vec2, kSamples> kPlaces = {glm::vec2(0.375F, 0.125F), glm::vec2(0.875F, 0.375F),
                                                       glm::vec2(0.125F, 0.625F), glm::vec2(0.625F, 0.875F)};
  MultisampleView view({24, 30});
  std::vector<double> share(view.samples.size());
  const auto isNear = [](glm::vec2 place) { return place.x + 0.3F * place.y < 13.2F; };
  for (int y = 0; y < view.sizePx.y; ++y)
    for (int x = 0; x < view.sizePx.x; ++x) {
      const auto i = static_cast<size_t>(y * view.sizePx.x + x);
      int lit = 0;
      for (int k = 0; k < kSamples; ++k) {
        const bool near = isNear(glm::vec2(x, y) + kPlaces[static_cast<size_t>(k)]);
        view.samples[i][static_cast<size_t>(k)] = near ? 2.0F : 5.0F;
        lit += near ? 0 : 1;
      }
      share[i] = lit / double(kSamples);
      view.depths.data[i] = view.samples[i][0];
      view.visibility.data[i] = view.depths.data[i] < 3.0F ? 0.0F : 1.0F;
    }
  const Image interpolated = resolve(view, {}), centre = resolve(view, {4, 0.01F, false});
  int edges = 0;
  for (size_t i = 0; i < share.size(); ++i) {
    EXPECT_EQ(interpolated.data[i], share[i]);
    EXPECT_EQ(centre.data[i], view.visibility.data[i]);
    edges += share[i] > 0.0 && share[i] < 1.0;
  }
  EXPECT_GT(edges, 10);
}

TEST_F(MultisampleResolve, LeavesABackgroundLit) {
  MultisampleView view({9, 7});
  for (float& value : view.visibility.data) value = 0.25F;
  for (const float value : resolve(view, {}).data) EXPECT_EQ(value, 1.0F);
  // A lone sample without any surface beside it: nothing is known, and nothing is shadowed.
  view.samples[30][2] = 3.0F;
  for (const float value : resolve(view, {}).data) EXPECT_EQ(value, 1.0F);
}

class MultisampleShadows : public TechniqueTest {};

TEST_F(MultisampleShadows, SamplesSeeWhatRaysThroughTheirPlacesSee) {
  const scene::Scene scene = makeScene("two_boxes");
  const frame::GpuScene gpuScene(scene);
  const glm::ivec2 sizePx(33, 26);
  frame::Frame frame(context(), scene, gpuScene, sizePx);
  const MultisampleIds ids(frame, kSamples);
  ASSERT_EQ(ids.places().size(), size_t{kSamples});
  const glm::ivec2 tallPx(sizePx.x, sizePx.y * kSamples);
  const gl::Texture spread(gl::Format::R32UI, tallPx), places(gl::Format::RG32F, tallPx);
  const gl::Program& program =
      context().programs().compute("renderer/techniques/soft_shadows/multisample/spread.comp.glsl",
                                   {{"SAMPLES", std::to_string(kSamples)}});
  program.set("sizePx", sizePx);
  for (int k = 0; k < kSamples; ++k)
    program.set(("samplePlaces[" + std::to_string(k) + "]").c_str(), ids.places()[static_cast<size_t>(k)]);
  frame.begin();
  ids.draw(frame);
  ids.bindTexture(kSampleIdsUnit);
  spread.bindImage(kSamplePointIdsImage, gl::Access::Write);
  places.bindImage(kSamplePlacesImage, gl::Access::Write);
  program.dispatch(sizePx);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  frame.end();
  const std::vector<uint32_t> seen = spread.readUint();
  const Image written = places.read();
  const frame::BruteForce truth(scene, gpuScene.anchor());
  const glm::dmat4 toWorld = glm::inverse(frame.anchorToCamera());
  const glm::dvec3 eye(toWorld[3]);
  int edges = 0, wrong = 0;
  for (int y = 0; y < tallPx.y; ++y)
    for (int x = 0; x < tallPx.x; ++x) {
      const auto i = static_cast<size_t>(y * tallPx.x + x);
      const glm::dvec2 place(written.data[2 * i], written.data[2 * i + 1]);
      const auto trace = [&](glm::dvec2 offset) {
        const glm::dvec2 ndc =
            glm::dvec2(2.0, -2.0) * (place + offset) / glm::dvec2(sizePx) + glm::dvec2(-1.0, 1.0);
        const glm::dvec3 ray(ndc.x * frame.tanHalfFov() * frame.aspect(), ndc.y * frame.tanHalfFov(), -1.0);
        return truth.trace(eye, glm::dvec3(toWorld * glm::dvec4(ray, 0.0)), 0.0).triangle;
      };
      bool found = trace(glm::dvec2(0.0)) == seen[i];
      edges += !found;
      for (const glm::dvec2 offset : frame::snappingOffsets()) found = found || trace(offset) == seen[i];
      wrong += !found;
    }
  EXPECT_EQ(wrong, 0);
  // Snapping matters beside edges alone.
  EXPECT_LT(edges, tallPx.x * tallPx.y / 50);
}

TEST_F(MultisampleShadows, OneSampleIsTheInnerTechniqueBitForBit) {
  const scene::Scene scene = makeScene("two_boxes");
  const glm::ivec2 sizePx(41, 30);
  for (const char* inner : {"backprojection", "bitmask"}) {
    const std::string plain = std::string("soft_shadows/") + inner;
    const Rendered full = render(scene, plain, withMaps(plain, 256), sizePx);
    for (const char* method : {"interpolate", "centre", "per_sample"}) {
      const Given given =
          withMaps("soft_shadows/multisample", 256,
                   {{"inner", std::string(inner)}, {"samples", int64_t{1}}, {"method", std::string(method)}});
      const Rendered multisample = render(scene, "soft_shadows/multisample", given, sizePx, true);
      EXPECT_EQ(multisample.product.data, full.product.data) << method << " " << inner;
    }
    const Given given =
        withMaps("soft_shadows/supersampled", 256, {{"inner", std::string(inner)}, {"samples", int64_t{1}}});
    EXPECT_EQ(render(scene, "soft_shadows/supersampled", given, sizePx).product.data, full.product.data)
        << inner;
  }
}

TEST_F(MultisampleShadows, SupersamplingIsTheMeanOfALargerPicture) {
  const scene::Scene scene = makeScene("pole");
  const Given map = withMaps("soft_shadows/backprojection", 256);
  const Given given = withMaps("soft_shadows/supersampled", 256, {{"samples", int64_t{3}}});
  const Image mean = render(scene, "soft_shadows/supersampled", given, {20, 15}).product;
  const Image large = render(scene, "soft_shadows/backprojection", map, {60, 45}).product;
  for (int y = 0; y < 15; ++y)
    for (int x = 0; x < 20; ++x) {
      double sum = 0.0;
      for (int v = 0; v < 3; ++v)
        for (int u = 0; u < 3; ++u) sum += large.data[static_cast<size_t>((3 * y + v) * 60 + 3 * x + u)];
      EXPECT_NEAR(mean.data[static_cast<size_t>(y * 20 + x)], sum / 9.0, 9.0 * 0x1p-24);
    }
}

/// Against a visibility for every sample. Squares, since what matters is the few pixels at edges, not the
/// many on which one place differs a little from four.
TEST_F(MultisampleShadows, InterpolationErrsLessThanTheCentreOnTwigsAndPoles) {
  const scene::Scene scene = makeScene("street_light", {{"branching", int64_t{3}}});
  const glm::ivec2 sizePx(128, 96);
  const auto made = [&](const Given& given, bool counting = false) {
    return render(scene, "soft_shadows/multisample", withMaps("soft_shadows/multisample", 512, given), sizePx,
                  counting);
  };
  const Rendered all = made({{"method", std::string("per_sample")}}, true);
  const Rendered interpolated = made({}, true), centre = made({{"method", std::string("centre")}}, true);
  double interpolationError = 0.0, centreError = 0.0;
  for (size_t i = 0; i < all.product.data.size(); ++i) {
    const double reference = all.product.data[i], a = interpolated.product.data[i] - reference,
                 b = centre.product.data[i] - reference;
    interpolationError += a * a, centreError += b * b;
  }
  EXPECT_LT(interpolationError, centreError);
  EXPECT_GT(interpolated.counter("complex_share"), 0.0);
  EXPECT_LT(interpolated.counter("complex_share"), 0.5);
  // Both see the same pixels; only one of the two looks for better.
  EXPECT_EQ(interpolated.counter("complex_share"), centre.counter("complex_share"));
  EXPECT_LT(interpolated.counter("orphan_share"), centre.counter("orphan_share"));
  EXPECT_EQ(centre.counter("borrowed_share"), 0.0);
  // One point a pixel against four.
  EXPECT_LE(interpolated.counter("inner_evaluations_per_px"), 1.0);
  EXPECT_GT(all.counter("inner_evaluations_per_px"), 3.0 * interpolated.counter("inner_evaluations_per_px"));
}

TEST_F(MultisampleShadows, RendersOnePixelAndEveryRepresentative) {
  const scene::Scene scene = makeScene("street_light", {{"branching", int64_t{2}}});
  for (const char* representative : {"first", "nearest", "farthest", "median"})
    for (const glm::ivec2 sizePx : {glm::ivec2(1, 1), glm::ivec2(13, 7)}) {
      const Rendered out = render(scene, "soft_shadows/multisample",
                                  withMaps("soft_shadows/multisample", 128,
                                           {{"method.representative", std::string(representative)},
                                            {"method.depth_at", std::string("sample")},
                                            {"method.neighbours", int64_t{8}}}),
                                  sizePx);
      for (const float value : out.product.data)
        EXPECT_TRUE(value >= 0.0F && value <= 1.0F) << representative;
    }
}

TEST_F(MultisampleShadows, WhatMeansNothingBesideTheMethodCannotBeWritten) {
  const auto accepted = [](const Given& given) { return !refusal("soft_shadows/multisample", given); };
  EXPECT_TRUE(accepted({}));
  EXPECT_TRUE(
      accepted({{"method", std::string("centre")}, {"method.representative", std::string("median")}}));
  EXPECT_FALSE(accepted({{"method", std::string("centre")}, {"method.tolerance", 0.05}}));
  EXPECT_FALSE(
      accepted({{"method", std::string("per_sample")}, {"method.representative", std::string("median")}}));
  EXPECT_FALSE(accepted({{"inner.samples", int64_t{64}}}));
  EXPECT_FALSE(accepted({{"inner", std::string("ray_traced")}, {"inner.budget.limit", int64_t{25}}}));
}

}  // namespace
}  // namespace limen::techniques
