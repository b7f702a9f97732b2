// SPDX-License-Identifier: BSD-3-Clause
// Seams between levels of quality: what the technique counts of them against images of uniform levels, which
// know nothing of choices, and what follows from how levels are blended.
#include "renderer/techniques/soft_shadows/quality/level_steps.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/techniques/soft_shadows/search_technique.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr const char *kByArea = "soft_shadows/backprojection", *kByMask = "soft_shadows/bitmask";
constexpr glm::ivec2 kStepSize(48, 36);

/// What a technique chose for each pixel and counted of it.
struct Stepped {
  Image visibility, afterwards;  // the product before and after counting
  Image positions, normals;
  PixelCounts counted;
  std::optional<LevelSteps> steps;
  std::map<std::string, double> counters;

  bool processed(size_t pixel) const { return counted.work[4 * pixel] == Processed; }
  double level(size_t pixel) const { return std::bit_cast<float>(counted.search[4 * pixel + 3]); }
};

/// One neighbour of a pixel as it ought to be.
struct SteppedPair {
  size_t pixel;
  double change, step;  // of the choice, and of the visibility
};

class LevelStep : public TechniqueTest {
 protected:
  static ParameterValue text(const std::string& value) { return value; }

  /// Without a structure a pixel's search area is the same whatever its level, and all pixels that see the
  /// map are processed: a render of one level for all says what any pixel has of it.
  static Given common() {
    return {{"resolution", int64_t{128}},
            {"structure", text("none")},
            {"refinements", int64_t{0}},
            {"occluders.division", text("levels")}};
  }
  static Given with(Given given, const Given& more) {
    for (const auto& [name, value] : more) given[name] = value;
    return given;
  }

  static Stepped count(const scene::Scene& scene, const std::string& technique, const Given& given,
                       glm::ivec2 sizePx) {
    const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
    const ParameterValues values(info.parameters, given);
    if (info.check) info.check(values);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, sizePx);
    const auto made = info.make(values);
    made->prepare(frame);
    frame.begin();
    made->render(frame);
    Stepped out;
    out.visibility = made->product().read();
    const auto channel = [&](frame::Channel which) {
      return frame.get<frame::GBufferChannel>(frame::ChannelSetting{which}).texture().read();
    };
    out.positions = channel(frame::Channel::Position);
    out.normals = channel(frame::Channel::Normal);
    frame.end();
    for (const Counter& counter : made->count(frame)) out.counters[counter.name] = counter.value;
    out.afterwards = made->product().read();
    const auto& search = dynamic_cast<const SearchTechnique&>(*made);
    out.counted = search.counted();
    out.steps = search.levelSteps();
    return out;
  }

  /// Visibility of a sphere_grid of kStepSize by a level alone.
  static const Image& uniformLevel(const std::string& technique, int level) {
    static std::map<std::pair<std::string, int>, Image> known;
    Image& image = known[{technique, level}];
    if (image.data.empty())
      image = render(makeScene("sphere_grid"), technique,
                     with(common(), {{"levels", std::string("fixed")}, {"levels.level", int64_t{level}}}),
                     kStepSize)
                  .product;
    return image;
  }
};

/// Sine of the angle of the line between two pixels' points to the tangent plane that it leaves by more.
double sineBetween(const Stepped& of, size_t a, size_t b) {
  const auto vectorAt = [](const Image& image, size_t pixel) {
    return glm::dvec3(image.data[4 * pixel], image.data[4 * pixel + 1], image.data[4 * pixel + 2]);
  };
  const glm::dvec3 line = vectorAt(of.positions, b) - vectorAt(of.positions, a);
  double most = 0.0;
  for (const size_t pixel : {a, b})
    most = std::max(most, std::abs(glm::dot(vectorAt(of.normals, pixel), line)));
  return most / glm::length(line);
}

/// Share of the coarser level, from the definitions of the choices.
double coarserShare(const std::string& levels, double level, int x, int y) {
  const double fraction = level - std::floor(level);
  if (levels == "narrow_blend") return std::clamp((fraction - 0.45) / 0.1, 0.0, 1.0);
  if (levels == "blend") return fraction;
  if (levels != "dither") return 0.0;
  // Roberts's sequence, of the plastic number, the real root of g^3 = g + 1.
  const double plastic = 1.324717957244746, turn = x / plastic + y / (plastic * plastic);
  return fraction > turn - std::floor(turn) ? 1.0 : 0.0;
}

// An image of a level and one of a choice come of one loop over the same micro-occluders: at most 12^2 at the
// finer level of a budget of 5^2, four times as many at a neighbour's if that is finer by one, 16 times by
// two. Sums of 16 * 12^2 terms, which stop within a row of where they reach 1, err by less than 2,304 * 2^-24
// = 1.4e-4 if a compiler orders them otherwise. Masks have 256 samples, and none of them may flip.
TEST_F(LevelStep, IsWhatUniformLevelsDifferBy) {
  struct Tried {
    const char *technique, *levels;
    Given given;
  };
  const std::vector<Tried> all = {{kByArea, "finest_within", {}},
                                  {kByArea, "narrow_blend", {}},
                                  {kByArea, "dither", {}},
                                  {kByArea, "blend", {{"passes", text("split")}}},
                                  {kByMask, "blend", {}}};
  const scene::Scene scene = makeScene("sphere_grid");
  const glm::ivec2 size = kStepSize;
  for (const Tried& tried : all) {
    SCOPED_TRACE(testing::Message() << tried.technique << ' ' << tried.levels << ' ' << tried.given.size());
    const std::string levels = tried.levels;
    const Given given =
        with(with(common(), tried.given), {{"levels", text(levels)}, {"budget.limit", int64_t{25}}});
    const Stepped found = count(scene, tried.technique, given, size);
    ASSERT_TRUE(found.steps);
    EXPECT_EQ(found.visibility.data, found.afterwards.data);
    const auto choice = [&](size_t pixel) {
      const int x = static_cast<int>(pixel) % size.x, y = static_cast<int>(pixel) / size.x;
      return std::floor(found.level(pixel)) + coarserShare(levels, found.level(pixel), x, y);
    };
    const auto visibility = [&](size_t pixel, double at) {
      const int finer = static_cast<int>(at);
      const double fine = uniformLevel(tried.technique, finer).data[pixel], share = at - finer;
      if (share == 0.0) return fine;
      return glm::mix(fine, double{uniformLevel(tried.technique, finer + 1).data[pixel]}, share);
    };
    std::vector<SteppedPair> pairs;
    int apart = 0, processed = 0, unclear = 0;
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const auto p = static_cast<size_t>(y * size.x + x);
        ASSERT_EQ(found.steps->own.data[2 * p + 1] >= 0.0F, found.processed(p));
        if (!found.processed(p)) continue;
        ++processed;
        ASSERT_NEAR(found.steps->own.data[2 * p + 1], choice(p), 1e-5);
        for (const bool right : {true, false}) {
          const Image& neighbour = right ? found.steps->right : found.steps->below;
          const float other = neighbour.data[2 * p + 1];
          const size_t q = right ? p + 1 : p + static_cast<size_t>(size.x);
          if ((right ? x + 1 == size.x : y + 1 == size.y) || !found.processed(q)) {
            ASSERT_EQ(other, -1.0F) << x << ' ' << y;
            continue;
          }
          const double sine = sineBetween(found, p, q);
          if (std::abs(sine - std::sin(std::numbers::pi / 12.0)) < 1e-5) {
            ++unclear;
            continue;
          }
          const bool one = sine < std::sin(std::numbers::pi / 12.0);
          apart += !one;
          ASSERT_EQ(other >= 0.0F, one) << x << ' ' << y;
          if (!one) continue;
          ASSERT_NEAR(other, choice(q), 1e-5);
          const double step = other == found.steps->own.data[2 * p + 1]
                                  ? 0.0
                                  : std::abs(double{found.steps->own.data[2 * p]} - neighbour.data[2 * p]);
          pairs.push_back({p, choice(q) - choice(p), step});
          ASSERT_NEAR(step, std::abs(visibility(p, choice(p)) - visibility(p, choice(q))), 2e-4)
              << x << ' ' << y << ": " << choice(p) << " and " << choice(q);
        }
      }
    EXPECT_GT(apart, 20);
    EXPECT_EQ(unclear, 0);
    // The facts, from what was found right pair by pair.
    std::vector<double> steps;
    double sum = 0.0;
    for (const SteppedPair& pair : pairs) {
      if (pair.change != 0.0) steps.push_back(pair.step);
      sum += pair.step;
    }
    ASSERT_GT(steps.size(), 30U);
    std::sort(steps.begin(), steps.end());
    EXPECT_GT(steps.back(), 0.01);
    EXPECT_DOUBLE_EQ(found.counters.at("level_step_max"), steps.back());
    EXPECT_NEAR(found.counters.at("level_step_mean"), sum / double(pairs.size()), 1e-9);
    EXPECT_NEAR(found.counters.at("level_changes_per_px"), double(steps.size()) / processed, 1e-9);
  }
}

LevelSteps rowOfSteps(int pairs) {
  // Pixel i steps by i / 1024 to its neighbour on the right, which chose another level.
  LevelSteps steps{Image(pairs + 2, 1, 2), Image(pairs + 2, 1, 2), Image(pairs + 2, 1, 2, -1.0F)};
  for (int i = 0; i < pairs + 2; ++i) {
    steps.own.at(i, 0, 0) = 0.5F;
    steps.own.at(i, 0, 1) = static_cast<float>(i % 2);
    steps.right.at(i, 0, 0) = 0.5F - static_cast<float>(i) / 1024.0F;
    steps.right.at(i, 0, 1) = static_cast<float>((i + 1) % 2);
  }
  // One that chose the same, whatever stands in its first channel; and the last has none.
  steps.right.at(pairs, 0, 0) = 1.0F;
  steps.right.at(pairs, 0, 1) = steps.own.at(pairs, 0, 1);
  steps.right.at(pairs + 1, 0, 1) = -1.0F;
  return steps;
}

// Steps 0 to 199 of 1,024: the 198th of 200 in order is 197, their sum 199 * 200 / 2, over 201 pairs.
TEST_F(LevelStep, FactsAreThoseOfAFewKnownSteps) {
  std::map<std::string, double> facts;
  for (const Counter& counter : levelStepCounters(rowOfSteps(200))) facts[counter.name] = counter.value;
  EXPECT_DOUBLE_EQ(facts.at("level_step_max"), 199.0 / 1024.0);
  EXPECT_DOUBLE_EQ(facts.at("level_step_p99"), 197.0 / 1024.0);
  EXPECT_DOUBLE_EQ(facts.at("level_step_mean"), 19900.0 / 1024.0 / 201.0);
  EXPECT_DOUBLE_EQ(facts.at("level_changes_per_px"), 200.0 / 202.0);
  LevelSteps unknown = rowOfSteps(3);
  unknown.right.at(1, 0, 0) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(levelStepCounters(unknown).empty());
  for (const Counter& counter : levelStepCounters({})) EXPECT_EQ(counter.value, 0.0) << counter.name;
  EXPECT_EQ(levelStepCounters({}).size(), levelStepQuantities().size());
}

// Between two whole levels a full blend's visibility is linear in the level: a change d steps by d times what
// the two differ by, at most the most that any two do. A hard choice steps by all of that.
TEST_F(LevelStep, OfAFullBlendShrinksWithTheChangeOfLevel) {
  const scene::Scene scene = makeScene("sphere_grid");
  const Stepped blend = count(
      scene, kByArea,
      with(common(), {{"budget.limit", int64_t{25}}, {"levels", text("blend")}, {"passes", text("split")}}),
      kStepSize);
  const Stepped hard = count(scene, kByArea, with(common(), {{"budget.limit", int64_t{25}}}), kStepSize);
  ASSERT_TRUE(blend.steps && hard.steps);
  double finest = 100.0, coarsest = 0.0, most = 0.0;
  for (size_t i = 0; i < blend.visibility.pixels(); ++i) {
    if (!blend.processed(i)) continue;
    finest = std::min(finest, blend.level(i));
    coarsest = std::max(coarsest, blend.level(i));
  }
  for (int level = static_cast<int>(finest); level < coarsest; ++level)
    for (size_t i = 0; i < blend.visibility.pixels(); ++i)
      most = std::max(most, std::abs(double{uniformLevel(kByArea, level + 1).data[i]} -
                                     uniformLevel(kByArea, level).data[i]));
  const auto largestStep = [](const Stepped& found, double change, int& pairs) {
    double largest = 0.0;
    pairs = 0;
    for (const Image* neighbour : {&found.steps->right, &found.steps->below})
      for (size_t i = 0; i < neighbour->data.size(); i += 2) {
        const float own = found.steps->own.data[i + 1], other = neighbour->data[i + 1];
        if (other < 0.0F || other == own || std::abs(double{other} - own) > change) continue;
        ++pairs;
        largest = std::max(largest, std::abs(double{found.steps->own.data[i]} - neighbour->data[i]));
      }
    return largest;
  };
  int pairs = 0;
  for (const double change : {0.1, 0.03, 0.01}) {
    // 2e-4: see above.
    EXPECT_LE(largestStep(blend, change, pairs), change * most + 2e-4) << change;
    EXPECT_GT(pairs, 10) << change;
  }
  EXPECT_GT(largestStep(hard, 1.0, pairs), 0.1 * most);
  EXPECT_GT(pairs, 20);
}

// Levels change by far less than 1 from a pixel to the next on most surfaces, a tenth of which narrow blends
// make the whole of, and hard choices jump by 1.
TEST_F(LevelStep, OfAFullBlendIsBelowItsControlsAtTheSameBudget) {
  const Given given = {{"resolution", int64_t{256}},
                       {"budget.limit", int64_t{16}},
                       {"occluders.division", text("levels")},
                       {"passes", text("split")}};
  const scene::Scene scene = makeScene("sphere_grid");
  const auto usual = [&](const char* levels) {
    return count(scene, kByArea, with(given, {{"levels", text(levels)}}), {96, 72})
        .counters.at("level_step_p99");
  };
  const double blend = usual("blend");
  EXPECT_GT(blend, 0.0);
  for (const char* levels : {"finest_within", "narrow_blend"}) EXPECT_GT(usual(levels), blend) << levels;
}

TEST_F(LevelStep, IsNotThereWithoutChangesNorOfSeveralMaps) {
  const scene::Scene scene = makeScene("two_boxes");
  const Given small = {{"resolution", int64_t{64}}};
  const Stepped unlimited = count(scene, kByArea, with(small, {{"budget.limit", int64_t{0}}}), {32, 24});
  EXPECT_FALSE(unlimited.steps);
  EXPECT_EQ(unlimited.counters.at("level_step_max"), 0.0);
  EXPECT_EQ(unlimited.counters.at("level_changes_per_px"), 0.0);
  const Stepped several = count(
      scene, kByMask, with(small, {{"maps", text("light_points")}, {"budget.limit", int64_t{4}}}), {32, 24});
  EXPECT_FALSE(several.steps);
  EXPECT_FALSE(several.counters.count("level_step_max"));
}

// Masks that are kept for what comes after make no other visibility.
TEST_F(LevelStep, OfKeptMasksIsThatOfPlainOnes) {
  const scene::Scene scene = makeScene("sphere_grid");
  const Given given = {
      {"resolution", int64_t{128}}, {"budget.limit", int64_t{9}}, {"occluders.division", text("levels")}};
  const Stepped plain = count(scene, kByMask, given, {48, 36});
  const Stepped kept = count(scene, "soft_shadows/bitmask_coloured", given, {48, 36});
  EXPECT_GT(plain.counters.at("level_step_max"), 0.0);
  for (const Quantity& quantity : levelStepQuantities())
    EXPECT_EQ(plain.counters.at(quantity.name), kept.counters.at(quantity.name)) << quantity.name;
}

}  // namespace
}  // namespace limen::techniques
