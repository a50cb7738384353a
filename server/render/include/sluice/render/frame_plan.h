#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sluice/core/camera.h"
#include "sluice/core/plan.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// Everything a frame may run, in the order in which it runs.
enum class Pass : std::uint8_t {
  Background,
  GroundShadow,
  SelectSplats,
  Splats,
  LargeSplats,
  Mask,
  Smoothing,
  Thickness,
  LargeThickness,
  SmoothThickness,
  Composite,
  BlendLiquid,
  Spray,
};

/// What passes read and write.
enum class Resource : std::uint8_t {
  Particles,       ///< Positions, as they came.
  SplatList,       ///< Which particles are drawn, and how.
  ShadowMap,       ///< Liquid that sunlight passes before it meets the floor.
  Background,      ///< Floor and sky without the liquid.
  Scene,           ///< Floor and sky with the liquid's shadow.
  Surface,         ///< Inverse eye depth q = 1/z of the liquid's front, 1/m; 0 where there is none.
  SurfaceScratch,  ///< The other half of a filter's to and fro.
  SurfaceScratch2,
  SurfaceScratch3,
  SurfaceScratch4,
  Stencil,    ///< 1 where there is liquid.
  Thickness,  ///< Liquid along the line of sight, m.
  ThicknessScratch,
  Liquid,  ///< The shaded liquid alone, where it is drawn smaller than the picture.
  Picture,
};

/// What smoothing may draw into besides the surface itself, alike in size and format, in the order in which a method
/// gets them.
inline constexpr std::array kSurfaceScratch{Resource::SurfaceScratch, Resource::SurfaceScratch2,
                                            Resource::SurfaceScratch3, Resource::SurfaceScratch4};

/// The surface, or one of its scratch buffers.
bool isSurface(Resource resource);

std::string_view name(Pass pass);
std::string_view name(Resource resource);

/// Facts about the particles at hand and their place in the picture.
struct DataTraits {
  double spacing = 1;              ///< d, m.
  std::size_t points = 0;          ///< Splats drawn as points.
  std::size_t hiddenPoints = 0;    ///< Points that are drawn into thickness alone, for whatever reason.
  std::size_t interiorPoints = 0;  ///< Those of them that are deep inside the liquid.
  std::size_t largeSplats = 0;     ///< Splats too near or too large for points.
  std::size_t sprayDrops = 0;      ///< Particles that are far from the rest.
  double nearestDepth = 1;         ///< Least eye depth of the liquid's surface, m.
  double pixelSlope = 1e-3;        ///< Width of a pixel at eye depth 1.
  bool densities = false;          ///< Whether the source gives densities,
  bool neighbourCounts = false;    ///< and numbers of neighbours.

  std::size_t splats() const { return points + largeSplats; }
};

/// What stayed valid since the frame before.
struct ReuseTraits {
  bool background = false;
  bool picture = false;  ///< The whole picture: nothing has moved or changed.
};

/// What the device does well.
struct DeviceTraits {
  /// The CPU draws, and so can as well do so without GL, where that is faster.
  bool software = true;
};

/// Where a flat rim lies, in radii before the splat's centre: with R = 0.9 d as deep as where two splats d apart meet.
constexpr float kRimDepth = 0.83F;

/// How an explicit flow spends its smoothing time. The flow as printed in 2009 counts time in m·pixel instead of m².
struct FlowSchedule {
  int iterations = 0;
  int stages = 1;         ///< Evaluations of the flow in one iteration.
  double stepTime = 0;    ///< Flow time of one iteration, m².
  double wantedTime = 0;  ///< What the scene asks for, m².
  double shortfall = 0;   ///< Fraction of `wantedTime` that max_iterations cuts off.
};

struct PassStep {
  Pass pass;
  std::string name;
  std::vector<Resource> reads;
  std::vector<Resource> writes;
  int sweeps = 1;  ///< Times that it goes over its whole picture.

  bool operator==(const PassStep&) const = default;
};

enum class PixelFormat : std::uint8_t { Srgb8Alpha8, R32f, Stencil8 };

std::uint64_t bytesPerPixel(PixelFormat format);

struct PictureBuffer {
  Resource resource;
  PixelFormat format;
  core::ImageSize size;
  /// The buffer whose memory this one uses, because the two never hold anything at the same time.
  std::optional<Resource> sharedWith = {};

  /// 0 where the memory is another buffer's.
  std::uint64_t bytes() const;
  bool operator==(const PictureBuffer&) const = default;
};

/// What one frame runs, needs, and leaves out. The renderer executes exactly `steps`.
struct FramePlan {
  std::vector<PassStep> steps;
  std::vector<PictureBuffer> buffers;
  std::vector<core::LeftOut> leftOut;
  FlowSchedule flow;
  bool flatRims = false;  ///< Splats' limbs do not fall far behind their fronts, see kRimDepth.
  DeviceTraits device;

  bool runs(Pass pass) const;
  /// Null when the frame does without it.
  const PictureBuffer* buffer(Resource resource) const;
  /// The same for people to read.
  core::Plan describe() const;
};

/// The picture's size divided by 1, 2 or 4, rounded up.
core::ImageSize dividedSize(core::ImageSize size, unsigned divisor);

/// Pure: the same arguments give the same plan. `scene` is complete and valid.
FramePlan planFrame(const v1::Scene& scene, core::ImageSize size, const DataTraits& traits, const ReuseTraits& reuse,
                    const DeviceTraits& device = {});

}  // namespace sluice::render
