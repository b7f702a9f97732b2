// SPDX-License-Identifier: BSD-3-Clause
#include "study/observers/simulate.h"

#include <fmt/format.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "experiments/base/error.h"
#include "experiments/base/interrupt.h"
#include "experiments/store/sessions.h"
#include "perception/psychometrics/random.h"
#include "study/observers/simulated_front_end.h"

namespace limen::study {
namespace {

using psychometrics::childSeed;

struct Known {
  store::StudySession session;
  int64_t lastUtcMs = 0, lastMonotonicNs = 0;
};

std::map<std::string, Known> knownSessions(const std::string& path) {
  std::map<std::string, Known> out;
  if (store::isUnwritten(path)) return out;
  const store::SessionReader reader(path);
  for (store::StudySession& session : reader.sessions()) {
    if (session.name != "1") continue;
    Known known;
    const bool over = session.state == "finished" || session.state == "aborted";
    if (!over) {
      const std::vector<store::StudyEvent> events = reader.events(session.id);
      if (!events.empty()) {
        known.lastUtcMs = utcMilliseconds(events.back().utc);
        known.lastMonotonicNs = events.back().monotonicNs;
      }
    }
    const std::string participant = session.participant;
    known.session = std::move(session);
    out.emplace(participant, std::move(known));
  }
  return out;
}

// A session simulated in another way must not be mistaken for one of these.
void checkSame(const Protocol& protocol, const SimulationRequest& request, const Known& known,
               const store::SessionReader& reader) {
  const store::StudySession& session = known.session;
  const std::string hint = "give another --store or --participant-prefix";
  if (session.protocol != protocol.hash)
    throw Error("participant " + session.participant + " used another protocol", request.store, hint);
  const nlohmann::json facts = reader.environment(session.environment).facts;
  const nlohmann::json frontEnd = facts.value("front_end", nlohmann::json::object());
  const nlohmann::json observer = frontEnd.value("observer", nlohmann::json());
  if (!frontEnd.value("simulated", false))
    throw Error("participant " + session.participant + " is not a simulated one", request.store, hint);
  if (session.seed != sessionSeed(request.seed, session.participant))
    throw Error("participant " + session.participant + " was simulated with another --seed", request.store,
                hint);
  if (observer != toJson(request.observer) ||
      frontEnd.value("invalid_rate", nlohmann::json()) != request.invalidRate)
    throw Error(
        "participant " + session.participant + " was simulated as another observer: " + observer.dump(),
        request.store, hint);
}

// Makes sessions begin in the order of their participants, so that each gets its own number.
class Turns {
 public:
  void waitFor(int index) {
    std::unique_lock lock(guard_);
    changed_.wait(lock, [&] { return next_ >= index || stopped_; });
  }
  void pass(int index) {
    const std::scoped_lock lock(guard_);
    if (next_ <= index) next_ = index + 1;
    changed_.notify_all();
  }
  void stop() {
    const std::scoped_lock lock(guard_);
    stopped_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex guard_;
  std::condition_variable changed_;
  int next_ = 0;
  bool stopped_ = false;
};

class Simulator {
 public:
  Simulator(const Protocol& protocol, const SimulationRequest& request, StimulusModel* model)
      : protocol_(protocol),
        request_(request),
        simulation_(protocol),
        model_(model),
        known_(knownSessions(request.store)) {
    if (!known_.empty()) {
      const store::SessionReader reader(request.store);
      for (int i = 0; i < request.observers; ++i) {
        const auto found = known_.find(participantCode(request.prefix, i));
        if (found != known_.end()) checkSame(protocol, request, found->second, reader);
      }
    }
  }

  SimulationEnd run() {
    std::vector<std::thread> threads;
    for (int i = 1; i < request_.jobs; ++i) threads.emplace_back([this] { work(); });
    work();
    for (std::thread& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
    end_.stopped = stopped_;
    return end_;
  }

 private:
  void work() {
    for (int i = next_++; i < request_.observers && !stopped_; i = next_++) {
      try {
        runOne(i);
      } catch (const Interrupted&) {
        stopped_ = true;
        turns_.stop();
      } catch (...) {
        const std::scoped_lock lock(guard_);
        if (!failure_) failure_ = std::current_exception();
        stopped_ = true;
        turns_.stop();
      }
      turns_.pass(i);
    }
  }

  void runOne(int index) {
    const std::string participant = participantCode(request_.prefix, index);
    const auto found = known_.find(participant);
    const Known* known = found == known_.end() ? nullptr : &found->second;
    if (known && (known->session.state == "finished" || known->session.state == "aborted")) {
      const std::scoped_lock lock(guard_);
      ++end_.skipped;
      ++done_;
      return;
    }
    const uint64_t seed = sessionSeed(request_.seed, participant);
    SimulatedObserver observer(simulation_, request_.observer.behaviour, observerSeed(seed), model_);
    // Sittings one after the other, an hour each; a resumed one continues where its clock stopped.
    SimulatedClock clock = known ? SimulatedClock(known->lastUtcMs, known->lastMonotonicNs)
                                 : SimulatedClock(SimulatedClock::kEpochMs + index * int64_t{3600000});
    SimulatedFrontEndSetting setting;
    setting.description = toJson(request_.observer);
    setting.refreshHz = request_.display.refreshHz;
    setting.invalidRate = request_.invalidRate;
    setting.seed = childSeed(seed, "form");
    setting.quit = [this, index] { return mayQuit(index); };
    SimulatedFrontEnd frontEnd(observer, clock, setting);

    SessionRequest request;
    request.store = request_.store;
    request.participant = participant;
    request.seed = seed;
    request.resume = known != nullptr;
    request.durability = request_.durability;
    request.display = request_.display;
    turns_.waitFor(index);
    if (stopped_) return;
    const SessionEnd end = runSession(protocol_, request, frontEnd, clock);
    const std::scoped_lock lock(guard_);
    ++(known ? end_.resumed : end_.newSessions);
    if (end.kind == Step::Kind::Finished || end.kind == Step::Kind::Aborted) ++done_;
  }

  bool mayQuit(int index) {
    // The session has begun: its participant has a number.
    turns_.pass(index);
    const std::scoped_lock lock(guard_);
    ++steps_;
    if (!stopped_ && request_.progress && request_.progress(steps_, done_)) {
      stopped_ = true;
      turns_.stop();
    }
    return stopped_;
  }

  const Protocol& protocol_;
  const SimulationRequest& request_;
  Simulation simulation_;
  StimulusModel* model_;
  std::map<std::string, Known> known_;
  Turns turns_;
  std::atomic<int> next_ = 0;
  std::atomic<bool> stopped_ = false;
  std::mutex guard_;
  SimulationEnd end_;
  int64_t steps_ = 0;
  int done_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

SimulationEnd simulateSessions(const Protocol& protocol, const SimulationRequest& request,
                               StimulusModel* model) {
  if (request.observers < 1 || request.observers > 1000000)
    throw Error(std::to_string(request.observers) + " is not from 1 to 1000000", "--observers");
  if (request.jobs < 1 || request.jobs > 256)
    throw Error(std::to_string(request.jobs) + " is not from 1 to 256", "--jobs");
  if (!(request.invalidRate >= 0.0 && request.invalidRate < 1.0))
    throw Error("is not from 0 to below 1", "--invalid-rate");
  if (model && request.jobs > 1)
    throw Error("the popping predictor supports only one thread", "--jobs", "give 1, or another --kind");
  const std::filesystem::path folder = std::filesystem::path(request.store).parent_path();
  std::error_code failed;
  if (!folder.empty()) std::filesystem::create_directories(folder, failed);
  if (failed) throw Error("cannot create the folder: " + failed.message(), request.store);
  return Simulator(protocol, request, model).run();
}

std::string participantCode(const std::string& prefix, int index) {
  return fmt::format("{}{:03}", prefix, index + 1);
}

uint64_t sessionSeed(uint64_t seed, const std::string& participant) {
  return childSeed(seed, "session " + participant);
}

uint64_t observerSeed(uint64_t sessionSeed) { return childSeed(sessionSeed, "observer"); }

}  // namespace limen::study
