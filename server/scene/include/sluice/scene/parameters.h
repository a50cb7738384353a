#pragma once

#include <string>
#include <vector>

#include "sluice/v1/options.pb.h"

namespace sluice::scene {

/// One thing that a scene can set, as its annotation describes it.
struct Parameter {
  std::string path;          ///< As in --set; elements of a list stand as [0]: "simulation.fluids[0].viscosity".
  std::string type;          ///< "number", "whole number", "yes or no", "text", "vector", "colour", "choice", "list".
  std::string defaultValue;  ///< As in --set; empty where a scene has to give it or has none.
  v1::FieldInfo info;        ///< Unit, range, doc, when a change takes effect.
  std::string choiceOf;      ///< Path of the oneof that this is a member of ("look.smoothing.method"); else empty.
  bool chosenByDefault = false;
};

/// Every parameter of a scene, in the order of the schema: values, members of oneofs, lists. Thread-safe.
std::vector<Parameter> parameters();

/// A reference of all parameters as a Markdown page.
std::string parameterReferenceMarkdown();

}  // namespace sluice::scene
