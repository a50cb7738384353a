#include "wire.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>

#include <cstring>
#include <utility>

#include "sluice/core/check.h"
#include "sluice/stream/codec.h"

namespace sluice::stream {

namespace {

using google::protobuf::internal::WireFormatLite;
using google::protobuf::io::CodedOutputStream;

constexpr std::uint32_t lengthDelimitedTag(int field) {
  return WireFormatLite::MakeTag(field, WireFormatLite::WIRETYPE_LENGTH_DELIMITED);
}

// Every field of the Frame but the payload.
v1::Frame header(const core::EncodedFrame& frame, const core::Delivery& delivery) {
  v1::Frame header;
  header.set_frame_id(delivery.frameId);
  header.set_codec(toProto(frame.codec));
  header.set_width(static_cast<std::uint32_t>(frame.size.width));
  header.set_height(static_cast<std::uint32_t>(frame.size.height));
  header.set_keyframe(frame.keyframe);
  header.set_reflects_sequence(delivery.reflectsSequence);
  if (delivery.askedAt) {
    header.set_response_milliseconds(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - *delivery.askedAt).count());
  }
  header.set_simulation_time(frame.tag.simulationTime);
  header.set_snapshot_sequence(frame.tag.snapshotSequence);
  header.set_snapshot(delivery.inReplyTo != 0);
  header.set_still(frame.tag.still);
  header.set_quality(static_cast<std::uint32_t>(frame.quality));
  header.set_decoder(frame.decoder);
  if (core::isVideo(frame.codec)) header.set_matrix(v1::BT709);
  for (const core::StageTime& stage : frame.tag.stages) {
    v1::StageTime& time = *header.add_stages();
    time.set_name(stage.name);
    time.set_milliseconds(stage.milliseconds);
  }
  return header;
}

}  // namespace

WireMessage toWire(const v1::ServerMessage& message) {
  return std::make_shared<const std::string>(message.SerializeAsString());
}

WireMessage toWire(const core::EncodedFrame& frame, const core::Delivery& delivery) {
  // The wire format lets the fields of a message stand in any order, so the payload can follow the rest of the Frame,
  // and the Frame the rest of the ServerMessage.
  v1::ServerMessage envelope;
  envelope.set_in_reply_to(delivery.inReplyTo);
  const std::string before = envelope.SerializeAsString();
  const std::string head = header(frame, delivery).SerializeAsString();

  constexpr std::uint32_t kFrameTag = lengthDelimitedTag(v1::ServerMessage::kFrameFieldNumber);
  constexpr std::uint32_t kPayloadTag = lengthDelimitedTag(v1::Frame::kPayloadFieldNumber);
  const auto payloadBytes = static_cast<std::uint32_t>(frame.bytes.size());
  const std::size_t frameBytes = head.size() + CodedOutputStream::VarintSize32(kPayloadTag) +
                                 CodedOutputStream::VarintSize32(payloadBytes) + payloadBytes;
  const std::size_t total = before.size() + CodedOutputStream::VarintSize32(kFrameTag) +
                            CodedOutputStream::VarintSize32(static_cast<std::uint32_t>(frameBytes)) + frameBytes;

  std::string wire(total, '\0');
  const auto append = [](std::uint8_t* at, const void* bytes, std::size_t count) {
    if (count != 0) std::memcpy(at, bytes, count);
    return at + count;
  };
  auto* at = reinterpret_cast<std::uint8_t*>(wire.data());
  const std::uint8_t* const end = at + total;
  at = append(at, before.data(), before.size());
  at = CodedOutputStream::WriteVarint32ToArray(kFrameTag, at);
  at = CodedOutputStream::WriteVarint32ToArray(static_cast<std::uint32_t>(frameBytes), at);
  at = append(at, head.data(), head.size());
  at = CodedOutputStream::WriteVarint32ToArray(kPayloadTag, at);
  at = CodedOutputStream::WriteVarint32ToArray(payloadBytes, at);
  at = append(at, frame.bytes.data(), frame.bytes.size());
  SLUICE_CHECK(at == end);
  return std::make_shared<const std::string>(std::move(wire));
}

}  // namespace sluice::stream
