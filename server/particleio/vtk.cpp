// VTK's legacy format ("VTK File Formats", vtk.org), versions 1 to 5: four header lines, then sections that begin with
// a keyword. Numbers are big-endian in binary files. Points are particles; cells are passed over.

#include <cctype>

#include "attributes.h"
#include "byte_reader.h"
#include "byte_writer.h"
#include "codecs.h"
#include "text_numbers.h"
#include "vtk_data.h"

namespace sluice::particleio {

namespace {

std::string upperCase(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

class VtkReader {
 public:
  VtkReader(std::span<const std::uint8_t> bytes, const std::string& name) : reader_(bytes, name) {}

  ParticleFileData read() {
    readHeader();
    while (true) {
      const std::string keyword = upperCase(reader_.word());
      if (keyword.empty()) break;
      readSection(keyword);
    }
    if (!builder_) throw core::InputError(reader_.fileName(), "", "has no POINTS section");
    return std::move(*builder_).finish();
  }

 private:
  void readHeader() {
    constexpr std::string_view kMagic = "# vtk DataFile Version ";
    const std::string_view first = reader_.line();
    if (!first.starts_with(kMagic)) {
      throw core::InputError(reader_.fileName(), "",
                             "is not a legacy VTK file: it does not begin with \"# vtk DataFile\"");
    }
    const std::string_view version = first.substr(kMagic.size());
    // From 5 on cells are stored as offsets and connectivity.
    offsetsAndConnectivity_ = version.starts_with("5") || version.starts_with("6");
    reader_.line();  // the title
    const std::string encoding = upperCase(reader_.word());
    if (encoding != "ASCII" && encoding != "BINARY") reader_.fail(shown(encoding) + " is neither ASCII nor BINARY");
    binary_ = encoding == "BINARY";
    if (upperCase(reader_.word()) != "DATASET") reader_.fail("DATASET is missing after the header");
    const std::string kind = upperCase(reader_.word());
    if (kind != "POLYDATA" && kind != "UNSTRUCTURED_GRID") {
      reader_.fail("the dataset is " + shown(kind) + "; read are POLYDATA and UNSTRUCTURED_GRID");
    }
  }

  void readSection(const std::string& keyword) {
    if (keyword == "POINTS") {
      readPoints();
    } else if (keyword == "POINT_DATA") {
      attributesOfPoints_ = true;
      tuples_ = readCount("POINT_DATA");
      if (builder_ && tuples_ != points_) {
        reader_.fail("POINT_DATA has " + std::to_string(tuples_) + " entries for " + std::to_string(points_) +
                     " points");
      }
    } else if (keyword == "CELL_DATA") {
      attributesOfPoints_ = false;
      tuples_ = readCount("CELL_DATA");
    } else if (keyword == "VERTICES" || keyword == "LINES" || keyword == "POLYGONS" || keyword == "TRIANGLE_STRIPS" ||
               keyword == "CELLS") {
      skipCells();
    } else if (keyword == "CELL_TYPES") {
      const std::uint64_t count = readCount("CELL_TYPES");
      skipArray(count, VtkType::Int32, "CELL_TYPES");
    } else if (keyword == "FIELD") {
      readField();
    } else if (keyword == "METADATA") {
      // Lines up to an empty one.
      reader_.line();
      while (!reader_.atEnd() && !reader_.line().empty()) {
      }
    } else {
      readAttribute(keyword);
    }
  }

  void readAttribute(const std::string& keyword) {
    if (keyword == "LOOKUP_TABLE") {
      reader_.word();
      const std::uint64_t count = readCount("LOOKUP_TABLE");
      return skipArray(checkedProduct(count, 4), binary_ ? VtkType::UInt8 : VtkType::Float, "LOOKUP_TABLE");
    }
    const std::string name(reader_.word());
    if (keyword == "SCALARS") {
      const VtkType type = readType();
      const std::uint64_t components = readOptionalComponents();
      return readArray(name, components, tuples_, type);
    }
    if (keyword == "VECTORS" || keyword == "NORMALS") return readArray(name, 3, tuples_, readType());
    if (keyword == "TENSORS") return readArray(name, 9, tuples_, readType());
    if (keyword == "TEXTURE_COORDINATES") {
      const std::uint64_t components = readCount("TEXTURE_COORDINATES");
      return readArray(name, components, tuples_, readType());
    }
    if (keyword == "COLOR_SCALARS") {
      const std::uint64_t components = readCount("COLOR_SCALARS");
      return readArray(name, components, tuples_, binary_ ? VtkType::UInt8 : VtkType::Float);
    }
    reader_.fail("the section " + shown(keyword) + " is not known");
  }

  void readPoints() {
    if (builder_) reader_.fail("there are two POINTS sections");
    points_ = readCount("POINTS");
    const VtkType type = readType();
    VtkArrayReader array(reader_, binary_);
    array.begin(checkedProduct(points_, 3), type, "POINTS");
    builder_.emplace(reader_.fileName(), points_);
    for (std::uint64_t i = 0; i < points_; ++i) {
      for (int axis = 0; axis < 3; ++axis) builder_->set(i, {Attribute::Position, axis}, array.next());
    }
  }

  /// Fields stand after POINT_DATA, or before it for the whole file, where their arrays have any length.
  void readField() {
    reader_.word();  // its name
    const std::uint64_t arrays = readCount("FIELD");
    for (std::uint64_t i = 0; i < arrays; ++i) {
      std::string name(reader_.word());
      if (name == "METADATA") {
        readSection("METADATA");
        name = reader_.word();
      }
      if (name.empty()) reader_.fail("the file is cut off: FIELD promises " + std::to_string(arrays) + " arrays");
      const std::uint64_t components = readCount("FIELD");
      const std::uint64_t tuples = readCount("FIELD");
      readArray(name, components, tuples, readType());
    }
  }

  void readArray(const std::string& name, std::uint64_t components, std::uint64_t tuples, VtkType type) {
    const std::optional<Attribute> attribute = attributeNamed(name);
    const bool wanted = builder_ && attributesOfPoints_ && tuples == points_ && attribute &&
                        *attribute != Attribute::Position &&
                        components == static_cast<std::uint64_t>(componentsOf(*attribute));
    if (!wanted) return skipArray(checkedProduct(components, tuples), type, "an array");
    VtkArrayReader array(reader_, binary_);
    array.begin(checkedProduct(components, tuples), type, "an array");
    builder_->enable(*attribute);
    for (std::uint64_t i = 0; i < tuples; ++i) {
      for (int c = 0; c < componentsOf(*attribute); ++c) builder_->set(i, {*attribute, c}, array.next());
    }
  }

  void skipArray(std::uint64_t count, VtkType type, const char* what) {
    VtkArrayReader array(reader_, binary_);
    array.begin(count, type, what);
    array.skip();
  }

  void skipCells() {
    const std::uint64_t first = readCount("cells");
    const std::uint64_t second = readCount("cells");
    if (!offsetsAndConnectivity_) return skipArray(second, VtkType::Int32, "cells");
    for (const std::uint64_t count : {first, second}) {
      reader_.word();  // OFFSETS, CONNECTIVITY
      skipArray(count, readType(), "cells");
    }
  }

  std::uint64_t readCount(const char* what) {
    const std::string_view word = reader_.word();
    const auto count = parseNumber<std::uint64_t>(word);
    if (!count) reader_.fail(shown(word) + " is not a count for " + what);
    return *count;
  }

  VtkType readType() {
    const std::string_view word = reader_.word();
    const std::optional<VtkType> type = vtkTypeNamed(word);
    if (!type) reader_.fail(shown(word) + " is not a type of numbers");
    return *type;
  }

  /// "SCALARS name type [components]", then "LOOKUP_TABLE name".
  std::uint64_t readOptionalComponents() {
    const std::string_view rest = reader_.line();
    std::uint64_t components = 1;
    if (const std::size_t digit = rest.find_first_not_of(" \t"); digit != std::string_view::npos) {
      const auto parsed = parseNumber<std::uint64_t>(rest.substr(digit, rest.find_last_not_of(" \t") - digit + 1));
      if (!parsed) reader_.fail(shown(rest) + " is not a number of components");
      components = *parsed;
    }
    const std::size_t before = reader_.offset();
    if (upperCase(reader_.word()) == "LOOKUP_TABLE") {
      reader_.word();
    } else {
      // Some writers leave the table out; the numbers begin at once.
      reader_.rewindTo(before > 0 ? before - 1 : 0);
    }
    return components;
  }

  std::uint64_t checkedProduct(std::uint64_t a, std::uint64_t b) const {
    if (b != 0 && a > std::numeric_limits<std::uint64_t>::max() / b) {
      reader_.fail("the file is cut off: " + std::to_string(a) + " times " + std::to_string(b) +
                   " numbers are promised");
    }
    return a * b;
  }

  ByteReader reader_;
  bool binary_ = false;
  bool offsetsAndConnectivity_ = false;
  bool attributesOfPoints_ = false;
  std::uint64_t points_ = 0;
  std::uint64_t tuples_ = 0;
  std::optional<ParticleBuilder> builder_;
};

/// One number a particle; nothing where there are none.
template <class Number>
void writeField(ByteWriter& writer, const char* name, const char* type, const std::vector<Number>& values) {
  if (values.empty()) return;
  writer.text(std::string(name) + " 1 " + std::to_string(values.size()) + " " + type + "\n");
  for (const Number value : values) writer.write(value);
  writer.text("\n");
}

}  // namespace

ParticleFileData decodeVtk(std::span<const std::uint8_t> bytes, const std::string& name) {
  return VtkReader(bytes, name).read();
}

Bytes encodeVtk(const ParticleFileData& particles) {
  ByteWriter writer(std::endian::big);
  const std::string count = std::to_string(particles.size());
  writer.text("# vtk DataFile Version 4.1\nParticles\nBINARY\nDATASET POLYDATA\nPOINTS " + count + " float\n");
  for (const Eigen::Vector3f& position : particles.positions) {
    for (const float component : position) writer.write(component);
  }
  // One vertex a particle, so that viewers draw them.
  writer.text("\nVERTICES " + count + " " + std::to_string(2 * particles.size()) + "\n");
  for (std::size_t i = 0; i < particles.size(); ++i) {
    writer.write(std::int32_t{1});
    writer.write(static_cast<std::int32_t>(i));
  }
  const int arrays = int{!particles.velocities.empty()} + int{!particles.densities.empty()} +
                     int{!particles.ids.empty()} + int{!particles.pressures.empty()} + int{!particles.fluids.empty()};
  if (arrays == 0) return std::move(writer).take();
  writer.text("\nPOINT_DATA " + count + "\nFIELD FieldData " + std::to_string(arrays) + "\n");
  if (!particles.velocities.empty()) {
    writer.text("velocity 3 " + count + " float\n");
    for (const Eigen::Vector3f& velocity : particles.velocities) {
      for (const float component : velocity) writer.write(component);
    }
    writer.text("\n");
  }
  writeField(writer, "density", "float", particles.densities);
  writeField(writer, "id", "unsigned_int", particles.ids);
  writeField(writer, "pressure", "float", particles.pressures);
  writeField(writer, "fluid", "unsigned_char", particles.fluids);
  return std::move(writer).take();
}

}  // namespace sluice::particleio
