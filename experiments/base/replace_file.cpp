// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/replace_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "experiments/base/error.h"

namespace limen {
namespace {

/// A temporary file that is removed unless it was renamed to the target.
class Temporary {
 public:
  explicit Temporary(const std::string& path)
      : target_(path), path_(path + ".unfinished-" + std::to_string(::getpid())) {
    file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file_ < 0) throw failure();
  }
  ~Temporary() {
    if (file_ >= 0) ::close(file_);
    if (!finished_) ::unlink(path_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  void write(const std::string& text) {
    for (size_t done = 0; done < text.size();) {
      const ssize_t count = ::write(file_, text.data() + done, text.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) throw failure();
      done += static_cast<size_t>(count);
    }
    // If renamed before its content is on disk, the file could be empty after a power failure.
    if (::fsync(file_) != 0) throw failure();
    const int closed = ::close(file_);
    file_ = -1;
    if (closed != 0) throw failure();
  }

  void finish() {
    if (std::rename(path_.c_str(), target_.c_str()) != 0) throw failure();
    finished_ = true;
  }

  const std::string& path() const { return path_; }

 private:
  Error failure() const {
    return Error(std::string("cannot be written: ") + std::strerror(errno), target_,
                 "check the folder, its permissions and the free space");
  }

  std::string target_, path_;
  int file_ = -1;
  bool finished_ = false;
};

}  // namespace

void replaceFile(const std::string& path, const std::string& text,
                 const std::function<void(const std::string&)>& check) {
  // A symbolic link stays one: its target is replaced.
  std::error_code code;
  const std::string real =
      std::filesystem::is_symlink(path, code) ? std::filesystem::weakly_canonical(path, code).string() : path;
  Temporary temporary(real);
  temporary.write(text);
  if (check) check(temporary.path());
  temporary.finish();
}

}  // namespace limen
