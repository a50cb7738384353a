// The schema keeps its promises: what everything generated from the annotations relies on.
#include <functional>

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include "sluice/v1/options.pb.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::scene::test {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

bool isVector(const FieldDescriptor& field) { return field.message_type() == v1::Vec3::descriptor(); }

/// Visits every field that a scene reaches, the components of vectors excepted.
void visit(const Descriptor& type, const std::function<void(const FieldDescriptor&, const v1::FieldInfo&)>& visitor) {
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    visitor(field, field.options().GetExtension(v1::info));
    if (field.message_type() != nullptr && !isVector(field)) visit(*field.message_type(), visitor);
  }
}

TEST(Annotations, EveryFieldIsExplained) {
  visit(*v1::Scene::descriptor(), [](const FieldDescriptor& field, const v1::FieldInfo& info) {
    EXPECT_FALSE(info.doc().empty()) << field.full_name();
    EXPECT_EQ(info.doc().find('\n'), std::string::npos) << field.full_name();
  });
}

TEST(Annotations, EveryValueSaysWhenItTakesEffect) {
  visit(*v1::Scene::descriptor(), [](const FieldDescriptor& field, const v1::FieldInfo& info) {
    const bool value = field.message_type() == nullptr || isVector(field);
    EXPECT_TRUE(!value || info.apply() != v1::APPLY_UNSPECIFIED) << field.full_name();
  });
}

TEST(Annotations, EveryNumberHasARangeThatHoldsItsDefault) {
  visit(*v1::Scene::descriptor(), [](const FieldDescriptor& field, const v1::FieldInfo& info) {
    double value = 0;
    switch (field.cpp_type()) {
      case FieldDescriptor::CPPTYPE_DOUBLE:
        value = field.default_value_double();
        break;
      case FieldDescriptor::CPPTYPE_UINT32:
        value = field.default_value_uint32();
        break;
      default:
        return;
    }
    ASSERT_TRUE(info.has_min() && info.has_max()) << field.full_name();
    EXPECT_LE(info.min(), value) << field.full_name();
    EXPECT_GE(info.max(), value) << field.full_name();
    EXPECT_TRUE(!info.logarithmic() || info.min() > 0) << field.full_name();
  });
}

TEST(Annotations, EveryVectorHasARangeThatHoldsItsDefault) {
  visit(*v1::Scene::descriptor(), [](const FieldDescriptor& field, const v1::FieldInfo& info) {
    if (field.message_type() == nullptr || !isVector(field)) return;
    ASSERT_TRUE(info.has_min() && info.has_max()) << field.full_name();
    if (info.required()) return;
    v1::Vec3 value;
    ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(info.default_text(), &value)) << field.full_name();
    for (const double component : {value.x(), value.y(), value.z()}) {
      EXPECT_LE(info.min(), component) << field.full_name();
      EXPECT_GE(info.max(), component) << field.full_name();
    }
    EXPECT_FALSE(info.default_text().empty()) << field.full_name() << " has no default";
  });
}

TEST(Annotations, ComparedFieldsStandBesideEachOther) {
  visit(*v1::Scene::descriptor(), [](const FieldDescriptor& field, const v1::FieldInfo& info) {
    for (const std::string& name : {info.below(), info.at_most()}) {
      if (name.empty()) continue;
      const FieldDescriptor* other = field.containing_type()->FindFieldByName(name);
      ASSERT_NE(other, nullptr) << field.full_name() << " names " << name;
      EXPECT_EQ(other->message_type(), field.message_type()) << field.full_name();
    }
  });
}

TEST(Annotations, EveryChoiceHasADefaultAmongItsMembers) {
  visit(*v1::Scene::descriptor(), [](const FieldDescriptor& field, const v1::FieldInfo&) {
    const google::protobuf::OneofDescriptor* oneof = field.real_containing_oneof();
    if (oneof == nullptr) return;
    EXPECT_NE(field.message_type(), nullptr) << field.full_name() << ": members of a choice are messages";
    const std::string& member = oneof->options().GetExtension(v1::choice).default_member();
    const FieldDescriptor* chosen = field.containing_type()->FindFieldByName(member);
    ASSERT_NE(chosen, nullptr) << oneof->full_name();
    EXPECT_EQ(chosen->containing_oneof(), oneof);
  });
}

}  // namespace
}  // namespace sluice::scene::test
