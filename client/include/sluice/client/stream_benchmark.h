#pragma once

#include <string>
#include <vector>

#include "sluice/client/connection.h"
#include "sluice/client/option_values.h"
#include "sluice/v1/session.pb.h"

namespace sluice::client {

struct StreamBenchmarkOptions {
  double seconds = 10;
  PictureSize size;
  v1::Codec codec = v1::JPEG;
  std::uint32_t quality = 0;  ///< 1..100 for lossy codecs; 0 takes the server's default.
  v1::QualityMode mode = v1::AUTOMATIC;
  std::uint32_t kilobitsPerSecond = 0;  ///< For FIXED_BIT_RATE.
  double slowBytesPerSecond = 0;        ///< Plays a link that carries no more; 0: as it is.
  bool inTurn = false;                  ///< Send a camera only once the picture for the last one is there.
  bool orbit = true;                    ///< Turn the camera all the time; else it rests, and no delay is measured.
};

/// A stage of the server's work and the milliseconds it took for each frame that ran it.
struct StageSamples {
  std::string name;
  std::vector<double> milliseconds;
};

struct StreamBenchmarkResult {
  double seconds = 0;  ///< Wall time over which frames and bytes are counted.
  std::size_t frames = 0;
  std::size_t payloadBytes = 0;
  std::vector<double> inputToDecodedMilliseconds;    ///< One for each camera that was sent.
  std::vector<double> responseMilliseconds;          ///< The server's share of the delay.
  std::vector<double> networkAndDecodeMilliseconds;  ///< The rest of it: the way there and back, and decoding.
  std::vector<double> drawMilliseconds;              ///< What the renderer spent on each frame, read-back included.
  /// The delay of the newest camera that each frame shows, without drawing that frame.
  std::vector<double> besideDrawingMilliseconds;
  /// The most frames that came behind a camera up to and with the first that shows it.
  std::size_t longestDelayFrames = 0;
  std::vector<double> decodeMilliseconds;
  /// Peak signal-to-noise ratio of pictures at rest against lossless ones, dB; empty where time runs or sizes differ.
  std::vector<double> psnrDecibels;
  std::vector<StageSamples> stages;  ///< In the order in which the server first named them.
};

/// Opens a stream of pictures and plays an eager viewer: sends cameras at the rate of a screen, decodes every frame and
/// acknowledges it. The first frame warms up and is not counted. Throws RequestError when the server refuses the view
/// or sends no first frame in the connection's time.
StreamBenchmarkResult benchmarkStream(Connection& connection, const StreamBenchmarkOptions& options);

/// The camera after its eye has gone around the target by an angle, about the camera's up direction.
v1::Camera orbited(const v1::Camera& camera, double radians);

}  // namespace sluice::client
