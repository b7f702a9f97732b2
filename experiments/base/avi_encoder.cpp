// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/avi_encoder.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "experiments/base/error.h"
#include "experiments/base/image_codec/functions.h"

namespace limen {
namespace {

/// Of JPEG, with chroma for every pixel.
constexpr int kQuality = 95;
/// Sizes in the file have 32 bits.
constexpr uint64_t kMostBytes = (uint64_t{1} << 32) - (uint64_t{1} << 24);
/// Where the list of pictures begins, counted from its name.
constexpr size_t kHeaderBytes = 224, kListName = 220;

/// Little-endian fields.
class Fields {
 public:
  Fields& name(const char* letters) { return bytes_.append(letters, 4), *this; }
  Fields& whole(uint64_t value, int size = 4) {
    for (int i = 0; i < size; ++i) bytes_ += i < 8 ? static_cast<char>(value >> (8 * i)) : char{0};
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace

AviEncoder::AviEncoder(const std::string& file, std::string path, int width, int height,
                       double framesPerSecond)
    : path_(std::move(path)), width_(width), height_(height) {
  for (const uint32_t scale : {1U, 1000U, 1000000U}) {
    scale_ = scale;
    rate_ = static_cast<uint32_t>(std::llround(framesPerSecond * scale));
    if (std::abs(framesPerSecond * scale - rate_) < 1e-6) break;
  }
  file_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file_ < 0) throw Error(std::string("cannot be written: ") + std::strerror(errno), path_);
  append(std::string(kHeaderBytes, '\0'));
}

AviEncoder::~AviEncoder() {
  if (file_ >= 0) ::close(file_);
}

void AviEncoder::append(const std::string& bytes) {
  if (size_ + bytes.size() > kMostBytes)
    throw Error("the video is larger than 4 GiB, which AVI files cannot be", path_,
                "write .mkv or .mp4, or several files");
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(file_, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0)
      throw Error(std::string("cannot be written: ") + std::strerror(count < 0 ? errno : ENOSPC), path_,
                  "check the folder, its permissions and the space left");
    done += static_cast<size_t>(count);
  }
  size_ += bytes.size();
}

void AviEncoder::add(const Image& image) {
  const std::string picture = codec::functions().jpeg(image, kQuality);
  chunks_.push_back({static_cast<uint32_t>(size_ - kListName), static_cast<uint32_t>(picture.size())});
  Fields chunk;
  chunk.name("00dc").whole(picture.size());
  append(chunk.bytes() + picture + std::string(picture.size() % 2, '\0'));
}

/// The structures of Microsoft's AVI RIFF file reference, in their order.
std::string AviEncoder::header() const {
  uint32_t largest = 0;
  for (const Chunk& chunk : chunks_) largest = std::max(largest, chunk.bytes);
  const auto width = static_cast<uint64_t>(width_), height = static_cast<uint64_t>(height_);
  const double rate = static_cast<double>(rate_) / scale_;
  const uint64_t listBytes = size_ - 16 * chunks_.size() - 8 - kListName;  // without the index
  Fields out;
  out.name("RIFF").whole(size_ - 8).name("AVI ");
  out.name("LIST").whole(192).name("hdrl");
  out.name("avih").whole(56);
  out.whole(static_cast<uint64_t>(std::llround(1e6 / rate)));        // microseconds a frame
  out.whole(static_cast<uint64_t>(std::min(largest * rate, 4e9)));   // bytes a second
  out.whole(0).whole(0x10).whole(chunks_.size()).whole(0).whole(1);  // 0x10: has an index; one stream
  out.whole(largest).whole(width).whole(height).whole(0, 16);
  out.name("LIST").whole(116).name("strl");
  out.name("strh").whole(56).name("vids").name("MJPG").whole(0, 12);
  out.whole(scale_).whole(rate_).whole(0).whole(chunks_.size()).whole(largest);
  out.whole(0xFFFFFFFFU).whole(0).whole(0).whole(width, 2).whole(height, 2);
  out.name("strf").whole(40).whole(40).whole(width).whole(height).whole(1, 2).whole(24, 2).name("MJPG");
  out.whole(3 * width * height).whole(0, 16);
  out.name("LIST").whole(listBytes).name("movi");
  return out.bytes();
}

void AviEncoder::close() {
  Fields index;
  index.name("idx1").whole(16 * chunks_.size());
  for (const Chunk& chunk : chunks_)
    index.name("00dc").whole(0x10).whole(chunk.offset).whole(chunk.bytes);  // 0x10: a key frame
  append(index.bytes());
  const std::string head = header();
  const bool good = head.size() == kHeaderBytes &&
                    ::pwrite(file_, head.data(), head.size(), 0) == static_cast<ssize_t>(head.size());
  const bool closed = ::close(file_) == 0;
  file_ = -1;
  if (!good || !closed) throw Error("cannot be written", path_, "check the space left on the disk");
}

}  // namespace limen
