// What the server spends on one streamed frame beyond rendering and encoding it: 1280×720 JPEG of about 150 KB, to one
// viewer over the loopback that acknowledges each. The counters are processor time per frame: of the io thread, and of
// the thread that hands the frames over (which serialises them).
#include <benchmark/benchmark.h>
#include <pthread.h>
#include <time.h>

#include <semaphore>
#include <thread>

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
  std::counting_semaphore<> window{0};

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

void streamFrames(benchmark::State& state) {
  AcknowledgingBackend backend;
  stream::ServerOptions options;
  options.port = 0;
  stream::Server server(options, backend);
  std::thread io([&] { server.run(); });
  clockid_t ioClock{};
  pthread_getcpuclockid(io.native_handle(), &ioClock);

  test::TestViewer viewer("127.0.0.1", server.port());
  const core::ViewerId id = viewer.hello().viewer_id();
  std::thread reading([&] {
    try {
      for (;;) viewer.nextFrame();
    } catch (const test::ConnectionEnded&) {
    }
  });

  core::Delivery delivery;
  delivery.viewer = id;
  core::EncodedFrame frame;
  frame.size = {1280, 720};
  frame.codec = core::Codec::Jpeg;
  frame.bytes.assign(150'000, 0x5a);
  backend.window.release(options.frameWindow);
  const double ioBefore = threadSeconds(ioClock);
  const double senderBefore = threadSeconds(CLOCK_THREAD_CPUTIME_ID);
  for (auto _ : state) {
    backend.window.acquire();
    ++delivery.frameId;
    server.sendFrame(frame, delivery);
  }
  const double frames = static_cast<double>(state.iterations());
  state.counters["io_ms"] = 1000 * (threadSeconds(ioClock) - ioBefore) / frames;
  state.counters["sender_ms"] = 1000 * (threadSeconds(CLOCK_THREAD_CPUTIME_ID) - senderBefore) / frames;

  server.stop("the benchmark is over");
  io.join();
  reading.join();
}

BENCHMARK(streamFrames)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
