// SPDX-License-Identifier: BSD-3-Clause
#include "tests/analysis/browser.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "analysis/output/text_output.h"

namespace limen::analysis {
namespace {

// Runs before the page's own script, so that it sees every error of that.
const char* const kCatchErrors =
    "<script>window.problems=[];addEventListener('error',e=>problems.push(String(e.message)));</script>";

std::string callOf(const std::string& browser, const TemporaryFolder& folder, const std::string& size) {
  return "timeout 100 " + browser +
         " --headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
         "--disable-background-networking "
         "--disable-component-update --disable-sync --virtual-time-budget=5000 --user-data-dir=" +
         folder.path("profile") + " --window-size=" + size;
}

std::string dumpDom(const std::string& browser, const TemporaryFolder& folder, const std::string& page,
                    const std::string& size) {
  const std::string out = folder.path("dom.html");
  const std::string command =
      callOf(browser, folder, size) + " --dump-dom 'file://" + page + "' >" + out + " 2>/dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
  return readFileBytes(out);
}

}  // namespace

std::string findBrowser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (std::system((std::string("command -v ") + name + " >/dev/null 2>&1").c_str()) == 0) return name;
  return {};
}

nlohmann::json probe(const std::string& browser, const TemporaryFolder& folder, const std::string& page,
                     const std::string& script, const std::string& size) {
  std::string text = readFileBytes(page);
  text.insert(text.find("<head>") + 6, kCatchErrors);
  text.insert(text.rfind("</body>"), script);
  writeFileBytes(page, text);
  const std::string dom = dumpDom(browser, folder, page, size);
  const std::string open = "<pre id=\"probe\">";
  const size_t begin = dom.find(open);
  if (begin == std::string::npos) return {{"problems", {"the probe did not run"}}};
  std::string json = dom.substr(begin + open.size(), dom.find("</pre>", begin) - begin - open.size());
  for (const auto& [entity, letter] :
       {std::pair<std::string, std::string>{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
    for (size_t at; (at = json.find(entity)) != std::string::npos;) json.replace(at, entity.size(), letter);
  return nlohmann::json::parse(json);
}

void drawPage(const std::string& browser, const TemporaryFolder& folder, const std::string& page,
              const std::string& size, const std::string& png) {
  const std::string command = callOf(browser, folder, size) + " --hide-scrollbars --screenshot=" + png +
                              " 'file://" + page + "' >/dev/null 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace limen::analysis
