#include <sstream>

#include "annotations.h"
#include "sluice/scene/parameters.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::scene {

namespace {

constexpr const char* kIntroduction = R"(# Parameters

Everything a scene can set, read off the annotated fields of `proto/sluice/v1/scene.proto`; do not edit this page by
hand. A path is written as in `--set path=value` and in the viewers' requests: vectors and colours as `1,2,3`, a choice
as `look.smoothing.bilateral={}`, an element of a list by its index; for `--set`, the index one past the end adds an
element, as `bodies[0].sphere={}` does where there are no bodies. In a scene file the same fields are nested in
protobuf text format. A vector that a scene gives in part has 0 in the components it does not give. A *live* parameter
takes effect from the next step or frame on; a *restart* one starts the scene again from its initial state.
)";

std::string cell(const std::string& text) { return text.empty() ? " " : " " + text + " "; }

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

std::string defaultCell(const Parameter& parameter) {
  if (parameter.info.required() || parameter.info.min_items() > 0) return "to be given";
  if (parameter.info.feature()) return "off";
  if (!parameter.choiceOf.empty()) return parameter.chosenByDefault ? "chosen" : "";
  return code(parameter.defaultValue);
}

std::string allowedCell(const Parameter& parameter) {
  const v1::FieldInfo& info = parameter.info;
  if (parameter.type == "list") {
    std::string text = std::to_string(info.min_items());
    if (info.max_items() == 0) return "at least " + text + " elements";
    if (info.max_items() == info.min_items()) return text + (info.min_items() == 1 ? " element" : " elements");
    return text + " to " + std::to_string(info.max_items()) + " elements";
  }
  std::string text = allowedText(info);
  // Components of unbounded vectors still have a unit to name.
  if (text.empty()) text = info.unit();
  if (!info.below().empty()) text += ", below " + code(info.below());
  if (!info.at_most().empty()) text += ", at most " + code(info.at_most());
  return text;
}

const char* applyCell(v1::Apply apply) {
  switch (apply) {
    case v1::LIVE:
      return "live";
    case v1::RESTART:
      return "restart";
    default:
      return "";
  }
}

}  // namespace

std::string parameterReferenceMarkdown() {
  std::ostringstream page;
  page << kIntroduction;
  std::string section = "none";
  for (const Parameter& parameter : parameters()) {
    const std::size_t dot = parameter.path.find('.');
    const std::string group = dot == std::string::npos ? "" : parameter.path.substr(0, dot);
    // A choice heads the section of its own fields.
    const std::string wanted = group.empty() && parameter.type == "choice" ? parameter.path : group;
    if (wanted != section) {
      section = wanted;
      page << "\n## " << (section.empty() ? "The scene itself" : section) << "\n\n"
           << "| path | what it does | type | default | allowed | takes effect |\n|---|---|---|---|---|---|\n";
    }
    const std::string choice = parameter.choiceOf.empty() ? "" : " (one of " + code(parameter.choiceOf) + ")";
    page << "|" << cell(code(parameter.path)) << "|" << cell(parameter.info.doc() + choice) << "|"
         << cell(parameter.type) << "|" << cell(defaultCell(parameter)) << "|" << cell(allowedCell(parameter)) << "|"
         << cell(applyCell(parameter.info.apply())) << "|\n";
  }
  return page.str();
}

}  // namespace sluice::scene
