// SPDX-License-Identifier: BSD-3-Clause
#include "study/procedures/trace.h"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/base/error.h"

namespace limen::study {
namespace {

using nlohmann::json;

const char* const kForm =
    "give answers like 1,0,1 or stimulus:answer like -18:1 (several dimensions: -26/18:1)";

double readNumber(const std::string& text, const std::string& answer, const std::string& where) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || text.empty() || !std::isfinite(value)) {
    throw Error("'" + answer + "' is not an answer", where, kForm);
  }
  return value;
}

TraceAnswer readAnswer(const std::string& text, const std::string& where) {
  TraceAnswer out;
  const size_t colon = text.find(':');
  const std::string outcome = colon == std::string::npos ? text : text.substr(colon + 1);
  const double number = readNumber(outcome, text, where);
  if (!(number >= 0.0 && number < 1000.0 && number == std::floor(number))) {
    throw Error("'" + text + "' is not an answer", where, kForm);
  }
  out.outcome = static_cast<int>(number);
  if (colon == std::string::npos) return out;
  out.stimulus.emplace();
  size_t begin = 0;
  while (begin <= colon) {
    const size_t end = std::min(text.find('/', begin), colon);
    out.stimulus->push_back(readNumber(text.substr(begin, end - begin), text, where));
    begin = end + 1;
  }
  return out;
}

// JSON has no NaN.
json numberOrNull(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

}  // namespace

std::vector<TraceAnswer> readAnswers(const std::string& text, const std::string& where) {
  std::vector<TraceAnswer> out;
  std::string word;
  bool comment = false;
  for (char c : text + "\n") {
    comment = (comment || c == '#') && c != '\n';
    const bool separator = comment || c == ',' || c == ' ' || c == '\t' || c == '\r' || c == '\n';
    if (!separator) {
      word += c;
    } else if (!word.empty()) {
      out.push_back(readAnswer(word, where));
      word.clear();
    }
  }
  return out;
}

json toJson(const Estimate& estimate) {
  json parameters = json::array();
  for (const ParameterEstimate& p : estimate.parameters) {
    parameters.push_back({{"name", p.name},
                          {"unit", p.unit},
                          {"mean", numberOrNull(p.mean)},
                          {"median", numberOrNull(p.median)},
                          {"mode", numberOrNull(p.mode)},
                          {"low", numberOrNull(p.low)},
                          {"high", numberOrNull(p.high)}});
  }
  return {{"level", estimate.level}, {"kind", estimate.kind}, {"parameters", parameters}};
}

json trace(const json& settings, uint64_t seed, const std::vector<TraceAnswer>& answers,
           const std::string& where) {
  const ProcedureSettings read = readProcedure(settings, where);
  const std::unique_ptr<Procedure> procedure = makeProcedure(read, seed);
  json trials = json::array();
  for (const TraceAnswer& answer : answers) {
    const auto proposed = procedure->next();
    const size_t trial = trials.size() + 1;
    if (!answer.stimulus && !proposed) {
      throw Error("the procedure ends after " + std::to_string(trial - 1) + " trials, there are " +
                      std::to_string(answers.size()) + " answers",
                  where, "give fewer answers, or their stimuli too");
    }
    const std::vector<double> stimulus = answer.stimulus ? *answer.stimulus : *proposed;
    try {
      procedure->update(stimulus, answer.outcome);
    } catch (const Error& error) {
      throw Error("trial " + std::to_string(trial) + ": " + error.message(), where, error.hint());
    }
    trials.push_back({{"trial", trial},
                      {"stimulus", stimulus},
                      {"proposed", proposed ? json(*proposed) : json(nullptr)},
                      {"outcome", answer.outcome},
                      {"estimate", toJson(procedure->estimate())},
                      {"state", procedure->state()}});
  }
  const auto next = procedure->next();
  return {{"procedure", toJson(read)},
          {"seed", std::to_string(seed)},
          {"trials", trials},
          {"next", next ? json(*next) : json(nullptr)}};
}

}  // namespace limen::study
