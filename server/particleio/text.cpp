// Particles as lines of numbers between commas, semicolons, tabs or blanks. Lines that begin with # and empty lines are
// passed over. Where the first line has words, they name the columns; else the first three columns are x, y, z. The
// count and comment that head chemists' XYZ files, and their element symbols, are passed over too.

#include <algorithm>
#include <array>
#include <charconv>

#include "attributes.h"
#include "byte_writer.h"
#include "codecs.h"
#include "sluice/core/input_error.h"
#include "text_numbers.h"

namespace sluice::particleio {

namespace {

constexpr std::string_view kBlank = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

struct Line {
  std::string_view text;
  std::size_t number = 0;  ///< In the file, from 1.
};

std::vector<Line> linesWithContent(std::string_view text) {
  std::vector<Line> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    if (!line.empty() && line.front() != '#') lines.push_back({line, number});
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// Cuts a line at a separator; at every run of blanks and tabs where that is a blank.
class Splitter {
 public:
  explicit Splitter(std::string_view sample) {
    for (const char candidate : {',', ';'}) {
      if (sample.find(candidate) == std::string_view::npos) continue;
      separator_ = candidate;
      return;
    }
  }

  void split(std::string_view line, std::vector<std::string_view>& fields) const {
    fields.clear();
    while (true) {
      const std::size_t end =
          std::min(separator_ == ' ' ? line.find_first_of(kBlank) : line.find(separator_), line.size());
      std::string_view field = trimmed(line.substr(0, end));
      if (field.size() >= 2 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
      fields.push_back(field);
      if (end == line.size()) return;
      line.remove_prefix(end + 1);
      if (separator_ == ' ') line = trimmed(line);
    }
  }

 private:
  char separator_ = ' ';
};

class TextReader {
 public:
  TextReader(std::string_view text, const std::string& name)
      : name_(name), lines_(linesWithContent(text)), splitter_(lines_.empty() ? "" : lines_.front().text) {}

  ParticleFileData read() {
    std::size_t first = 0;
    if (!lines_.empty()) first = readHead();
    ParticleBuilder builder(name_, lines_.size() - first);
    for (const auto& target : columns_) {
      if (target) builder.enable(target->attribute);
    }
    for (std::size_t i = first; i < lines_.size(); ++i) readLine(builder, i - first, lines_[i]);
    return std::move(builder).finish();
  }

 private:
  /// Decides on the columns; returns the index of the first line with a particle.
  std::size_t readHead() {
    columns_ = {Target{Attribute::Position, 0}, Target{Attribute::Position, 1}, Target{Attribute::Position, 2}};
    splitter_.split(lines_.front().text, fields_);
    if (fields_.size() == 1) {
      if (const auto count = parseNumber<std::uint64_t>(fields_.front())) return skipChemistsHead(*count);
    }
    const bool named = std::any_of(fields_.begin(), fields_.end(), [](auto f) { return !parseNumber<double>(f); });
    if (!named) return 0;
    columns_.clear();
    std::array<bool, 3> axes{};
    for (const std::string_view field : fields_) {
      columns_.push_back(targetNamed(field));
      if (columns_.back() && columns_.back()->attribute == Attribute::Position) {
        axes[static_cast<std::size_t>(columns_.back()->component)] = true;
      }
    }
    if (axes != std::array{true, true, true}) {
      fail(lines_.front(), "names no columns x, y, z: " + shown(lines_.front().text));
    }
    return 1;
  }

  /// The number of particles alone on a line, then a comment, which may be empty and so be no line of ours.
  std::size_t skipChemistsHead(std::uint64_t count) {
    const std::size_t others = lines_.size() - 1;
    if (count != others && count + 1 != others) {
      fail(lines_.front(), "promises " + std::to_string(count) + " particles; " + std::to_string(others) +
                               " lines follow (one of them may be a comment)");
    }
    const std::size_t first = lines_.size() - static_cast<std::size_t>(count);
    if (first < lines_.size()) {
      splitter_ = Splitter(lines_[first].text);
      splitter_.split(lines_[first].text, fields_);
      if (!parseNumber<double>(fields_.front())) columns_.insert(columns_.begin(), std::nullopt);
    }
    return first;
  }

  void readLine(ParticleBuilder& builder, std::size_t particle, const Line& line) {
    splitter_.split(line.text, fields_);
    if (fields_.size() < columns_.size()) {
      fail(line,
           "has " + std::to_string(fields_.size()) + " columns; " + std::to_string(columns_.size()) + " are needed");
    }
    for (std::size_t column = 0; column < columns_.size(); ++column) {
      if (!columns_[column]) continue;
      const std::optional<double> value = parseNumber<double>(fields_[column]);
      if (!value) fail(line, shown(fields_[column]) + " in column " + std::to_string(column + 1) + " is not a number");
      builder.set(particle, *columns_[column], *value);
    }
  }

  [[noreturn]] void fail(const Line& line, const std::string& problem) const {
    throw core::InputError(name_ + ":" + std::to_string(line.number), "", problem);
  }

  const std::string& name_;
  std::vector<Line> lines_;
  Splitter splitter_;
  std::vector<std::optional<Target>> columns_;
  std::vector<std::string_view> fields_;
};

void writeNumber(ByteWriter& writer, float value, std::string_view after) {
  std::array<char, 24> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  writer.text({buffer.data(), end});
  writer.text(after);
}

}  // namespace

ParticleFileData decodeText(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (std::find(bytes.begin(), bytes.end(), std::uint8_t{0}) != bytes.end()) {
    throw core::InputError(name, "", "is not a text file");
  }
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return TextReader(text, name).read();
}

Bytes encodeXyz(const ParticleFileData& particles) {
  ByteWriter writer(std::endian::native);
  for (const Eigen::Vector3f& p : particles.positions) {
    writeNumber(writer, p.x(), " ");
    writeNumber(writer, p.y(), " ");
    writeNumber(writer, p.z(), "\n");
  }
  return std::move(writer).take();
}

Bytes encodeCsv(const ParticleFileData& particles) {
  const bool velocity = !particles.velocities.empty();
  const bool density = !particles.densities.empty();
  const bool id = !particles.ids.empty();
  const bool pressure = !particles.pressures.empty();
  const bool fluid = !particles.fluids.empty();
  ByteWriter writer(std::endian::native);
  writer.text("x,y,z");
  if (velocity) writer.text(",vx,vy,vz");
  if (density) writer.text(",density");
  if (id) writer.text(",id");
  if (pressure) writer.text(",pressure");
  if (fluid) writer.text(",fluid");
  writer.text("\n");
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const auto writeVector = [&](const Eigen::Vector3f& v, std::string_view after) {
      writeNumber(writer, v.x(), ",");
      writeNumber(writer, v.y(), ",");
      writeNumber(writer, v.z(), after);
    };
    writeVector(particles.positions[i], "");
    if (velocity) {
      writer.text(",");
      writeVector(particles.velocities[i], "");
    }
    if (density) {
      writer.text(",");
      writeNumber(writer, particles.densities[i], "");
    }
    if (id) {
      writer.text(",");
      writer.text(std::to_string(particles.ids[i]));
    }
    if (pressure) {
      writer.text(",");
      writeNumber(writer, particles.pressures[i], "");
    }
    if (fluid) {
      writer.text(",");
      writer.text(std::to_string(particles.fluids[i]));
    }
    writer.text("\n");
  }
  return std::move(writer).take();
}

}  // namespace sluice::particleio
