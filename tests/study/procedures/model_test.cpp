// SPDX-License-Identifier: BSD-3-Clause
#include "study/procedures/model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "study/procedures/settings_reader.h"

namespace limen::study {
namespace {

using nlohmann::json;
using Real = long double;

std::shared_ptr<const Model> model(const json& keys) {
  SettingsReader reader(keys, "");
  std::shared_ptr<const Model> out = readModel(reader, "weibull_db");
  reader.finish();
  return out;
}

std::vector<double> logs(const Model& model, const std::vector<double>& x, const std::vector<double>& s) {
  EXPECT_EQ(s.size(), model.parameters().size());
  std::vector<double> out(static_cast<size_t>(model.outcomes()));
  model.logProbabilities(x.data(), s.data(), out.data());
  return out;
}

TEST(Model, ProbabilitiesOfTheOutcomesSumToOne) {
  struct Case {
    json keys;
    std::vector<std::vector<double>> stimuli;
    std::vector<double> parameters;
  };
  const std::vector<Case> cases = {
      {{{"model", "weibull"}}, {{0}, {0.1}, {0.5}, {3}}, {0.4, 2, 0.5, 0.02}},
      {{{"model", "weibull_log10"}}, {{-5}, {-1}, {1}}, {-1, 3.5, 0.25, 0}},
      {{{"model", "weibull_db"}}, {{-90}, {-20}, {10}}, {-20, 3.5, 0.5, 0.02}},
      {{{"model", "logistic"}, {"asymptotes", "equal"}}, {{-50}, {0}, {50}}, {0, 3, 0.04}},
      {{{"model", "normal"}}, {{-50}, {0}, {50}}, {0, 3, 0, 0}},
      {{{"model", "sigmoid"}, {"family", "hyperbolic_secant"}, {"axis", "log"}},
       {{0}, {1}, {9}},
       {1, 2, 0.5, 0.01}},
      {{{"model", "csf"}}, {{-20, 4}, {-50, 0}}, {-40, -50, 1.2, 3, 0.5, 0.01}},
      {{{"model", "csf_spatiotemporal"}}, {{-20, 4, 8}, {-50, 0, 0}}, {-40, -50, 1.2, 0.4, 3, 0.5, 0.01}},
      {{{"model", "thurstone"}}, {{0, 1}, {1, 0}, {0.3, 0.35}}, {12, 0.1, 0.5, 0.01}},
      {{{"model", "rating"}, {"categories", 5}}, {{-9}, {0}, {1.7}, {30}}, {0.5, 0, 1, 0.5, 2}}};
  for (const Case& c : cases) {
    const auto m = model(c.keys);
    for (const std::vector<double>& stimulus : c.stimuli) {
      double sum = 0;
      for (double value : logs(*m, stimulus, c.parameters)) sum += std::exp(value);
      EXPECT_NEAR(sum, 1, 1e-14) << c.keys << " at " << stimulus[0];
    }
  }
}

TEST(Model, CategoriesOfARatingKeepTheirDigitsInBothTails) {
  const auto m = model({{"model", "rating"}, {"categories", 3}});
  for (double x : {-30.0, -5.0, 0.3, 6.0, 31.0}) {
    // Differences of the complementary error function, taken on the side where it is small.
    const Real root = std::sqrt(Real(2)), low = (0 - Real(x)) / root, high = (Real(1) - x) / root;
    const Real middle =
        low > 0 ? (std::erfc(low) - std::erfc(high)) / 2 : (std::erfc(-high) - std::erfc(-low)) / 2;
    const std::vector<double> found = logs(*m, {x}, {1, 0, 1});
    const Real first = std::log(std::erfc(-low) / 2), second = std::log(middle),
               third = std::log(std::erfc(high) / 2);
    EXPECT_NEAR(found[0], static_cast<double>(first), 1e-12 * std::abs(static_cast<double>(first)) + 1e-16)
        << x;
    EXPECT_NEAR(found[1], static_cast<double>(second), 1e-12 * std::abs(static_cast<double>(second))) << x;
    EXPECT_NEAR(found[2], static_cast<double>(third), 1e-12 * std::abs(static_cast<double>(third)) + 1e-16)
        << x;
  }
}

TEST(Model, PairComparisonsAreSymmetric) {
  const auto m = model({{"model", "thurstone"}});
  const std::vector<double> s = {6, 0.1, 0.7, 0.02};
  const std::vector<double> one = logs(*m, {0.8, 0.3}, s), other = logs(*m, {0.3, 0.8}, s);
  EXPECT_DOUBLE_EQ(one[0], other[1]);
  EXPECT_DOUBLE_EQ(one[1], other[0]);
  EXPECT_DOUBLE_EQ(logs(*m, {0.4, 0.4}, s)[1], std::log(0.5));
  EXPECT_DOUBLE_EQ(logs(*m, {0.05, 0.1}, s)[1], std::log(0.5));  // both below the scale's threshold
}

}  // namespace
}  // namespace limen::study
