// What the server spends on one streamed frame beyond rendering and encoding it: 1280×720 JPEG of about 150 KB, to one
// viewer, and to 16, over the loopback, each of which acknowledges it. The counters are processor time per frame: of
// the io thread, and of the thread that hands the frames over (which serialises them).
#include <benchmark/benchmark.h>
#include <pthread.h>
#include <time.h>

#include <memory>
#include <semaphore>
#include <thread>
#include <vector>

#include "sluice/stream/server.h"
#include "viewer/test_viewer.h"

namespace {

using namespace sluice;

double threadSeconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Lets the benchmark know when a frame was acknowledged, and does nothing else.
class AcknowledgingBackend final : public stream::Backend {
 public:
  std::counting_semaphore<4096> window{0};

  v1::Welcome welcome() override { return {}; }
  void join(core::ViewerId, const stream::Visitor&) override {}
  void leave(core::ViewerId) override {}
  void setView(core::ViewerId, std::uint64_t, const stream::View&) override {}
  void setCamera(core::ViewerId, std::uint64_t, const core::Camera&) override {}
  void acknowledge(core::ViewerId, std::uint64_t) override { window.release(); }
  void updateScene(core::ViewerId, std::uint64_t, const v1::UpdateScene&) override {}
  void control(core::ViewerId, std::uint64_t, const v1::Control&) override {}
  void loadScene(core::ViewerId, std::uint64_t, const v1::LoadScene&) override {}
  void requestKeyframe(core::ViewerId) override {}
  void interact(core::ViewerId, std::uint64_t, const v1::Interact&) override {}
  void pick(core::ViewerId, std::uint64_t, const stream::PickPoint&) override {}
  void metrics(stream::MetricsText&) const override {}
  void snapshot(core::ViewerId, std::uint64_t, core::ImageSize, const std::optional<core::Camera>&) override {}
};

/// The argument: viewers that are sent each frame, as those who follow one view are.
void streamFrames(benchmark::State& state) {
  const auto viewers = static_cast<std::size_t>(state.range(0));
  AcknowledgingBackend backend;
  stream::ServerOptions options;
  options.port = 0;
  options.maxViewers = options.maxViewersPerAddress = 64;
  stream::Server server(options, backend);
  std::thread io([&] { server.run(); });
  clockid_t ioClock{};
  pthread_getcpuclockid(io.native_handle(), &ioClock);

  std::vector<core::Delivery> deliveries(viewers);
  std::vector<std::thread> reading;
  for (core::Delivery& delivery : deliveries) {
    auto viewer = std::make_shared<test::TestViewer>("127.0.0.1", server.port());
    delivery.viewer = viewer->hello().viewer_id();
    reading.emplace_back([viewer] {
      try {
        for (;;) viewer->nextFrame();
      } catch (const test::ConnectionEnded&) {
      }
    });
  }

  core::EncodedFrame frame;
  frame.size = {1280, 720};
  frame.codec = core::Codec::Jpeg;
  frame.bytes.assign(150'000, 0x5a);
  backend.window.release(static_cast<std::ptrdiff_t>(options.frameWindow * viewers));
  const double ioBefore = threadSeconds(ioClock);
  const double senderBefore = threadSeconds(CLOCK_THREAD_CPUTIME_ID);
  for (auto _ : state) {
    for (core::Delivery& delivery : deliveries) {
      backend.window.acquire();
      ++delivery.frameId;
      server.sendFrame(frame, delivery);
    }
  }
  const double frames = static_cast<double>(state.iterations()) * static_cast<double>(viewers);
  state.counters["io_ms_per_viewer"] = 1000 * (threadSeconds(ioClock) - ioBefore) / frames;
  state.counters["sender_ms_per_viewer"] = 1000 * (threadSeconds(CLOCK_THREAD_CPUTIME_ID) - senderBefore) / frames;

  server.stop("the benchmark is over");
  io.join();
  for (std::thread& thread : reading) thread.join();
}

BENCHMARK(streamFrames)->Arg(1)->Arg(16)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
