// Houdini's classic geometry format, version 5, as Houdini 11 and earlier, partio, SPlisHSPlasH and splashsurf write
// it: a header, the descriptions of the point attributes, then for each point four floats x y z w and its attributes;
// all big-endian. What follows the points (primitives, detail attributes) is not read.

#include "attributes.h"
#include "byte_reader.h"
#include "byte_writer.h"
#include "codecs.h"
#include "gzip.h"
#include "text_numbers.h"

namespace sluice::particleio {

namespace {

constexpr std::endian kOrder = std::endian::big;
constexpr std::string_view kMagic = "BgeoV";
constexpr std::int32_t kVersion = 5;

enum class Type : std::int32_t { Float = 0, Integer = 1, IndexedText = 4, Vector = 5 };

struct PointAttribute {
  std::optional<Attribute> attribute;
  Type type = Type::Float;
  std::uint16_t components = 0;
};

PointAttribute readDescription(ByteReader& reader) {
  const auto nameLength = reader.read<std::uint16_t>(kOrder, "an attribute's name");
  const std::string name(reader.text(nameLength, "an attribute's name"));
  PointAttribute described;
  described.components = reader.read<std::uint16_t>(kOrder, "an attribute's size");
  const auto type = reader.read<std::int32_t>(kOrder, "an attribute's type");
  described.type = static_cast<Type>(type);
  switch (described.type) {
    case Type::Float:
    case Type::Integer:
    case Type::Vector:
      reader.skip(described.components, sizeof(float), "an attribute's default");
      break;
    case Type::IndexedText: {
      const auto strings = reader.read<std::uint32_t>(kOrder, "an attribute's strings");
      reader.require(strings, sizeof(std::uint16_t), "an attribute's strings");
      for (std::uint32_t i = 0; i < strings; ++i) {
        reader.skip(reader.read<std::uint16_t>(kOrder, "a string"), 1, "a string");
      }
      break;
    }
    default:
      reader.fail("the attribute " + shown(name) + " has type " + std::to_string(type) +
                  "; known are 0 (float), 1 (integer), 4 (text) and 5 (vector)");
  }
  const std::optional<Attribute> attribute = attributeNamed(name);
  // The position has a place of its own before the attributes.
  if (attribute && *attribute != Attribute::Position && described.type != Type::IndexedText &&
      componentsOf(*attribute) == described.components) {
    described.attribute = attribute;
  }
  return described;
}

double readNumber(ByteReader& reader, const PointAttribute& described) {
  if (described.type != Type::Integer) return reader.read<float>(kOrder, "an attribute");
  // Programs store unsigned ids in the format's signed integers.
  if (described.attribute == Attribute::Id) return reader.read<std::uint32_t>(kOrder, "an attribute");
  return reader.read<std::int32_t>(kOrder, "an attribute");
}

ParticleFileData decodePlain(std::span<const std::uint8_t> bytes, const std::string& name) {
  ByteReader reader(bytes, name);
  if (reader.text(kMagic.size(), "the magic number") != kMagic) {
    throw core::InputError(name, "", "is not a BGEO file: it begins with neither \"BgeoV\" nor gzip's signature");
  }
  const auto version = reader.read<std::int32_t>(kOrder, "the header");
  if (version != kVersion) {
    throw core::InputError(name, "", "has BGEO version " + std::to_string(version) + "; only version 5 is read");
  }
  const auto points = reader.read<std::int32_t>(kOrder, "the header");
  reader.skip(3, sizeof(std::int32_t), "the header");  // primitives, point groups, primitive groups
  const auto attributeCount = reader.read<std::int32_t>(kOrder, "the header");
  reader.skip(3, sizeof(std::int32_t), "the header");  // attributes of vertices, of primitives and of the whole
  if (points < 0 || attributeCount < 0) reader.fail("a count in the header is negative");
  // Name length, size and type: the least that describes an attribute.
  reader.require(static_cast<std::uint64_t>(attributeCount), 8, "the point attributes");

  std::vector<PointAttribute> attributes;
  std::uint64_t stride = 4 * sizeof(float);
  for (std::int32_t i = 0; i < attributeCount; ++i) {
    attributes.push_back(readDescription(reader));
    stride += attributes.back().components * sizeof(float);
  }
  reader.require(static_cast<std::uint64_t>(points), stride, "the points");

  ParticleBuilder builder(name, static_cast<std::size_t>(points));
  for (const PointAttribute& described : attributes) {
    if (described.attribute) builder.enable(*described.attribute);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(points); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      builder.set(i, {Attribute::Position, axis}, reader.read<float>(kOrder, "a point"));
    }
    reader.skip(1, sizeof(float), "a point");  // w, which weighs splines
    for (const PointAttribute& described : attributes) {
      if (!described.attribute) {
        reader.skip(described.components, sizeof(float), "an attribute");
        continue;
      }
      for (int c = 0; c < described.components; ++c) {
        builder.set(i, {*described.attribute, c}, readNumber(reader, described));
      }
    }
  }
  return std::move(builder).finish();
}

void describe(ByteWriter& writer, std::string_view name, std::uint16_t components, Type type) {
  writer.write(static_cast<std::uint16_t>(name.size()));
  writer.text(name);
  writer.write(components);
  writer.write(static_cast<std::int32_t>(type));
  for (int i = 0; i < components; ++i) writer.write(std::int32_t{0});
}

}  // namespace

ParticleFileData decodeBgeo(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (!isGzip(bytes)) return decodePlain(bytes, name);
  // 25 million particles with every attribute; a hostile file of a megabyte can unpack to this much.
  constexpr std::size_t kLargest = std::size_t{1} << 30U;
  return decodePlain(gunzip(bytes, name, kLargest), name);
}

Bytes encodeBgeo(const ParticleFileData& particles) {
  ByteWriter writer(kOrder);
  const bool velocity = !particles.velocities.empty();
  const bool density = !particles.densities.empty();
  const bool id = !particles.ids.empty();
  const bool pressure = !particles.pressures.empty();
  const bool fluid = !particles.fluids.empty();
  writer.text(kMagic);
  writer.write(kVersion);
  writer.write(static_cast<std::int32_t>(particles.size()));
  for (int i = 0; i < 3; ++i) writer.write(std::int32_t{0});
  writer.write(std::int32_t{velocity} + std::int32_t{density} + std::int32_t{id} + std::int32_t{pressure} +
               std::int32_t{fluid});
  for (int i = 0; i < 3; ++i) writer.write(std::int32_t{0});
  if (velocity) describe(writer, "v", 3, Type::Vector);
  if (density) describe(writer, "density", 1, Type::Float);
  if (id) describe(writer, "id", 1, Type::Integer);
  if (pressure) describe(writer, "pressure", 1, Type::Float);
  if (fluid) describe(writer, "fluid", 1, Type::Integer);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    for (const float component : particles.positions[i]) writer.write(component);
    writer.write(1.0F);
    if (velocity) {
      for (const float component : particles.velocities[i]) writer.write(component);
    }
    if (density) writer.write(particles.densities[i]);
    if (id) writer.write(particles.ids[i]);
    if (pressure) writer.write(particles.pressures[i]);
    if (fluid) writer.write(std::int32_t{particles.fluids[i]});
  }
  // The mark at the end of the file.
  writer.write(std::uint8_t{0x00});
  writer.write(std::uint8_t{0xff});
  return std::move(writer).take();
}

}  // namespace sluice::particleio
