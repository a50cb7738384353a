#include "include_graph.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <optional>
#include <regex>

namespace sluice::architecture {

namespace {

namespace fs = std::filesystem;

bool isSource(const fs::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".h" || extension == ".cpp" || extension == ".in";
}

std::optional<std::string> includedModule(const std::string& line) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*"sluice/([a-z0-9_]+)/)");
  std::smatch match;
  if (!std::regex_search(line, match, kInclude)) return std::nullopt;
  return match[1] == "v1" ? "proto" : match[1].str();
}

void readModule(const fs::path& root, const fs::path& folder, const std::string& module, std::vector<Edge>& edges) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || !isSource(entry.path())) continue;
    std::ifstream in(entry.path());
    int number = 0;
    for (std::string line; std::getline(in, line);) {
      ++number;
      const auto to = includedModule(line);
      if (!to || *to == module) continue;
      edges.push_back({module, *to, fs::relative(entry.path(), root).string() + ":" + std::to_string(number)});
    }
  }
}

std::size_t layerOf(const std::string& module, const Layers& layers) {
  const auto layer = std::find_if(layers.begin(), layers.end(), [&](const auto& l) { return l.contains(module); });
  return static_cast<std::size_t>(layer - layers.begin());
}

}  // namespace

std::vector<Edge> readIncludeGraph(const fs::path& sourceRoot) {
  std::vector<Edge> edges;
  for (const fs::directory_entry& entry : fs::directory_iterator(sourceRoot / "server")) {
    if (entry.is_directory()) readModule(sourceRoot, entry.path(), entry.path().filename().string(), edges);
  }
  readModule(sourceRoot, sourceRoot / "client", "client", edges);
  return edges;
}

std::vector<std::string> forbiddenEdges(const std::vector<Edge>& edges, const Layers& layers) {
  std::vector<std::string> problems;
  for (const Edge& edge : edges) {
    const std::size_t from = layerOf(edge.from, layers);
    const std::size_t to = layerOf(edge.to, layers);
    if (from == layers.size() || to == layers.size()) {
      problems.push_back(edge.place + ": " + edge.from + " -> " + edge.to + ": a module that is in no layer");
    } else if (to >= from) {
      problems.push_back(edge.place + ": " + edge.from + " must not include " + edge.to);
    }
  }
  return problems;
}

std::vector<std::string> findCycle(const std::vector<Edge>& edges) {
  std::map<std::string, std::set<std::string>> next;
  for (const Edge& edge : edges) next[edge.from].insert(edge.to);

  std::set<std::string> done;
  std::vector<std::string> path;
  std::vector<std::string> cycle;
  const std::function<bool(const std::string&)> visit = [&](const std::string& module) {
    const auto onPath = std::find(path.begin(), path.end(), module);
    if (onPath != path.end()) {
      cycle.assign(onPath, path.end());
      return true;
    }
    if (done.contains(module)) return false;
    path.push_back(module);
    const auto outgoing = next.find(module);
    if (outgoing != next.end() && std::any_of(outgoing->second.begin(), outgoing->second.end(), visit)) return true;
    path.pop_back();
    done.insert(module);
    return false;
  };
  for (const auto& [module, targets] : next) {
    if (visit(module)) break;
  }
  return cycle;
}

}  // namespace sluice::architecture
