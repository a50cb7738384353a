#include "sluice/client/report.h"

#include <array>
#include <cstdarg>
#include <cstdio>

namespace sluice::client {

namespace {

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
  std::va_list arguments;
  va_start(arguments, pattern);
  // Long names of stages are cut rather than let through.
  std::array<char, 256> line{};
  std::vsnprintf(line.data(), line.size(), pattern, arguments);
  va_end(arguments);
  return line.data();
}

constexpr double kPercent = 100;
constexpr double kMillisecondsPerSecond = 1000;

}  // namespace

Json stagesJson(const google::protobuf::RepeatedPtrField<v1::StageTime>& stages) {
  Json json = Json::object();
  for (const v1::StageTime& stage : stages) json[stage.name()] = stage.milliseconds();
  return json;
}

Json vectorJson(const v1::Vec3& vector) { return {vector.x(), vector.y(), vector.z()}; }

Json statsJson(const v1::Stats& stats) {
  return {{"simulation_time", stats.simulation_time()},
          {"steps", stats.steps()},
          {"particles", stats.particles()},
          {"paused", stats.paused()},
          {"time_step_seconds", stats.time_step_seconds()},
          {"time_step_limit", stats.time_step_limit()},
          {"density_iterations", stats.density_iterations()},
          {"divergence_iterations", stats.divergence_iterations()},
          {"mean_divergence", stats.mean_divergence()},
          {"max_divergence", stats.max_divergence()},
          {"kinetic_energy", stats.kinetic_energy()},
          {"potential_energy", stats.potential_energy()},
          {"momentum_drift", stats.momentum_drift()},
          {"mean_density_error", stats.mean_density_error()},
          {"max_density_error", stats.max_density_error()},
          {"real_time_factor", stats.real_time_factor()},
          {"stages", stagesJson(stats.stages())},
          {"halted", stats.halted()}};
}

std::string stateText(const v1::Stats& stats) {
  if (!stats.halted().empty()) return "halted: " + stats.halted();
  return stats.paused() ? "paused" : "playing";
}

std::string formatRounded(double value, int digits) { return format("%.*g", digits, value); }

std::string statsTable(const v1::Stats& stats) {
  std::string table;
  table += "state           " + stateText(stats) + "\n";
  table += format("time            %.3f s after %llu steps\n", stats.simulation_time(),
                  static_cast<unsigned long long>(stats.steps()));
  table += format("speed           %.2f x real time\n", stats.real_time_factor());
  table += format("particles       %llu\n", static_cast<unsigned long long>(stats.particles()));
  table += format("time step       %.3f ms%s%s\n", stats.time_step_seconds() * kMillisecondsPerSecond,
                  stats.time_step_limit().empty() ? "" : ", set by ", stats.time_step_limit().c_str());
  table +=
      format("iterations      %u density, %u divergence\n", stats.density_iterations(), stats.divergence_iterations());
  table += format("density error   %.3f %% mean, %.3f %% at most\n", stats.mean_density_error() * kPercent,
                  stats.max_density_error() * kPercent);
  if (stats.stages().empty()) return table;

  table += "stage                          ms\n";
  double total = 0;
  for (const v1::StageTime& stage : stats.stages()) {
    table += format("  %-24.24s %7.2f\n", stage.name().c_str(), stage.milliseconds());
    total += stage.milliseconds();
  }
  return table + format("  %-24s %7.2f\n", "all", total);
}

std::string statsLineHeading() {
  return "time_s    steps    dt_ms   density_it  divergence_it  mean_error_%  max_error_%  speed  step_ms  state";
}

std::string statsLine(const v1::Stats& stats) {
  double stepMilliseconds = 0;
  for (const v1::StageTime& stage : stats.stages()) stepMilliseconds += stage.milliseconds();
  return format("%-8.3f  %-7llu  %-6.3f  %-10u  %-13u  %-12.4f  %-11.4f  %-5.2f  %-7.2f  ", stats.simulation_time(),
                static_cast<unsigned long long>(stats.steps()), stats.time_step_seconds() * kMillisecondsPerSecond,
                stats.density_iterations(), stats.divergence_iterations(), stats.mean_density_error() * kPercent,
                stats.max_density_error() * kPercent, stats.real_time_factor(), stepMilliseconds) +
         stateText(stats);
}

}  // namespace sluice::client
