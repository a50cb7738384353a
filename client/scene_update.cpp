#include "sluice/client/scene_update.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string_view>

#include <google/protobuf/message.h>

#include "field_value.h"
#include "sluice/client/failure.h"
#include "sluice/client/field_path.h"
#include "sluice/v1/options.pb.h"

namespace sluice::client {

namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// A list without a bound of its own; the elements before the one that is named have to be sent too.
constexpr std::uint32_t kMaxItems = 10'000;

/// Where a path leads.
struct Place {
  Message* parent = nullptr;
  const FieldDescriptor* field = nullptr;
  std::optional<std::uint32_t> index;
};

std::string fieldNames(const Descriptor& type) {
  std::string names;
  for (int i = 0; i < type.field_count(); ++i) names += (names.empty() ? "" : ", ") + type.field(i)->name();
  return names;
}

std::string join(const std::string& prefix, const std::string& name) {
  return prefix.empty() ? name : prefix + "." + name;
}

std::string text(const PathStep& step) {
  return step.index ? step.name + "[" + std::to_string(*step.index) + "]" : step.name;
}

const FieldDescriptor& findField(const Message& message, const PathStep& step, const std::string& prefix) {
  const FieldDescriptor* field = message.GetDescriptor()->FindFieldByName(step.name);
  if (field == nullptr) {
    throw UsageError(join(prefix, step.name) + ": there is no such field; " + (prefix.empty() ? "a scene" : prefix) +
                     " has " + fieldNames(*message.GetDescriptor()));
  }
  return *field;
}

void checkIndex(const FieldDescriptor& field, const PathStep& step, const std::string& prefix) {
  if (!step.index) return;
  const std::string path = join(prefix, text(step));
  if (!field.is_repeated() || field.message_type() == nullptr) {
    throw UsageError(path + ": " + inQuotes(step.name) + " is no list of messages, so it takes no index");
  }
  const std::uint32_t annotated = field.options().GetExtension(v1::info).max_items();
  const std::uint32_t allowed = annotated > 0 ? annotated : kMaxItems;
  if (*step.index >= allowed) {
    throw UsageError(path + ": an index of " + inQuotes(step.name) + " is at most " + std::to_string(allowed - 1));
  }
}

/// Taking a member of a oneof drops the one that an earlier assignment took.
void refuseSecondMember(const Message& message, const FieldDescriptor& field, const std::string& prefix) {
  const auto* oneof = field.real_containing_oneof();
  if (oneof == nullptr) return;
  const FieldDescriptor* taken = message.GetReflection()->GetOneofFieldDescriptor(message, oneof);
  if (taken != nullptr && taken != &field) {
    throw UsageError(join(prefix, field.name()) + ": " + inQuotes(taken->name()) + " is set too, and " + oneof->name() +
                     " can be only one of them");
  }
}

Message& elementAt(Message& parent, const FieldDescriptor& field, std::uint32_t index) {
  const auto* reflection = parent.GetReflection();
  const int wanted = static_cast<int>(index);
  while (reflection->FieldSize(parent, &field) <= wanted) reflection->AddMessage(&parent, &field);
  return *reflection->MutableRepeatedMessage(&parent, &field, wanted);
}

Message& descend(Message& parent, const FieldDescriptor& field, const PathStep& step, const std::string& path) {
  if (field.message_type() == nullptr) {
    throw UsageError(path + ": is " + allowedValues(field, false) + " and has no fields");
  }
  if (!field.is_repeated()) return *parent.GetReflection()->MutableMessage(&parent, &field);
  if (!step.index) throw UsageError(path + ": is a list; an element of it is named like " + path + "[0]");
  return elementAt(parent, field, *step.index);
}

Place resolve(Message& root, std::string_view path) {
  const std::vector<PathStep> steps = parseFieldPath(path);
  Message* message = &root;
  std::string prefix;
  for (std::size_t i = 0;; ++i) {
    const PathStep& step = steps[i];
    const FieldDescriptor& field = findField(*message, step, prefix);
    checkIndex(field, step, prefix);
    refuseSecondMember(*message, field, prefix);
    if (i + 1 == steps.size()) return {message, &field, step.index};
    prefix = join(prefix, text(step));
    message = &descend(*message, field, step, prefix);
  }
}

void put(const Place& place, const std::string& path, const std::string& value) {
  const std::unique_ptr<Message> scratch(place.parent->New());
  const bool element = place.index.has_value();
  if (const std::string problem = setValue(*scratch, *place.field, element, value); !problem.empty()) {
    throw UsageError(path + ": " + inQuotes(value) + " is not " + allowedValues(*place.field, element) + " (" +
                     problem + ")");
  }
  if (element) {
    elementAt(*place.parent, *place.field, *place.index)
        .CopyFrom(scratch->GetReflection()->GetRepeatedMessage(*scratch, place.field, 0));
    return;
  }
  place.parent->GetReflection()->ClearField(place.parent, place.field);
  place.parent->MergeFrom(*scratch);
}

}  // namespace

v1::UpdateScene sceneUpdate(std::span<const std::string> assignments) {
  v1::UpdateScene update;
  for (const std::string& assignment : assignments) {
    const auto equals = assignment.find('=');
    if (equals == std::string::npos) {
      throw UsageError(inQuotes(assignment) + " is no assignment; one is written path=value");
    }
    const std::string path = assignment.substr(0, equals);
    put(resolve(*update.mutable_scene(), path), path, assignment.substr(equals + 1));
    auto& paths = *update.mutable_mask()->mutable_paths();
    if (std::find(paths.begin(), paths.end(), path) == paths.end()) *paths.Add() = path;
  }
  return update;
}

}  // namespace sluice::client
