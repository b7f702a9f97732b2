// SPDX-License-Identifier: BSD-3-Clause
// limen analyse fit: psychometric functions of a table's or a study's answers.
#include <CLI/CLI.hpp>
#include <memory>

#include "analysis/answer_fits/fit_options.h"
#include "analysis/commands/commands.h"
#include "analysis/commands/study_input.h"
#include "analysis/study/analyses.h"
#include "analysis/study/fitted_parts.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

struct FitCall {
  FitOptions options;
  StudyInput study;
  FittedPartsChoice parts;
  std::string guess = "free", plot;
};

void fitStore(FitCall& call) {
  call.parts.variable = call.options.level;
  call.parts.guessFromCatch = call.guess == "catch";
  const StudyAnswers study = readStudy(call.study);
  const std::vector<FittedPart> parts = fittedParts(study, call.parts);
  if (!call.plot.empty() && parts.size() > 1)
    throw Error("is one picture, and several parts are fitted", "--plot", "name one with --part");
  std::vector<FitAnswer> answers;
  for (const FittedPart& part : parts) answers.push_back(fitPart(study, part, call.options));
  if (!call.plot.empty()) drawFit(answers.front(), call.plot);
  print(call.study, headOf(study), resultOf(answers));
}

void fitTable(const FitCall& call) {
  FitOptions options = call.options;
  if (!options.intervals) options.intervals = IntervalMethod::Profile;
  const FitAnswer answer = answerFit(options, readConditions(options));
  if (!call.plot.empty()) drawFit(answer, call.plot);
  Section head;
  head.fact(text("file"), answer.file);
  head.fact(text("sha256", "SHA-256"), answer.hash);
  print(call.study, head, resultOf(std::vector<FitAnswer>{answer}));
}

}  // namespace

void addFitCommand(CLI::App& app) {
  const auto call = std::make_shared<FitCall>();
  FitOptions& options = call->options;
  CLI::App* fit =
      app.add_subcommand("fit", "psychometric functions of answers: thresholds, widths, intervals");
  fit->add_option("DATA", options.file,
                  "CSV or TSV, columns named in the first line; or a result store with sessions, whose parts "
                  "are fitted as their protocol describes them")
      ->required();
  fit->add_option("--x", options.level,
                  "column with the stimulus level; of a store the axis or factor, where there are several");
  fit->add_option("--k", options.correct, "column with the number of correct or positive answers");
  fit->add_option("--n", options.trials, "column with the number of trials");
  fit->add_option("--outcome", options.outcome, "column with 0 or 1, no or yes, where each row is one trial");
  fit->add_option("--by", options.by,
                  "columns whose values are the conditions; of a store factors, 'observer' or none (default: "
                  "all factors but x, observers pooled)")
      ->delimiter(',');
  fit->add_option("--order", options.order,
                  "column that says when a row was measured; otherwise the file's order");
  fit->add_option("--part", call->parts.part, "of a store: the part to fit (default: all that can be)");
  addDefaulted(*fit, "--guess", call->guess,
               "of a store, yes/no: free, fitted with the catch trials as trials without a stimulus, or "
               "catch, held at their rate")
      ->check(CLI::IsMember({"free", "catch"}));
  addStudyChoice(*fit, call->study);
  FitSettings& settings = options.settings;
  fit->add_option_function<std::string>(
      "--task", [&](const std::string& task) { settings.task = readFitTask(task, "--task"); },
      "yesno, 2afc, mafc:M, equal (guess rate = lapse rate); 2afc if not given, of a store its own");
  fit->add_option(
      "--sigmoid", options.sigmoid,
      "logistic, normal, weibull, gumbel, reversed_gumbel, hyperbolic_secant, student_t; normal if "
      "not given, of a store as its simulation block says (so with axis, direction and level)");
  fit->add_option("--axis", options.axis, "linear or log; weibull is log; linear if not given");
  fit->add_option("--direction", options.direction,
                  "rising, falling (F of -x, on a log axis of 1/x) or auto, as the answers go; rising if not "
                  "given, of a store auto");
  fit->add_option("--level", options.thresholdLevel, "F at which the threshold is; 0.5 if not given");
  addChoice<FitMethod>(*fit, "--method", settings.method, "maximum likelihood (default), or with priors");
  fit->add_option_function<std::vector<std::string>>(
      "--fix",
      [&](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) fixParameter(settings, text);
      },
      "parameter that is known: lapse=0.01; may be repeated");
  fit->add_option_function<std::vector<std::string>>(
         "--share",
         [&](const std::vector<std::string>& names) {
           for (const std::string& name : names) shareParameter(settings, name);
         },
         "parameters that all conditions have in common: lapse,width")
      ->delimiter(',');
  addDefaulted(*fit, "--lapse-most", settings.lapseMost, "upper bound of the lapse rate");
  addDefaulted(*fit, "--guess-most", settings.guessMost, "upper bound of a guess rate that is fitted");
  fit->add_option("--range", options.range,
                  "LOW,HIGH: levels between which the threshold is expected; bounds and "
                  "priors go by them and not by the data's")
      ->delimiter(',');
  fit->add_flag("--overdispersion", settings.overdispersion, "fit eta: beta-binomial answers");
  addChoice<IntervalMethod>(
      *fit, "--intervals", options.intervals,
      "profile unless given; of a store whose observers are pooled observers, which takes "
      "them as the unit",
      "intervals");
  addDefaulted(*fit, "--confidence", options.confidence, "of the intervals");
  addChoice<Resampling>(*fit, "--resample", options.resampling,
                        "from the fit (parametric, the default) or from the answers");
  addDefaulted(*fit, "--samples", options.samples, "of bootstrap and goodness of fit");
  addDefaulted(*fit, "--seed", options.seed, "of bootstrap and goodness of fit");
  addDefaulted(*fit, "--threads", options.threads, "of the bootstrap; no result depends on them")
      ->check(CLI::Range(1u, 64u));
  fit->add_flag("--goodness", options.goodness,
                "deviance and residuals against samples drawn from the fit; influence of each block");
  fit->add_option("--plot", call->plot, "draw into FILE.svg, .pdf or .png");
  addOutput(*fit, call->study);
  fit->callback([call, fit] {
    call->study.choice.store = call->options.file;
    if (!isStudyStore(*fit, call->study, {"--k", "--n", "--outcome", "--order"}, {"--part", "--guess"}))
      return fitTable(*call);
    if (fit->count("--task") > 0)
      throw Error("is what the protocol says", "--task", "leave it out, or give a CSV file");
    if (fit->count("--by") > 0) call->parts.by = call->options.by;
    if (call->parts.by == std::vector<std::string>{"none"}) call->parts.by->clear();
    fitStore(*call);
  });
}

}  // namespace limen::analysis
