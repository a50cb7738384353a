#include <algorithm>

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include "names.h"
#include "sluice/core/input_error.h"
#include "sluice/scene/looks.h"
#include "sluice/scene/scene.h"
#include "validate.h"

namespace sluice::scene {

using core::InputError;
using google::protobuf::TextFormat;
using google::protobuf::io::ColumnNumber;

namespace {

/// A zero-based place in a text; columns count as protobuf's tokenizer counts them (tab stops of 8).
struct Location {
  int line = -1;
  int column = -1;
};

std::string toString(const std::string& fileName, Location location) {
  if (location.line < 0) return fileName;
  return fileName + ":" + std::to_string(location.line + 1) + ":" + std::to_string(location.column + 1);
}

std::string_view lineOf(std::string_view text, int line) {
  for (; line > 0; --line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

int columnAfter(std::string_view prefix) {
  constexpr int kTabStop = 8;
  int column = 0;
  for (const char c : prefix) column += c == '\t' ? kTabStop - column % kTabStop : 1;
  return column;
}

/// The text between the first two quotation marks after `from`.
std::string_view quotedPart(std::string_view message, std::size_t from) {
  const std::size_t open = message.find('"', from);
  if (open == std::string_view::npos) return {};
  return message.substr(open + 1, message.find('"', open + 1) - open - 1);
}

/// Keeps the first error of a parse, in our words.
class FirstError : public google::protobuf::io::ErrorCollector {
 public:
  explicit FirstError(std::string_view text) : text_(text) {}

  void AddError(int line, ColumnNumber column, const std::string& message) override {
    if (!problem.empty()) return;
    location = {line, column};
    problem = message;
    while (!problem.empty() && problem.back() == '.') problem.pop_back();
    explainUnknownField(message);
  }

  Location location;
  std::string problem;

 private:
  /// protobuf says: Message type "sluice.v1.Fluid" has no field named "viscocity".
  void explainUnknownField(std::string_view message) {
    constexpr std::string_view kNoField = " has no field named ";
    const std::size_t found = message.find(kNoField);
    if (found == std::string_view::npos) return;
    const std::string typeName(quotedPart(message, 0));
    const std::string_view name = quotedPart(message, found);
    const google::protobuf::Descriptor* type =
        google::protobuf::DescriptorPool::generated_pool()->FindMessageTypeByName(typeName);
    if (type == nullptr) return;
    problem = type->name() + " has no field " + inQuotes(name) + "; " + suggestNames(name, fieldNames(*type));
    // protobuf points at the token after the name.
    const std::string_view line = lineOf(text_, location.line);
    const std::size_t start = line.find(name);
    if (start != std::string_view::npos) location.column = columnAfter(line.substr(0, start));
  }

  std::string_view text_;
};

/// Where the text gives the field, or else the innermost message around it that the text gives.
Location locate(const TextFormat::ParseInfoTree& root, const FieldPath& path) {
  Location best;
  const TextFormat::ParseInfoTree* tree = &root;
  for (const FieldStep& step : path) {
    // A list as a whole is where its first element is.
    const int index = step.field->is_repeated() ? std::max(step.index, 0) : step.index;
    const TextFormat::ParseLocation here = tree->GetLocation(step.field, index);
    // Elements after the first of a list in brackets have no place of their own, but their fields do.
    if (here.line >= 0) best = {here.line, here.column};
    if (step.field->cpp_type() != google::protobuf::FieldDescriptor::CPPTYPE_MESSAGE) break;
    tree = tree->GetTreeForNested(step.field, index);
    if (tree == nullptr) break;
  }
  return best;
}

}  // namespace

v1::Scene parse(std::string_view text, const std::string& fileName) {
  // Deeper than the schema goes, far from what the stack holds.
  constexpr int kDeepest = 32;
  FirstError error(text);
  TextFormat::ParseInfoTree locations;
  TextFormat::Parser parser;
  parser.RecordErrorsTo(&error);
  parser.WriteLocationsTo(&locations);
  parser.SetRecursionLimit(kDeepest);

  v1::Scene scene;
  if (!parser.ParseFromString(std::string(text), &scene)) {
    throw InputError(toString(fileName, error.location), "", error.problem);
  }
  applyPresets(scene);
  complete(scene);
  if (const std::optional<Problem> problem = findProblem(scene)) {
    // A missing field is reported by itself, its place by the message that lacks it.
    throw InputError(toString(fileName, locate(locations, problem->path)), toString(problem->path), problem->text);
  }
  return scene;
}

}  // namespace sluice::scene
