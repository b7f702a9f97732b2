// SPDX-License-Identifier: BSD-3-Clause
// Pictures in the formats that people have, and in others that the image library would read.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "experiments/base/error.h"
#include "experiments/base/image_file.h"
#include "tests/fuzz/rounds.h"

namespace limen::fuzz {
namespace {

struct Format {
  std::string ending;
  OIIO::TypeDesc type = OIIO::TypeDesc::UINT8;
  int channels = 3;
  std::string compression = {};
  std::string name = {};  ///< of the test, if the ending does not tell it apart
};

/// A small picture of a gradient with some noise.
void writeSeed(const Format& format, const std::string& file) {
  constexpr int kWidth = 24, kHeight = 17;
  OIIO::ImageSpec spec(kWidth, kHeight, format.channels, format.type);
  if (!format.compression.empty()) spec.attribute("compression", format.compression);
  std::vector<float> values(static_cast<size_t>(kWidth * kHeight * format.channels));
  Random random(1);
  for (size_t i = 0; i < values.size(); ++i)
    values[i] = 0.9F * static_cast<float>(i) / static_cast<float>(values.size()) +
                0.001F * static_cast<float>(random.below(100));
  const auto out = OIIO::ImageOutput::create(file);
  if (out && out->open(file, spec)) out->write_image(OIIO::TypeDesc::FLOAT, values.data());
}

/// Encoded in a process of its own: the image library starts threads, which no child of this process would
/// have.
std::string encoded(const Format& format) {
  std::string pattern = (std::filesystem::temp_directory_path() / "limen_fuzz_XXXXXX").string();
  const std::string folder = mkdtemp(pattern.data()), file = folder + "/seed" + format.ending;
  const pid_t child = fork();
  if (child == 0) {
    writeSeed(format, file);
    _exit(0);
  }
  waitpid(child, nullptr, 0);
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  std::filesystem::remove_all(folder);
  return bytes;
}

class ImageFormat : public testing::TestWithParam<Format> {};

TEST_P(ImageFormat, IsReadOrRefused) {
  const std::string seed = encoded(GetParam());
  ASSERT_FALSE(seed.empty()) << "no seed of " << GetParam().ending;
  expectRobust({.name = "image_" + GetParam().ending.substr(1) + GetParam().name,
                .extension = GetParam().ending,
                .corpus = {seed},
                .mutate = mutateBytes,
                .read =
                    [](const std::string& path) {
                      const ImageFile file = readImageFile(path);
                      const Image& image = file.image;
                      if (image.width < 1 || image.height < 1 ||
                          image.data.size() != image.pixels() * static_cast<size_t>(image.channels))
                        throw Violation{"a picture without its pixels"};
                      if (file.integer && !std::all_of(image.data.begin(), image.data.end(), [](float value) {
                            return value >= 0.0F && value <= 1.0F;
                          }))
                        throw Violation{"an integer beyond 0 to 1"};
                    },
                .rounds = 300});
}

INSTANTIATE_TEST_SUITE_P(Fuzz, ImageFormat,
                         testing::Values(Format{".png"}, Format{".png", OIIO::TypeDesc::UINT16, 4, "", "16"},
                                         Format{".jpg"},
                                         Format{".tif", OIIO::TypeDesc::UINT8, 4, "lzw", "lzw"},
                                         Format{".tif", OIIO::TypeDesc::FLOAT, 3, "zip", "float"},
                                         Format{".exr", OIIO::TypeDesc::HALF, 4, "zip", "zip"},
                                         Format{".exr", OIIO::TypeDesc::FLOAT, 3, "piz", "piz"},
                                         Format{".exr", OIIO::TypeDesc::HALF, 3, "b44", "b44"},
                                         Format{".exr", OIIO::TypeDesc::HALF, 3, "dwaa", "dwaa"},
                                         Format{".hdr", OIIO::TypeDesc::FLOAT}, Format{".bmp"},
                                         Format{".tga", OIIO::TypeDesc::UINT8, 4, "rle"}, Format{".pnm"},
                                         Format{".gif", OIIO::TypeDesc::UINT8, 4}, Format{".webp"}),
                         [](const auto& one) { return one.param.ending.substr(1) + one.param.name; });

}  // namespace
}  // namespace limen::fuzz
