// SPDX-License-Identifier: BSD-3-Clause
// limen_import_mesh FILE MEMORY_MIB MEMORY_PER_BYTE SECONDS: reads a mesh file for importMesh(), under
// limits, and writes it to the pipe kMeshStream. No program for users.
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string_view>

#include "experiments/base/error.h"
#include "renderer/scene/mesh_import/import_process.h"
#include "renderer/scene/mesh_import/mesh_stream.h"
#include "renderer/scene/mesh_import/read_mesh_file.h"

namespace {

// The shadow memory of AddressSanitizer is beyond any limit.
#ifdef __SANITIZE_ADDRESS__
constexpr bool kLimitMemory = false;
#else
constexpr bool kLimitMemory = true;
#endif

void limit(__rlimit_resource_t resource, double amount) {
  rlimit limits{};
  if (getrlimit(resource, &limits) != 0) return;
  const double most = limits.rlim_max == RLIM_INFINITY ? 9e18 : static_cast<double>(limits.rlim_max);
  limits.rlim_cur = static_cast<rlim_t>(std::min(amount, most));
  setrlimit(resource, &limits);
}

void send(const void* data, size_t bytes) {
  const char* next = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t written = write(limen::scene::kMeshStream, next, bytes);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) _exit(limen::kExitFailedRuns);  // nobody listens any more
    next += written;
    bytes -= static_cast<size_t>(written);
  }
}

}  // namespace

int main(int argc, char** argv) {
  using namespace limen;
  if (argc != 5) {
    const bool asked = argc == 2 && std::string_view(argv[1]) == "--help";
    std::fprintf(asked ? stdout : stderr,
                 "limen_import_mesh reads meshes for the other programs; it is not called by hand\n");
    return asked ? kExitSuccess : kExitBadInput;
  }
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // Ctrl-C reaches all processes of a terminal; the one that asked for the mesh decides.
  signal(SIGINT, SIG_IGN);
  // What the parent had open is none of a file format's business.
  close_range(scene::kMeshStream + 1, ~0U, 0);
  const double memoryMiB = std::strtod(argv[2], nullptr), perByte = std::strtod(argv[3], nullptr);
  limit(RLIMIT_CORE, 0.0);
  limit(RLIMIT_FSIZE, 0.0);
  limit(RLIMIT_CPU, std::max(std::strtod(argv[4], nullptr), 1.0));
  double read = 0.0;
  const auto opening = [&](uint64_t bytes) {
    read += static_cast<double>(bytes);
    if (kLimitMemory) limit(RLIMIT_AS, memoryMiB * 1048576.0 + perByte * read);
  };
  try {
    scene::sendMesh(scene::readMeshFile(argv[1], opening), send);
  } catch (const std::bad_alloc&) {
    _exit(scene::kImportOutOfMemory);
  } catch (const std::exception& error) {
    scene::sendRefusal(error.what(), send);
  }
  // What a file has made of the importer's objects is not taken down.
  _exit(kExitSuccess);
}
