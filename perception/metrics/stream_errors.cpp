// SPDX-License-Identifier: BSD-3-Clause
// Errors of streams of items: place by place, as sets, and in number.
#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/base/error.h"
#include "perception/metrics/metric.h"

namespace limen::perception {
namespace {

struct Streams {
  const std::vector<float>&test, &reference;
};

Streams streamsOf(const ComparisonInput& input, const std::string& metric) {
  if (!input.test || !input.reference) throw Error("metric '" + metric + "' has nothing to compare");
  if (input.depicts != Depicts::Items || input.test->channels != 1)
    throw Error("metric '" + metric + "' compares streams of items; this product is a picture", {},
                "use a metric of pictures");
  if (input.test->data.size() != input.reference->data.size())
    throw Error("metric '" + metric + "' compares streams with room for " +
                    std::to_string(input.test->data.size()) + " and " +
                    std::to_string(input.reference->data.size()) + " items",
                {}, "give both the same scene");
  if (std::any_of(input.reference->data.begin(), input.reference->data.end(),
                  [](float item) { return !std::isfinite(item); }))
    throw Error("metric '" + metric + "': the reference holds values that are not finite");
  return {input.test->data, input.reference->data};
}

/// Negative values are no items. A value that is not finite equals none, itself included, and counts as one.
bool isItem(float value) { return !(value < 0.0F) || !std::isfinite(value); }

std::vector<float> sortedItems(const std::vector<float>& stream) {
  std::vector<float> out;
  for (const float value : stream)
    if (isItem(value) && std::isfinite(value)) out.push_back(value);
  std::sort(out.begin(), out.end());
  return out;
}

double mismatches(const Streams& pair) {
  double out = 0.0;
  for (size_t i = 0; i < pair.test.size(); ++i) out += pair.test[i] == pair.reference[i] ? 0.0 : 1.0;
  return out;
}

double setMismatches(const Streams& pair) {
  const std::vector<float> test = sortedItems(pair.test), reference = sortedItems(pair.reference);
  std::vector<float> different;
  std::set_symmetric_difference(test.begin(), test.end(), reference.begin(), reference.end(),
                                std::back_inserter(different));
  const auto bad =
      std::count_if(pair.test.begin(), pair.test.end(), [](float value) { return !std::isfinite(value); });
  return static_cast<double>(different.size()) + static_cast<double>(bad);
}

double countDifference(const Streams& pair) {
  const auto count = [](const std::vector<float>& stream) {
    return static_cast<double>(std::count_if(stream.begin(), stream.end(), isItem));
  };
  return std::abs(count(pair.test) - count(pair.reference));
}

RegisteredMetric<NoMetricSettings> streamMetric(MetricInfo info, double (*compare)(const Streams&)) {
  const std::string name = info.name;
  return {std::move(info), [name, compare](const ComparisonInput& input, const NoMetricSettings&) {
            const Streams pair = streamsOf(input, name);
            MetricResult result;
            result.value = compare(pair);
            result.evaluatedPixels = static_cast<int64_t>(pair.test.size());
            return result;
          }};
}

const RegisteredMetric<NoMetricSettings> kMismatches = streamMetric(
    {.name = "stream_mismatches",
     .summary =
         "places of a stream that hold another item than the reference's, those after its end included",
     .source = "Roger 2008, chapter 4",
     .title = "Items in the wrong place",
     .unit = "items"},
    &mismatches);

const RegisteredMetric<NoMetricSettings> kSetMismatches =
    streamMetric({.name = "stream_set_mismatches",
                  .summary = "items that the stream lacks or has in excess, wherever they are",
                  .source = "Roger 2008, chapter 4",
                  .title = "Items missing or in excess",
                  .unit = "items"},
                 &setMismatches);

const RegisteredMetric<NoMetricSettings> kCountDifference =
    streamMetric({.name = "stream_count_difference",
                  .summary = "difference between the numbers of items",
                  .source = "Roger 2008, chapter 4",
                  .title = "Difference in number",
                  .unit = "items"},
                 &countDifference);

}  // namespace
}  // namespace limen::perception
