"""A viewer of `sluice.v1` in Python, written from proto/README.md and the .proto files alone.

Needs Debian's python3-websockets and python3-protobuf, and protoc. One connection, one task: nothing here is safe to
share between threads.
"""

import asyncio
import importlib
import pathlib
import subprocess
import sys
from collections import deque

import websockets

SUBPROTOCOL = "sluice.v1"
# A frame of 3840 x 2160 as PNG may take this much.
MAX_MESSAGE_BYTES = 64 << 20


def load_messages(proto_root, out, protoc="protoc"):
    """Generates the messages into the folder `out` and returns the modules of scene.proto and session.proto."""
    proto_root, out = pathlib.Path(proto_root), pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    schemas = sorted(str(path) for path in proto_root.glob("sluice/v1/*.proto"))
    subprocess.run([protoc, f"--proto_path={proto_root}", f"--python_out={out}", *schemas], check=True)
    sys.path.insert(0, str(out))
    return importlib.import_module("sluice.v1.scene_pb2"), importlib.import_module("sluice.v1.session_pb2")


class Refused(Exception):
    """The server answered a request with an Error."""

    def __init__(self, error):
        super().__init__(f"{error.field_path}: {error.message}" if error.field_path else error.message)
        self.error = error


class Client:
    """One connection. What the server says by itself is kept in `stats`, `scene_changes`, `plans` and `viewers`."""

    def __init__(self, session_pb, socket):
        self._pb = session_pb
        self._socket = socket
        self._sequence = 0
        self._waiting = {}
        self._frames = deque()
        self._news = asyncio.Event()
        self._failure = None
        self.stats = None
        self.scene_changes = []
        self.plans = []
        self.viewers = None
        self._reader = asyncio.ensure_future(self._read())

    @classmethod
    async def connect(cls, session_pb, address, token=""):
        headers = {"Authorization": f"Bearer {token}"} if token else {}
        socket = await websockets.connect(
            address,
            subprotocols=[SUBPROTOCOL],
            extra_headers=headers,
            compression=None,
            max_size=MAX_MESSAGE_BYTES,
        )
        if socket.subprotocol != SUBPROTOCOL:
            raise ConnectionError("the server does not speak " + SUBPROTOCOL)
        return cls(session_pb, socket)

    async def close(self):
        await self._socket.close()
        await asyncio.wait([self._reader])

    # ---------------------------------------------------------------------------------------------- what it says

    async def send(self, sequence=None, **message):
        """Sends one member of the oneof, such as set_view=SetView(...); returns its sequence number."""
        if sequence is None:
            self._sequence += 1
            sequence = self._sequence
        await self.send_bytes(self._pb.ClientMessage(sequence=sequence, **message).SerializeToString())
        return sequence

    async def send_bytes(self, data):
        await self._socket.send(data)

    async def ask(self, timeout=20.0, sequence=None, **message):
        """Sends a request and returns its answer, the member of the ServerMessage; an Error raises Refused."""
        answer = asyncio.get_running_loop().create_future()
        # The number is taken before the message leaves, so that no answer can come first.
        self._waiting[sequence or self.next_sequence()] = answer
        await self.send(sequence, **message)
        reply = await asyncio.wait_for(answer, timeout)
        kind = reply.WhichOneof("message")
        if kind == "error":
            raise Refused(reply.error)
        return getattr(reply, kind)

    def waiting_frames(self):
        """Frames that have come and have not been acknowledged, oldest first."""
        return list(self._frames)

    def next_sequence(self):
        return self._sequence + 1

    async def ended(self, timeout=10.0):
        """Waits for the server to close the connection; returns the close code."""
        await asyncio.wait_for(asyncio.shield(self._reader), timeout)
        return self._socket.close_code

    async def acknowledge(self, frame):
        await self.send(frame_ack=self._pb.FrameAck(frame_id=frame.frame_id))

    # --------------------------------------------------------------------------------------------- what it hears

    async def frame(self, accept=lambda frame: True, timeout=20.0):
        """Waits for a frame that `accept` takes, and acknowledges it and all before it."""
        deadline = asyncio.get_running_loop().time() + timeout
        while True:
            while self._frames:
                frame = self._frames.popleft()
                await self.acknowledge(frame)
                if accept(frame):
                    return frame
            await self._next_news(deadline)

    async def until(self, condition, timeout=20.0):
        """Waits until something that the server says makes `condition` true. Acknowledges no frames."""
        deadline = asyncio.get_running_loop().time() + timeout
        while not condition():
            await self._next_news(deadline)

    async def _next_news(self, deadline):
        if self._failure:
            raise self._failure
        self._news.clear()
        await asyncio.wait_for(self._news.wait(), deadline - asyncio.get_running_loop().time())

    async def _read(self):
        try:
            async for data in self._socket:
                self._take(self._pb.ServerMessage.FromString(data))
                self._news.set()
            self._failure = self._ended()
        except websockets.ConnectionClosed:
            self._failure = self._ended()
        except Exception as failure:  # Whatever else ended the reading is told to whoever waits.
            self._failure = failure
        for answer in self._waiting.values():
            if not answer.done():
                answer.set_exception(self._failure)
        self._waiting.clear()
        self._news.set()

    def _ended(self):
        return ConnectionError(f"closed with {self._socket.close_code}: {self._socket.close_reason}")

    def _take(self, message):
        kind = message.WhichOneof("message")
        answer = self._waiting.pop(message.in_reply_to, None) if message.in_reply_to else None
        if answer and not answer.done():
            answer.set_result(message)
        elif kind == "frame" and not message.frame.snapshot:
            self._frames.append(message.frame)
        elif kind == "stats":
            self.stats = message.stats
        elif kind == "scene_changed":
            self.scene_changes.append(message.scene_changed)
        elif kind == "plan_changed":
            self.plans.append(message.plan_changed)
        elif kind == "viewers_changed":
            self.viewers = message.viewers_changed
