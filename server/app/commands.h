#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace sluice::app {

/// What a verb does once the command line is read; its result is the exit code.
using Command = std::function<int()>;

// Each declares a verb of `sluice-server`; when it is the one given, `chosen` is set to its command.
void addServeCommand(CLI::App& program, Command& chosen);
void addRenderCommand(CLI::App& program, Command& chosen);
void addSimulateCommand(CLI::App& program, Command& chosen);
void addReplayCommand(CLI::App& program, Command& chosen);
void addPlanCommand(CLI::App& program, Command& chosen);
void addEvaluateCommand(CLI::App& program, Command& chosen);
void addGalleryCommand(CLI::App& program, Command& chosen);
void addScenesCommand(CLI::App& program, Command& chosen);
void addLooksCommand(CLI::App& program, Command& chosen);
void addParametersCommand(CLI::App& program, Command& chosen);

}  // namespace sluice::app
