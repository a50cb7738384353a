#include "include_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sluice::architecture {
namespace {

using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The agreed order: each stage of the data's way knows only what lies below it, never its neighbour.
const Layers kLayers = {
    {"proto"},
    {"core"},
    {"scene", "gl", "imageio", "particleio", "media"},
    {"solids"},
    {"sim", "sources", "surface", "render", "encode", "stream", "client"},
    {"evaluate"},
    {"app"},
};

TEST(IncludeGraph, HasNoForbiddenEdge) {
  const std::vector<Edge> edges = readIncludeGraph(SLUICE_SOURCE_DIR);
  EXPECT_GT(edges.size(), 20U) << "the reader found next to nothing";
  EXPECT_THAT(forbiddenEdges(edges, kLayers), IsEmpty());
}

TEST(IncludeGraph, HasNoCycle) { EXPECT_THAT(findCycle(readIncludeGraph(SLUICE_SOURCE_DIR)), IsEmpty()); }

TEST(IncludeGraph, ClientKnowsTheProtocolAndVideoAlone) {
  for (const Edge& edge : readIncludeGraph(SLUICE_SOURCE_DIR)) {
    if (edge.from == "client") {
      EXPECT_THAT(edge.to, AnyOf("proto", "media")) << edge.place;
    }
  }
}

TEST(IncludeGraph, ForbiddenEdgesAreSeen) {
  EXPECT_THAT(forbiddenEdges({{"render", "sim", "a.cpp:1"}}, kLayers), ElementsAre(HasSubstr("a.cpp:1")));
  EXPECT_THAT(forbiddenEdges({{"core", "scene", "b.h:2"}}, kLayers), ElementsAre(HasSubstr("must not")));
  EXPECT_THAT(forbiddenEdges({{"app", "gadgets", "c.h:3"}}, kLayers), ElementsAre(HasSubstr("no layer")));
  EXPECT_THAT(forbiddenEdges({{"app", "core", "d.h:4"}}, kLayers), IsEmpty());
}

TEST(IncludeGraph, CyclesAreSeen) {
  EXPECT_THAT(findCycle({{"a", "b", ""}, {"b", "c", ""}, {"c", "b", ""}}), ElementsAre("b", "c"));
  EXPECT_THAT(findCycle({{"a", "b", ""}, {"a", "c", ""}, {"b", "c", ""}}), IsEmpty());
}

}  // namespace
}  // namespace sluice::architecture
