#include "tyndall/cli/company.h"

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>

#include "tyndall/document/fault.h"

namespace tyndall {

Company::Company() {
  if (started_with_others()) ranks_.emplace();
}

void Company::dismiss() {
  if (ranks_) ranks_->dismiss();
}

void Company::serve(const Scene& scene, const Geometry& geometry, const RenderSettings& settings) {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) std::signal(signal, SIG_IGN);
  ranks_->serve(scene, geometry, settings);
}

InstructionSet Company::common_instruction_set(bool quiet) {
  const InstructionSet own = best_instruction_set();
  if (!ranks_) return own;
  const int least = ranks_->least(static_cast<int>(own)), most = -ranks_->least(-static_cast<int>(own));
  if (least != most && chief() && !quiet)
    std::fprintf(stderr, "warning: the machines' processors differ, and with them the picture's last bits\n");
  return static_cast<InstructionSet>(least);
}

void Company::together(const std::function<void()>& step) {
  if (!ranks_) return step();
  std::string trouble;
  try {
    step();
  } catch (const std::exception& e) {
    trouble = *e.what() != '\0' ? e.what() : "an error without a message";
  }
  const std::string first = ranks_->first_text(trouble);
  if (first.empty()) return;
  if (chief()) std::fprintf(stderr, "tyndall: %s\n", first.c_str());
  leave();
  throw CLI::RuntimeError(2);
}

void Company::agree_on(const std::string& text, const std::string& what) {
  if (!ranks_) return;
  const std::string first = ranks_->first_text(text);
  together([&] {
    if (text != first)
      throw Fault("mpirun", "another " + what + " in process " + std::to_string(ranks_->rank()) + " than in process 0",
                  "the same files, options and program on every machine");
  });
}

void Company::leave() {
  if (ranks_) ranks_->leave();
}

}  // namespace tyndall
