// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/gnuplot.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>

#include "experiments/base/error.h"
#include "experiments/base/printable.h"

namespace limen {

// Inside single quotes gnuplot takes everything as it is but the quote itself, which is doubled. One at the
// very beginning it takes for an empty string all the same; that one stands in double quotes, before the
// rest.
std::string gnuplotQuoted(const std::string& text) {
  if (!text.empty() && text.front() == '\'') return "\"'\"." + gnuplotQuoted(text.substr(1));
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + "'";
}

std::string gnuplotTick(const std::string& label) {
  std::string out;
  for (const char c : label) out += c == '%' ? std::string("%%") : std::string(1, c);
  return gnuplotQuoted(out);
}

std::string gnuplotFile(const std::string& name) {
  requirePlainName(name);
  return gnuplotQuoted("./" + name);
}

std::string gnuplotTerminal(const std::string& extension, double width, double height) {
  if (extension == ".svg")
    return fmt::format("svg size {:.0f},{:.0f} dynamic font 'system-ui, sans-serif,13'", 720.0 * width,
                       480.0 * height);
  if (extension == ".png")
    return fmt::format("pngcairo size {:.0f},{:.0f} font 'sans,20' linewidth 2 pointscale 2", 1440.0 * width,
                       960.0 * height);
  return fmt::format("pdfcairo size {:.4g}cm,{:.4g}cm font 'sans,10'", 14.0 * width, 9.3 * height);
}

void runGnuplot(const std::string& folder, const std::string& file) {
  std::array<int, 2> messages{};
  if (pipe(messages.data()) != 0) throw Error("cannot create a pipe", "gnuplot");
  const pid_t child = fork();
  if (child == 0) {
    dup2(messages[1], 2);
    dup2(messages[1], 1);
    close(messages[0]);
    close(messages[1]);
    if (chdir(folder.c_str()) == 0)
      execlp("gnuplot", "gnuplot", ("." + std::string("/") + file).c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  close(messages[1]);
  std::string text;
  std::array<char, 1024> buffer{};
  for (ssize_t n; (n = read(messages[0], buffer.data(), buffer.size())) > 0;)
    text.append(buffer.data(), static_cast<size_t>(n));
  close(messages[0]);
  int status = -1;
  if (child < 0 || waitpid(child, &status, 0) < 0) throw Error("cannot start gnuplot");
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
    throw Error("gnuplot is not installed; it draws the charts", "",
                "install the Debian package gnuplot-nox");
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error("gnuplot failed: " + text.substr(0, 400), (std::filesystem::path(folder) / file).string());
}

}  // namespace limen
