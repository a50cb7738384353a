// Particles in a PLY file: its element "vertex". Elements before it are passed over, those after it are not read.

#include <array>

#include "attributes.h"
#include "byte_writer.h"
#include "codecs.h"
#include "ply_reader.h"

namespace sluice::particleio {

namespace {

/// Where the numbers of each property belong; none for lists.
std::vector<std::optional<Target>> targetsOf(const PlyElement& element) {
  std::vector<std::optional<Target>> targets;
  for (const PlyProperty& property : element.properties) {
    targets.push_back(property.countType ? std::nullopt : targetNamed(property.name));
  }
  return targets;
}

ParticleFileData readParticles(PlyReader& reader, const PlyElement& element) {
  const std::vector<std::optional<Target>> targets = targetsOf(element);
  std::array<bool, 3> axes{};
  for (const std::optional<Target>& target : targets) {
    if (target && target->attribute == Attribute::Position) axes[static_cast<std::size_t>(target->component)] = true;
  }
  if (axes != std::array{true, true, true}) reader.fail("the element \"vertex\" lacks one of x, y, z");
  reader.checkSize(element);

  ParticleBuilder builder(reader.fileName(), element.count);
  for (const std::optional<Target>& target : targets) {
    if (target) builder.enable(target->attribute);
  }
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (std::size_t p = 0; p < targets.size(); ++p) {
      if (targets[p]) {
        builder.set(i, *targets[p], reader.number(element.properties[p].type));
      } else {
        reader.skip(element.properties[p]);
      }
    }
  }
  return std::move(builder).finish();
}

}  // namespace

ParticleFileData decodePly(std::span<const std::uint8_t> bytes, const std::string& name) {
  PlyReader reader(bytes, name);
  for (const PlyElement& element : reader.elements()) {
    if (element.name == "vertex") return readParticles(reader, element);
    reader.skip(element);
  }
  throw core::InputError(name, "", "has no element \"vertex\"");
}

Bytes encodePly(const ParticleFileData& particles) {
  ByteWriter writer(std::endian::little);
  const bool velocity = !particles.velocities.empty();
  const bool density = !particles.densities.empty();
  const bool id = !particles.ids.empty();
  const bool pressure = !particles.pressures.empty();
  const bool fluid = !particles.fluids.empty();
  writer.text("ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(particles.size()) + "\n");
  writer.text("property float x\nproperty float y\nproperty float z\n");
  if (velocity) writer.text("property float vx\nproperty float vy\nproperty float vz\n");
  if (density) writer.text("property float density\n");
  if (id) writer.text("property uint id\n");
  if (pressure) writer.text("property float pressure\n");
  if (fluid) writer.text("property uchar fluid\n");
  writer.text("end_header\n");
  for (std::size_t i = 0; i < particles.size(); ++i) {
    for (const float component : particles.positions[i]) writer.write(component);
    if (velocity) {
      for (const float component : particles.velocities[i]) writer.write(component);
    }
    if (density) writer.write(particles.densities[i]);
    if (id) writer.write(particles.ids[i]);
    if (pressure) writer.write(particles.pressures[i]);
    if (fluid) writer.write(particles.fluids[i]);
  }
  return std::move(writer).take();
}

}  // namespace sluice::particleio
