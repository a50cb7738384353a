#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include <unistd.h>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "sluice/app/version.h"
#include "sluice/core/input_error.h"

namespace {

// Exit codes: what the caller gave can be mended by the caller; what the machine lacks can not.
constexpr int kEnvironmentFailed = 1;
constexpr int kInputRefused = 2;

int report(const std::exception& error, int exitCode) {
  std::fprintf(stderr, "sluice-server: %s\n", error.what());
  return exitCode;
}

/// Threads of an OpenMP team that wait by spinning take the cores from rendering, encoding and whatever else runs: on
/// two busy cores a step took ten times as long. The OpenMP library reads its wait policy before main, from the
/// environment alone, so the program starts itself again with the right one; a policy that is set already stays.
void waitWithoutSpinning(char** argv) {
  constexpr const char* kPolicy = "OMP_WAIT_POLICY";
  if (std::getenv(kPolicy) != nullptr) return;
  setenv(kPolicy, "passive", 1);
  execv("/proc/self/exe", argv);
  // Without /proc the program runs on, merely slower.
}

}  // namespace

int main(int argc, char** argv) {
  using namespace sluice;

  waitWithoutSpinning(argv);

  CLI::App program("Runs particle fluids, draws them as liquid, and streams the pictures.", "sluice-server");
  program.set_version_flag("--version", app::kVersion);
  program.require_subcommand(1);

  app::Command chosen;
  app::addServeCommand(program, chosen);
  app::addRenderCommand(program, chosen);
  app::addSimulateCommand(program, chosen);
  app::addReplayCommand(program, chosen);
  app::addPlanCommand(program, chosen);
  app::addEvaluateCommand(program, chosen);
  app::addGalleryCommand(program, chosen);
  app::addScenesCommand(program, chosen);
  app::addLooksCommand(program, chosen);
  app::addParametersCommand(program, chosen);

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : kInputRefused;
  }

  try {
    return chosen();
  } catch (const core::InputError& error) {
    return report(error, kInputRefused);
  } catch (const std::bad_alloc&) {
    return report(core::EnvironmentError("not enough memory"), kEnvironmentFailed);
  } catch (const std::exception& error) {
    return report(error, kEnvironmentFailed);
  }
}
