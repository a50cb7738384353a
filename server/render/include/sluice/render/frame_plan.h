#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sluice/core/camera.h"
#include "sluice/core/plan.h"
#include "sluice/v1/scene.pb.h"

namespace sluice::render {

/// Everything a frame may run, in the order in which it runs.
enum class Pass : std::uint8_t {
  BodyShadow,
  Background,
  Bodies,
  Sunlight,
  SelectSplats,
  Splats,
  LargeSplats,
  Mask,
  Smoothing,
  Thickness,
  LargeThickness,
  SmoothThickness,
  ClipThickness,
  BackSplats,
  BackSmoothing,
  Noise,
  CubeMap,
  GlassBehind,
  BeginPicture,
  Layers,
  ExtendScene,
  Composite,
  BlendLiquid,
  VelocityMap,
  ColourMap,
  Study,
  StudyFoam,
  BodyEdges,
  Spray,
  Foam,
  BlendFoam,
  GlassBefore,
  ToneMap,
  Legend,
};

/// What passes read and write.
enum class Resource : std::uint8_t {
  Particles,       ///< Positions, as they came.
  SplatList,       ///< Which particles are drawn, and how.
  LightMap,        ///< What becomes of sunlight that passes the liquid.
  BodyShadowMap,   ///< Depth of the bodies as the sun sees them.
  BodySamples,     ///< Light and depth of the bodies, four samples a pixel.
  SceneDepth,      ///< Inverse eye depth of floor and bodies, 1/m; 0 where there is none.
  Background,      ///< What surrounds the liquid, in linear light; alpha is the share that comes from the sun.
  Scene,           ///< The same with what the liquid does to the sunlight, and with liquids farther off.
  Surface,         ///< Inverse eye depth q = 1/z of the liquid's front, 1/m; 0 where there is none.
  SurfaceScratch,  ///< The other half of a filter's to and fro.
  SurfaceScratch2,
  SurfaceScratch3,
  SurfaceScratch4,
  BackSurface,  ///< Inverse eye depth of the liquid's farthest side; 0 where there is no liquid.
  BackCoarse,   ///< The same at half the size, where the CPU draws and smooths it.
  BackDepth,    ///< The same as a depth, where a GPU draws it.
  Stencil,      ///< 1 where there is liquid.
  Thickness,    ///< Liquid along the line of sight, m.
  ThicknessScratch,
  Noise,          ///< Height of waves over the smoothed surface, m.
  NoiseSums,      ///< What the noise is made of, see noise.frag.
  Violence,       ///< How shaken the liquid is, 0 to 1.
  Attribute,      ///< A value of the particles at the surface.
  AttributeSums,  ///< What it is made of, see attributes.frag.
  CubeMap,        ///< Light and distance of the bodies around the liquid's middle.
  Liquid,         ///< The shaded liquid alone, where it is drawn smaller than the picture.
  Foam,           ///< Optical depth of spray, foam and bubbles: they hide 1 - exp(-it) of what is behind.
  Picture,        ///< Scene and liquid in linear light.
  Screen,         ///< The picture as a screen shows it; where the CPU draws, in the frame that is given away.
};

/// What smoothing may draw into besides the surface itself, alike in size and format, in the order in which a method
/// gets them.
inline constexpr std::array kSurfaceScratch{Resource::SurfaceScratch, Resource::SurfaceScratch2,
                                            Resource::SurfaceScratch3, Resource::SurfaceScratch4};

/// The surface, its back, or one of its scratch buffers.
bool isSurface(Resource resource);

/// As fine as the surface, and no finer.
bool isAsFineAsSurface(Resource resource);

/// Whether every liquid has one of its own.
bool isOfLiquid(Resource resource);

/// Whether its pass makes and keeps it, so that the plan but counts its bytes.
bool isKeptByItsPass(Resource resource);

/// Most liquids that one picture may hold.
inline constexpr std::size_t kMostLiquids = 8;

/// A buffer: a resource, and of which liquid, where every liquid has its own; else 0.
struct BufferId {
  Resource resource;
  std::uint8_t liquid = 0;

  auto operator<=>(const BufferId&) const = default;
};

std::string_view name(Pass pass);
std::string_view name(Resource resource);

/// Facts about the particles of one liquid and their place in the picture.
struct DataTraits {
  double spacing = 1;              ///< d, m.
  std::size_t points = 0;          ///< Splats drawn as points.
  std::size_t hiddenPoints = 0;    ///< Points that are drawn into thickness alone, for whatever reason.
  std::size_t interiorPoints = 0;  ///< Those of them that are deep inside the liquid.
  std::size_t largeSplats = 0;     ///< Splats too near or too large for points.
  std::size_t sprayDrops = 0;      ///< Particles that are far from the rest.
  std::size_t foamDots = 0;        ///< Secondary particles, whichever liquid made them: the first liquid's count.
  double nearestDepth = 1;         ///< Least eye depth of the liquid's surface, m.
  double pixelSlope = 1e-3;        ///< Width of a pixel at eye depth 1.
  bool densities = false;          ///< Whether the source gives densities,
  bool neighbourCounts = false;    ///< numbers of neighbours,
  bool ids = false;                ///< ids,
  bool velocities = false;         ///< and velocities.
  bool cubeMap = false;            ///< The last frame's cube map shows what a new one would.
  std::string_view velocityMapMissing = {};  ///< Why the look's velocity map cannot be drawn; empty where it can.
  std::string_view colourMapMissing = {};    ///< The same of its colour map.

  std::size_t splats() const { return points + largeSplats; }
};

/// What stayed valid since the frame before.
struct ReuseTraits {
  bool background = false;
  bool bodies = false;   ///< Bodies, where they stand, and the sun.
  bool picture = false;  ///< The whole picture: nothing has moved or changed.
  bool legend = false;   ///< And it had a legend.
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
  std::vector<BufferId> reads;
  std::vector<BufferId> writes;
  int sweeps = 1;           ///< Times that it goes over its whole picture.
  std::uint8_t liquid = 0;  ///< Whose surface it works on.
  /// Of several liquids one behind another: draws what has so many others behind it.
  std::uint8_t layer = 0;

  bool operator==(const PassStep&) const = default;
};

enum class PixelFormat : std::uint8_t {
  Rgba32f,
  Rgba16f,
  Rgba16fDepth32fTimes4,
  Rgba16fRg32fTimes6,
  Srgb8Alpha8,
  R32f,
  Rg32f,
  Stencil8
};

std::uint64_t bytesPerPixel(PixelFormat format);

struct PictureBuffer {
  BufferId id;
  PixelFormat format;
  core::ImageSize size;
  /// The buffer whose memory this one uses, because the two never hold anything at the same time.
  std::optional<BufferId> sharedWith = {};

  /// 0 where the memory is another buffer's.
  std::uint64_t bytes() const;
  bool operator==(const PictureBuffer&) const = default;
};

/// How one liquid's surface is drawn.
struct SurfacePlan {
  FlowSchedule flow;
  bool flatRims = false;     ///< Splats' limbs do not fall far behind their fronts, see kRimDepth.
  unsigned backDivisor = 1;  ///< The picture's size over that which the back surface is drawn in.
};

/// What one frame runs, needs, and leaves out. The renderer executes exactly `steps`.
struct FramePlan {
  std::vector<PassStep> steps;
  std::vector<PictureBuffer> buffers;
  std::vector<core::LeftOut> leftOut;
  std::vector<SurfacePlan> surfaces;  ///< One for each liquid.
  int layers = 1;                     ///< Most liquids one behind another.
  DeviceTraits device;

  bool runs(Pass pass) const;
  bool runs(Pass pass, std::size_t liquid) const;
  /// Null when the frame does without it.
  const PictureBuffer* buffer(BufferId id) const;
  const PictureBuffer* buffer(Resource resource, std::size_t liquid = 0) const;
  /// The same for people to read.
  core::Plan describe() const;
};

/// The picture's size divided by 1, 2 or 4, rounded up.
core::ImageSize dividedSize(core::ImageSize size, unsigned divisor);

/// Whether pictures show a step of how the scene is drawn, and not the scene.
bool isStudy(const v1::View& view);

/// Whether its colours stand for values: a study of anything but the particles themselves.
bool showsValues(const v1::View& view);

/// The look of the k-th liquid of a complete scene.
const v1::Look& lookOf(const v1::Scene& scene, std::size_t liquid);

/// Pure: the same arguments give the same plan. `scene` is complete and valid; `liquids` holds the traits of each.
FramePlan planFrame(const v1::Scene& scene, core::ImageSize size, std::span<const DataTraits> liquids,
                    const ReuseTraits& reuse, const DeviceTraits& device = {});

}  // namespace sluice::render
