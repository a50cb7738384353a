#!/usr/bin/env python3
"""Viewers that come, go, resize, fall silent and vanish, for minutes, against a live server; then: does it still serve,
is its memory flat, and is nobody left?

    soak.py SERVER [--seconds 300] [--scene dam_break] [--seed 1] [--viewers 12] [--threads 0]

Speaks the WebSocket by hand over plain sockets, so that connections can be left half open, cut with a reset, or fed one
byte at a time. Exit code 1 where anything is not as it should be.
"""

import argparse
import base64
import os
import random
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request


def varint(number):
    out = bytearray()
    while number > 0x7F:
        out.append(number & 0x7F | 0x80)
        number >>= 7
    out.append(number)
    return bytes(out)


def field(number, value):
    """A protobuf field: an integer as a varint, bytes behind their length."""
    if isinstance(value, int):
        return varint(number << 3) + varint(value)
    return varint(number << 3 | 2) + varint(len(value)) + value


class Viewer:
    """One connection; every method may raise OSError once the other side has gone."""

    def __init__(self, port):
        self.sequence = 0
        self.buffer = b""
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=10)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(
            f"GET /stream HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: sluice.v1\r\n\r\n".encode()
        )
        while b"\r\n\r\n" not in self.buffer:
            self._fill()
        head, self.buffer = self.buffer.split(b"\r\n\r\n", 1)
        if b" 101 " not in head.split(b"\r\n")[0]:
            raise OSError(head.split(b"\r\n")[0].decode())

    def _fill(self):
        data = self.socket.recv(1 << 16)
        if not data:
            raise OSError("closed")
        self.buffer += data

    def _take(self, count):
        while len(self.buffer) < count:
            self._fill()
        data, self.buffer = self.buffer[:count], self.buffer[count:]
        return data

    def raw(self, opcode, payload):
        mask = os.urandom(4)
        head = bytes([0x80 | opcode])
        if len(payload) < 126:
            head += bytes([0x80 | len(payload)])
        else:
            head += bytes([0x80 | 126]) + struct.pack(">H", len(payload))
        self.socket.sendall(head + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(payload)))

    def say(self, number, message):
        self.sequence += 1
        self.raw(2, field(1, self.sequence) + field(number, message))

    def hello(self):
        self.say(2, field(1, b"soak"))

    def view(self, width, height, codec):
        self.say(3, field(1, width) + field(2, height) + field(3, varint(codec)))

    def camera(self, angle_step):
        eye = varint(1 << 3 | 1) + struct.pack("<d", 2 + angle_step)
        self.say(4, field(1, field(1, eye)))

    def acknowledge(self, frame):
        self.say(9, field(1, frame))

    def receive(self, timeout):
        """The bytes of the next binary message; None when none comes in time."""
        self.socket.settimeout(timeout)
        try:
            first, second = self._take(2)
            length = second & 0x7F
            if length == 126:
                length = struct.unpack(">H", self._take(2))[0]
            elif length == 127:
                length = struct.unpack(">Q", self._take(8))[0]
            payload = self._take(length)
        except socket.timeout:
            return None
        finally:
            self.socket.settimeout(10)
        if first & 0x0F == 9:
            self.raw(10, payload)
            return b""
        if first & 0x0F == 8:
            raise OSError("closed with %d" % struct.unpack(">H", payload[:2])[0])
        return payload

    def reset(self):
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        self.socket.close()


def read_varint(data, at):
    value = shift = 0
    while True:
        byte = data[at]
        at += 1
        value |= (byte & 0x7F) << shift
        if byte < 0x80:
            return value, at
        shift += 7


def frame_id_of(message):
    """The id of the frame in a ServerMessage; None where it is another message."""
    at = 0
    while at < len(message):
        key, at = read_varint(message, at)
        if key & 7 == 0:
            _, at = read_varint(message, at)
            continue
        length, at = read_varint(message, at)
        if key >> 3 == 3:
            inner = message[at : at + 12]
            if inner[:1] == b"\x08":
                return read_varint(inner, 1)[0]
            return None
        at += length
    return None


class Crowd:
    def __init__(self, port, seed, end):
        self.port, self.seed, self.end = port, seed, end
        self.counts = {}
        self.lock = threading.Lock()
        self.frames = 0

    def note(self, what):
        with self.lock:
            self.counts[what] = self.counts.get(what, 0) + 1

    def live(self, number):
        rng = random.Random(self.seed * 1000 + number)
        while time.monotonic() < self.end:
            try:
                self.one_life(rng)
            except OSError:
                self.note("ended by the server")
            time.sleep(rng.uniform(0, 0.5))

    def one_life(self, rng):
        viewer = Viewer(self.port)
        if rng.random() < 0.05:
            self.note("said nothing")
            time.sleep(rng.uniform(0, 2))
            viewer.reset()
            return
        viewer.hello()
        viewer.view(rng.randrange(16, 640), rng.randrange(16, 360), rng.choice([1, 1, 2, 3, 4, 5]))
        end = min(self.end, time.monotonic() + rng.uniform(0.2, 8))
        while time.monotonic() < end:
            self.one_act(viewer, rng)
        how = rng.choice(["closed", "reset", "half open", "silent", "left a message unfinished"])
        self.note(how)
        if how == "closed":
            viewer.raw(8, struct.pack(">H", 1000))
        elif how == "half open":
            viewer.socket.shutdown(socket.SHUT_WR)
            time.sleep(rng.uniform(0, 1))
        elif how == "silent":
            time.sleep(rng.uniform(0, 4))
        elif how == "left a message unfinished":
            viewer.socket.sendall(b"\x82\xfe\x10")
        viewer.reset()

    def one_act(self, viewer, rng):
        act = rng.random()
        if act < 0.05:
            viewer.view(rng.randrange(1, 640), rng.randrange(1, 360), rng.choice([1, 2, 3, 4, 5]))
        elif act < 0.3:
            viewer.camera(rng.uniform(0, 1))
        elif act < 0.32:
            viewer.say(6, field(1, rng.choice([1, 1, 1, 3, 4])))
        elif act < 0.33:
            viewer.raw(2, os.urandom(rng.randrange(1, 60)))
        message = viewer.receive(rng.uniform(0.005, 0.1))
        frame = frame_id_of(message) if message else None
        if frame is not None:
            with self.lock:
                self.frames += 1
            if rng.random() < 0.97:
                viewer.acknowledge(frame)


def resident_bytes(pid):
    with open(f"/proc/{pid}/statm") as statm:
        return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def start(server, scene, threads):
    log = tempfile.NamedTemporaryFile("w+", prefix="sluice-soak-", suffix=".log", delete=False)
    process = subprocess.Popen(
        [server, "serve", scene, "--listen", "127.0.0.1:0", "--max-viewers", "64", "--threads", str(threads)],
        # Leaks are judged by `findings`.
        stdout=subprocess.PIPE, stderr=log, text=True,
        env=dict(os.environ, OMP_WAIT_POLICY="passive", LSAN_OPTIONS="exitcode=0"))
    for line in process.stdout:
        found = re.search(r"listening on http://.*:(\d+)", line)
        if found:
            return process, int(found.group(1)), log.name
    raise SystemExit("the server did not start; see " + log.name)


def metric(port, name):
    page = urllib.request.urlopen(f"http://127.0.0.1:{port}/metrics", timeout=30).read().decode()
    return float(re.search(rf"^{name} (\S+)$", page, re.M).group(1))


def findings(log):
    """What the sanitizers say in a log, one line each. A leak counts where a function or a file of the program is named
    in its stack: GL drivers leave a little behind when they are unloaded, and nothing names them then."""
    found = re.findall(r"^.*(?:ERROR: (?!Leak)\w*Sanitizer|WARNING: ThreadSanitizer|runtime error).*$", log, re.M)
    for leak in re.findall(r"^((?:Direct|Indirect) leak of .*)\n((?: +#\d+ .*\n)+)", log, re.M):
        frames = [line for line in leak[1].splitlines() if "<unknown module>" not in line and "/libasan.so" not in line]
        if any("__interceptor_" not in frame for frame in frames):
            found.append(leak[0] + frames[-1])
    return found


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("server")
    parser.add_argument("--seconds", type=float, default=300)
    parser.add_argument("--scene", default="dam_break")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--viewers", type=int, default=12)
    parser.add_argument("--threads", type=int, default=0, help="of the simulation; 0: one for each core")
    options = parser.parse_args()

    process, port, log = start(options.server, options.scene, options.threads)
    crowd = Crowd(port, options.seed, time.monotonic() + options.seconds)
    threads = [threading.Thread(target=crowd.live, args=(n,), daemon=True) for n in range(options.viewers)]
    for thread in threads:
        thread.start()
    samples = []
    while time.monotonic() < crowd.end and process.poll() is None:
        time.sleep(min(options.seconds / 20, 10))
        samples.append(resident_bytes(process.pid))
        print(f"{len(samples):3d}  {samples[-1] / 2**20:8.1f} MiB  {crowd.frames} frames", flush=True)
    for thread in threads:
        thread.join(20)

    problems = []
    if process.poll() is not None:
        problems.append(f"the server ended with {process.returncode}")
    else:
        problems += after(process, port, samples)
    print("lives:", dict(sorted(crowd.counts.items())), "frames:", crowd.frames)
    if crowd.frames == 0:
        problems.append("no frame came")
    with open(log) as text:
        problems += findings(text.read())[:5]
    for problem in problems:
        print("soak:", problem, "- see " + log, file=sys.stderr)
    if not problems:
        os.unlink(log)
    return 1 if problems else 0


def after(process, port, samples):
    """What is wrong once all viewers are gone."""
    problems = []
    for _ in range(150):
        if metric(port, "sluice_viewers") == 0:
            break
        time.sleep(0.3)
    else:
        problems.append(f"{metric(port, 'sluice_viewers'):.0f} viewers never left")
    viewer = Viewer(port)
    viewer.hello()
    viewer.view(64, 64, 1)
    if not any(frame_id_of(viewer.receive(10) or b"") for _ in range(20)):
        problems.append("it gives no frames any more")
    viewer.reset()
    # The first third warms up: encoders, buffers, the allocator's arenas.
    third = len(samples) // 3
    if third >= 2:
        early, late = max(samples[third : 2 * third]), min(samples[2 * third :])
        if late > 1.15 * early + 32 * 2**20:
            problems.append(f"its memory grew from {early / 2**20:.0f} to {late / 2**20:.0f} MiB")
    process.send_signal(signal.SIGTERM)
    try:
        code = process.wait(30)
        if code != 0:
            problems.append(f"it stopped with {code}")
    except subprocess.TimeoutExpired:
        process.kill()
        problems.append("it did not stop when asked to")
    return problems


if __name__ == "__main__":
    sys.exit(main())
