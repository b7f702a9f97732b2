// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "perception/image_analysis/functions.h"

extern "C" const limen::perception::analysis::Functions* limenImageAnalysis();

namespace limen::perception::analysis {
namespace {

/// Smaller pictures have too few levels for the search.
constexpr int kLeastSide = 64;

/// OpenCV takes pointers to what may change, and leaves it as it is.
cv::Mat asMatrix(const uint8_t* values, int width, int height) {
  return {height, width, CV_8UC1, const_cast<uint8_t*>(values)};
}

cv::Mat extended(const cv::Mat& image) {
  cv::Mat out;
  cv::copyMakeBorder(image, out, 0, std::max(kLeastSide - image.rows, 0), 0,
                     std::max(kLeastSide - image.cols, 0), cv::BORDER_REPLICATE);
  return out;
}

}  // namespace

void labelComponents(const uint8_t* mask, int width, int height, int connectivity, int32_t* labels) {
  cv::Mat out(height, width, CV_32SC1, labels);
  cv::connectedComponents(asMatrix(mask, width, height), out, connectivity, CV_32S);
  // It writes where it is told to if size and type agree.
  CV_Assert(out.data == reinterpret_cast<uchar*>(labels));
}

void traceBack(const uint8_t* before, const uint8_t* now, int width, int height, float* flow) {
  const cv::Mat from = extended(asMatrix(now, width, height)), to = extended(asMatrix(before, width, height));
  cv::Mat found;
  cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM)->calc(from, to, found);
  for (int y = 0; y < height; ++y) {
    const float* row = found.ptr<float>(y);
    std::copy(row, row + 2 * static_cast<std::ptrdiff_t>(width),
              flow + 2 * static_cast<std::ptrdiff_t>(width) * y);
  }
}

}  // namespace limen::perception::analysis

// Named by kEntry.
extern "C" const limen::perception::analysis::Functions* limenImageAnalysis() {
  namespace analysis = limen::perception::analysis;
  static constexpr analysis::Functions kFunctions{&analysis::labelComponents, &analysis::traceBack};
  // The search divides its work by the number of threads, and its result depends on that.
  cv::setNumThreads(1);
  return &kFunctions;
}
