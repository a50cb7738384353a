#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace sluice::architecture {

/// An #include that crosses from one module to another.
struct Edge {
  std::string from;
  std::string to;
  std::string place;  ///< "server/app/service.cpp:12"
};

/// Which modules each module includes, read off the source text. A module is a folder of `server`, or "client";
/// "sluice/v1/…" is the module "proto".
std::vector<Edge> readIncludeGraph(const std::filesystem::path& sourceRoot);

/// Layers from the bottom up; modules of one layer are neighbours and must not know each other.
using Layers = std::vector<std::set<std::string>>;

/// One line for each edge that goes sideways or upwards, or touches a module that is in no layer.
std::vector<std::string> forbiddenEdges(const std::vector<Edge>& edges, const Layers& layers);

/// The modules of one cycle, in order; empty where there is none.
std::vector<std::string> findCycle(const std::vector<Edge>& edges);

}  // namespace sluice::architecture
