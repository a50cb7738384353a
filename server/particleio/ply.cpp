// Stanford PLY 1.0: a header in words, then the elements in its order, in words or binary of either byte order. The
// element "vertex" holds the particles; elements before it are passed over, those after it are not read.

#include <algorithm>
#include <array>

#include "attributes.h"
#include "byte_reader.h"
#include "byte_writer.h"
#include "codecs.h"
#include "text_numbers.h"

namespace sluice::particleio {

namespace {

enum class Type : std::uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float, Double };

std::optional<Type> typeNamed(std::string_view name) {
  using enum Type;
  static constexpr auto kTypes = std::to_array<std::pair<std::string_view, Type>>({{"char", Int8},
                                                                                   {"int8", Int8},
                                                                                   {"uchar", UInt8},
                                                                                   {"uint8", UInt8},
                                                                                   {"short", Int16},
                                                                                   {"int16", Int16},
                                                                                   {"ushort", UInt16},
                                                                                   {"uint16", UInt16},
                                                                                   {"int", Int32},
                                                                                   {"int32", Int32},
                                                                                   {"uint", UInt32},
                                                                                   {"uint32", UInt32},
                                                                                   {"float", Float},
                                                                                   {"float32", Float},
                                                                                   {"double", Double},
                                                                                   {"float64", Double}});
  const auto* found = std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& t) { return t.first == name; });
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

std::size_t sizeOf(Type type) {
  switch (type) {
    case Type::Int8:
    case Type::UInt8:
      return 1;
    case Type::Int16:
    case Type::UInt16:
      return 2;
    case Type::Double:
      return 8;
    default:
      return 4;
  }
}

struct Property {
  Type type = Type::Float;
  std::optional<Type> countType;  ///< Set for lists.
  std::optional<Target> target;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  /// The least bytes that one of them takes: binary, or a digit and a blank for each number.
  std::uint64_t leastSize(bool binary) const {
    std::uint64_t size = 0;
    for (const Property& property : properties) {
      size += binary ? sizeOf(property.countType.value_or(property.type)) : 2;
    }
    return size;
  }
};

class PlyReader {
 public:
  PlyReader(std::span<const std::uint8_t> bytes, const std::string& name) : reader_(bytes, name) {}

  ParticleFileData read() {
    readHeader();
    for (const Element& element : elements_) {
      if (element.name == "vertex") return readParticles(element);
      skip(element);
    }
    throw core::InputError(reader_.fileName(), "", "has no element \"vertex\"");
  }

 private:
  std::string_view word() {
    const std::size_t blank = std::min(line_.find(' '), line_.size());
    const std::string_view result = line_.substr(0, blank);
    line_.remove_prefix(std::min(line_.find_first_not_of(' ', blank), line_.size()));
    return result;
  }

  void readHeader() {
    if (reader_.line() != "ply") {
      throw core::InputError(reader_.fileName(), "", "is not a PLY file: its first line is not \"ply\"");
    }
    bool formatKnown = false;
    while (true) {
      if (reader_.atEnd()) reader_.fail("the file is cut off: end_header is missing");
      line_ = reader_.line();
      const std::string_view keyword = word();
      if (keyword == "end_header") break;
      if (keyword == "format") {
        readFormat();
        formatKnown = true;
      } else if (keyword == "element") {
        readElement();
      } else if (keyword == "property") {
        readProperty();
      } else if (keyword != "comment" && keyword != "obj_info") {
        reader_.fail("the header's line " + shown(keyword) + " is not known");
      }
    }
    if (!formatKnown) reader_.fail("the header has no line \"format\"");
  }

  void readFormat() {
    const std::string_view format = word();
    binary_ = format != "ascii";
    order_ = format == "binary_big_endian" ? std::endian::big : std::endian::little;
    if (binary_ && format != "binary_big_endian" && format != "binary_little_endian") {
      reader_.fail(shown(format) + " is not a format; known are ascii, binary_little_endian, binary_big_endian");
    }
  }

  void readElement() {
    Element element;
    element.name = std::string(word());
    const std::string_view count = word();
    const auto parsed = parseNumber<std::uint64_t>(count);
    if (!parsed) reader_.fail(shown(count) + " is not a count of elements");
    element.count = *parsed;
    elements_.push_back(std::move(element));
  }

  void readProperty() {
    if (elements_.empty()) reader_.fail("a property stands before any element");
    Property property;
    std::string_view type = word();
    if (type == "list") {
      property.countType = readType(word());
      if (*property.countType >= Type::Float) reader_.fail("the count of a list is not a whole number");
      type = word();
    }
    property.type = readType(type);
    if (!property.countType) property.target = targetNamed(word());
    elements_.back().properties.push_back(property);
  }

  Type readType(std::string_view name) const {
    const std::optional<Type> type = typeNamed(name);
    if (!type) reader_.fail(shown(name) + " is not a type of numbers");
    return *type;
  }

  double number(Type type) {
    constexpr const char* kWhat = "an element";
    if (!binary_) {
      const std::string_view text = reader_.word();
      const std::optional<double> value = parseNumber<double>(text);
      if (!value) reader_.fail(text.empty() ? "the file is cut off" : shown(text) + " is not a number");
      return *value;
    }
    switch (type) {
      case Type::Int8:
        return reader_.read<std::int8_t>(order_, kWhat);
      case Type::UInt8:
        return reader_.read<std::uint8_t>(order_, kWhat);
      case Type::Int16:
        return reader_.read<std::int16_t>(order_, kWhat);
      case Type::UInt16:
        return reader_.read<std::uint16_t>(order_, kWhat);
      case Type::Int32:
        return reader_.read<std::int32_t>(order_, kWhat);
      case Type::UInt32:
        return reader_.read<std::uint32_t>(order_, kWhat);
      case Type::Float:
        return reader_.read<float>(order_, kWhat);
      case Type::Double:
        return reader_.read<double>(order_, kWhat);
    }
    return 0;
  }

  void skipList(const Property& property) {
    const double length = number(*property.countType);
    if (!(length >= 0)) reader_.fail("the count of a list is negative");
    const auto count = static_cast<std::uint64_t>(std::min(length, 1e15));
    if (binary_) return reader_.skip(count, sizeOf(property.type), "a list");
    for (std::uint64_t i = 0; i < count; ++i) number(property.type);
  }

  void skip(const Element& element) {
    checkSize(element);
    for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
      for (const Property& property : element.properties) {
        if (property.countType) {
          skipList(property);
        } else {
          number(property.type);
        }
      }
    }
  }

  ParticleFileData readParticles(const Element& element) {
    std::array<bool, 3> axes{};
    for (const Property& property : element.properties) {
      if (property.target && property.target->attribute == Attribute::Position) {
        axes[static_cast<std::size_t>(property.target->component)] = true;
      }
    }
    if (axes != std::array{true, true, true}) reader_.fail("the element \"vertex\" lacks one of x, y, z");
    checkSize(element);

    ParticleBuilder builder(reader_.fileName(), element.count);
    for (const Property& property : element.properties) {
      if (property.target) builder.enable(property.target->attribute);
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const Property& property : element.properties) {
        if (property.countType) {
          skipList(property);
          continue;
        }
        const double value = number(property.type);
        if (property.target) builder.set(i, *property.target, value);
      }
    }
    return std::move(builder).finish();
  }

  void checkSize(const Element& element) const {
    const std::uint64_t least = element.leastSize(binary_);
    // The last number of a text needs no blank after it.
    if (!binary_ && least > 0 && element.count <= (reader_.remaining() + 1) / least) return;
    reader_.require(element.count, least, ("the element \"" + element.name + "\"").c_str());
  }

  ByteReader reader_;
  std::string_view line_;
  bool binary_ = false;
  std::endian order_ = std::endian::little;
  std::vector<Element> elements_;
};

}  // namespace

ParticleFileData decodePly(std::span<const std::uint8_t> bytes, const std::string& name) {
  return PlyReader(bytes, name).read();
}

Bytes encodePly(const ParticleFileData& particles) {
  ByteWriter writer(std::endian::little);
  const bool velocity = !particles.velocities.empty();
  const bool density = !particles.densities.empty();
  const bool id = !particles.ids.empty();
  writer.text("ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(particles.size()) + "\n");
  writer.text("property float x\nproperty float y\nproperty float z\n");
  if (velocity) writer.text("property float vx\nproperty float vy\nproperty float vz\n");
  if (density) writer.text("property float density\n");
  if (id) writer.text("property uint id\n");
  writer.text("end_header\n");
  for (std::size_t i = 0; i < particles.size(); ++i) {
    for (const float component : particles.positions[i]) writer.write(component);
    if (velocity) {
      for (const float component : particles.velocities[i]) writer.write(component);
    }
    if (density) writer.write(particles.densities[i]);
    if (id) writer.write(particles.ids[i]);
  }
  return std::move(writer).take();
}

}  // namespace sluice::particleio
