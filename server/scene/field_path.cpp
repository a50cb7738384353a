#include "field_path.h"

#include <charconv>
#include <optional>

#include "annotations.h"
#include "names.h"
#include "sluice/core/input_error.h"

namespace sluice::scene {

using core::InputError;
using google::protobuf::Message;

namespace {

struct Segment {
  std::string name;
  std::optional<int> index;
};

Segment parseSegment(std::string_view text, const std::string& path) {
  const std::size_t bracket = text.find('[');
  Segment segment{std::string(text.substr(0, bracket)), std::nullopt};
  const char* problem = nullptr;
  if (segment.name.empty()) {
    problem = "a name is missing";
  } else if (bracket != std::string_view::npos) {
    const std::string_view digits = text.substr(bracket + 1);
    int index = -1;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (error != std::errc() || index < 0 || std::string_view(end, digits.data() + digits.size()) != "]") {
      problem = "an index is written [0], [1], …";
    }
    segment.index = index;
  }
  if (problem != nullptr) {
    throw InputError("", "",
                     inQuotes(path) + " is not a field path: " + problem + "; a path is like fluids[0].viscosity");
  }
  return segment;
}

std::vector<Segment> split(const std::string& path) {
  std::vector<Segment> segments;
  std::string_view rest = path;
  while (true) {
    const std::size_t dot = rest.find('.');
    segments.push_back(parseSegment(rest.substr(0, dot), path));
    if (dot == std::string_view::npos) return segments;
    rest.remove_prefix(dot + 1);
  }
}

void checkIndex(Message& holder, const google::protobuf::FieldDescriptor& field, const Segment& segment,
                const std::string& path, PastTheEnd pastTheEnd) {
  if (!segment.index) return;
  if (!field.is_repeated()) throw InputError("", path, field.name() + " is not a list; write it without an index");
  const int size = holder.GetReflection()->FieldSize(holder, &field);
  if (*segment.index < size) return;
  const bool appends = pastTheEnd == PastTheEnd::Appends && isMessage(field);
  if (appends && *segment.index == size) {
    holder.GetReflection()->AddMessage(&holder, &field);
    return;
  }
  std::string there = "is empty";
  if (size == 1) there = "has 1 element; the only index is 0";
  if (size > 1) there = "has " + std::to_string(size) + " elements; the last index is " + std::to_string(size - 1);
  if (appends) there += "; index " + std::to_string(size) + " would add one";
  throw InputError("", path,
                   "there is no element " + std::to_string(*segment.index) + ": " + field.name() + " " + there);
}

}  // namespace

std::string toString(const FieldPath& path) {
  std::string text;
  for (const FieldStep& step : path) {
    if (!text.empty()) text += '.';
    text += step.field->name();
    if (step.index >= 0) text.append("[").append(std::to_string(step.index)).append("]");
  }
  return text;
}

std::string joinPaths(const std::string& outer, const std::string& inner) {
  return outer + (outer.empty() || inner.empty() ? "" : ".") + inner;
}

Place resolve(Message& root, const std::string& path, PastTheEnd pastTheEnd) {
  const std::vector<Segment> segments = split(path);
  FieldPath walked;
  Message* message = &root;
  for (std::size_t i = 0;; ++i) {
    const Segment& segment = segments[i];
    const google::protobuf::Descriptor& type = *message->GetDescriptor();
    const google::protobuf::FieldDescriptor* field = type.FindFieldByName(segment.name);
    if (field == nullptr) {
      const std::string where = walked.empty() ? "a scene" : toString(walked);
      throw InputError(
          "", path,
          where + " has no field " + inQuotes(segment.name) + "; " + suggestNames(segment.name, fieldNames(type)));
    }
    checkIndex(*message, *field, segment, path, pastTheEnd);
    const FieldStep step{field, segment.index.value_or(-1)};
    if (i + 1 == segments.size()) return {message, step};

    walked.push_back(step);
    if (!isMessage(*field)) throw InputError("", path, toString(walked) + " is a single value without fields");
    if (field->is_repeated() && !segment.index) {
      throw InputError("", path, field->name() + " is a list; say which element, as in " + field->name() + "[0]");
    }
    const google::protobuf::Reflection& reflection = *message->GetReflection();
    message = field->is_repeated() ? reflection.MutableRepeatedMessage(message, field, step.index)
                                   : reflection.MutableMessage(message, field);
  }
}

}  // namespace sluice::scene
